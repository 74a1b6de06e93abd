#include "base/decompositions.hpp"

namespace Eigen {

template void SparseLU<nsframe::SparseMatrix>::analyzePattern(const nsframe::SparseMatrix&);
template void SparseLU<nsframe::SparseMatrix>::factorize(const nsframe::SparseMatrix&);
template void PartialPivLU<nsframe::MatrixX>::compute();
template LLT<nsframe::MatrixX>& LLT<nsframe::MatrixX>::compute(const EigenBase<nsframe::MatrixX>&);

template void ColPivHouseholderQR<nsframe::MatrixX>::computeInPlace();
template void ColPivHouseholderQR<nsframe::MatrixX>::_solve_impl(const nsframe::VectorX&, nsframe::VectorX&) const;
template void CompleteOrthogonalDecomposition<nsframe::MatrixX>::computeInPlace();
template void CompleteOrthogonalDecomposition<nsframe::MatrixX>::_solve_impl(const nsframe::VectorX&,
                                                                                    nsframe::VectorX&) const;

template GeneralizedSelfAdjointEigenSolver<nsframe::MatrixX>&
GeneralizedSelfAdjointEigenSolver<nsframe::MatrixX>::compute(const nsframe::MatrixX&, const nsframe::MatrixX&, int);
template EigenSolver<nsframe::MatrixX>& EigenSolver<nsframe::MatrixX>::compute(const EigenBase<nsframe::MatrixX>&,
                                                                                       bool);

}  // namespace Eigen
