#include "base/decompositions.hpp"

namespace Eigen {

template void SparseLU<nsframe::SparseMatrix>::analyzePattern(const nsframe::SparseMatrix&);
template void SparseLU<nsframe::SparseMatrix>::factorize(const nsframe::SparseMatrix&);
template void PartialPivLU<nsframe::MatrixX>::compute();
template LLT<nsframe::MatrixX>& LLT<nsframe::MatrixX>::compute(const EigenBase<nsframe::MatrixX>&);

template GeneralizedSelfAdjointEigenSolver<nsframe::MatrixX>&
GeneralizedSelfAdjointEigenSolver<nsframe::MatrixX>::compute(const nsframe::MatrixX&, const nsframe::MatrixX&, int);
template EigenSolver<nsframe::MatrixX>& EigenSolver<nsframe::MatrixX>::compute(const EigenBase<nsframe::MatrixX>&,
                                                                                       bool);

}  // namespace Eigen

namespace nsframe {

template <class Real>
RankRevealing<Real>::RankRevealing() : factor_(std::make_unique<Eigen::CompleteOrthogonalDecomposition<DenseMatrix<Real>>>()) {}

template <class Real>
RankRevealing<Real>::RankRevealing(const DenseMatrix<Real>& matrix, Real threshold) : RankRevealing() {
  compute(matrix, threshold);
}

template <class Real>
RankRevealing<Real>::RankRevealing(RankRevealing&&) noexcept = default;
template <class Real>
RankRevealing<Real>& RankRevealing<Real>::operator=(RankRevealing&&) noexcept = default;
template <class Real>
RankRevealing<Real>::~RankRevealing() = default;

template <class Real>
void RankRevealing<Real>::compute(const DenseMatrix<Real>& matrix, Real threshold) {
  factor_->setThreshold(threshold);
  factor_->compute(matrix);
}

template <class Real>
DenseVector<Real> RankRevealing<Real>::solve(const DenseVector<Real>& rhs) const {
  return factor_->solve(rhs);
}

template <class Real>
DenseMatrix<Real> RankRevealing<Real>::pseudo_inverse() const {
  return factor_->pseudoInverse();
}

template <class Real>
SymmetricEigen<Real>::SymmetricEigen(const DenseMatrix<Real>& matrix) : values(matrix.rows()), vectors(matrix.rows(), matrix.cols()) {
  if (matrix.size() == 0) return;  // Eigen scales by the largest entry
  const Eigen::SelfAdjointEigenSolver<DenseMatrix<Real>> solver(matrix);
  values = solver.eigenvalues();
  vectors = solver.eigenvectors();
}

template class RankRevealing<double>;
template class RankRevealing<long double>;
template struct SymmetricEigen<double>;
template struct SymmetricEigen<long double>;

}  // namespace nsframe
