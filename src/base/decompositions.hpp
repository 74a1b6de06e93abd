// Eigen's decompositions of dynamic size. The long functions are compiled once (decompositions.cpp): each takes the
// compiler seconds wherever it is met anew.
#pragma once

#include "base/types.hpp"

namespace nsframe {

constexpr int dense_eigen_limit = 300;  // rows up to which all eigenvalues are found at once

}  // namespace nsframe

namespace Eigen {

extern template void SparseLU<nsframe::SparseMatrix>::analyzePattern(const nsframe::SparseMatrix&);
extern template void SparseLU<nsframe::SparseMatrix>::factorize(const nsframe::SparseMatrix&);
extern template void PartialPivLU<nsframe::MatrixX>::compute();
extern template LLT<nsframe::MatrixX>& LLT<nsframe::MatrixX>::compute(const EigenBase<nsframe::MatrixX>&);

extern template void ColPivHouseholderQR<nsframe::MatrixX>::computeInPlace();
extern template void ColPivHouseholderQR<nsframe::MatrixX>::_solve_impl(const nsframe::VectorX&, nsframe::VectorX&) const;
extern template void CompleteOrthogonalDecomposition<nsframe::MatrixX>::computeInPlace();
extern template void CompleteOrthogonalDecomposition<nsframe::MatrixX>::_solve_impl(const nsframe::VectorX&,
                                                                                    nsframe::VectorX&) const;

extern template GeneralizedSelfAdjointEigenSolver<nsframe::MatrixX>&
GeneralizedSelfAdjointEigenSolver<nsframe::MatrixX>::compute(const nsframe::MatrixX&, const nsframe::MatrixX&, int);
extern template EigenSolver<nsframe::MatrixX>& EigenSolver<nsframe::MatrixX>::compute(const EigenBase<nsframe::MatrixX>&,
                                                                                       bool);

}  // namespace Eigen
