// Eigen's decompositions of dynamic size. The long functions are compiled once (decompositions.cpp): each takes the
// compiler seconds wherever it is met anew.
#pragma once

#include <memory>

#include "base/types.hpp"

namespace nsframe {

constexpr int dense_eigen_limit = 300;  // rows up to which all eigenvalues are found at once

template <class Real>
using DenseMatrix = Eigen::Matrix<Real, Eigen::Dynamic, Eigen::Dynamic>;
template <class Real>
using DenseVector = Eigen::Matrix<Real, Eigen::Dynamic, 1>;

// Complete orthogonal decomposition of a matrix that may lack rank (redundant contacts). Real: double or long double.
template <class Real>
class RankRevealing {
 public:
  RankRevealing();
  // threshold: pivots below it times the largest count as zero
  RankRevealing(const DenseMatrix<Real>& matrix, Real threshold);
  RankRevealing(RankRevealing&&) noexcept;
  RankRevealing& operator=(RankRevealing&&) noexcept;
  ~RankRevealing();

  void compute(const DenseMatrix<Real>& matrix, Real threshold);
  DenseVector<Real> solve(const DenseVector<Real>& rhs) const;  // of least squares, of these the shortest
  DenseMatrix<Real> pseudo_inverse() const;

 private:
  std::unique_ptr<Eigen::CompleteOrthogonalDecomposition<DenseMatrix<Real>>> factor_;
};

// All eigenvalues of a symmetric matrix, from the lowest, and its orthonormal eigenvectors (columns). Real: double or long double.
template <class Real>
struct SymmetricEigen {
  explicit SymmetricEigen(const DenseMatrix<Real>& matrix);
  DenseVector<Real> values;
  DenseMatrix<Real> vectors;
};

}  // namespace nsframe

namespace Eigen {

extern template void SparseLU<nsframe::SparseMatrix>::analyzePattern(const nsframe::SparseMatrix&);
extern template void SparseLU<nsframe::SparseMatrix>::factorize(const nsframe::SparseMatrix&);
extern template void PartialPivLU<nsframe::MatrixX>::compute();
extern template LLT<nsframe::MatrixX>& LLT<nsframe::MatrixX>::compute(const EigenBase<nsframe::MatrixX>&);

extern template GeneralizedSelfAdjointEigenSolver<nsframe::MatrixX>&
GeneralizedSelfAdjointEigenSolver<nsframe::MatrixX>::compute(const nsframe::MatrixX&, const nsframe::MatrixX&, int);
extern template EigenSolver<nsframe::MatrixX>& EigenSolver<nsframe::MatrixX>::compute(const EigenBase<nsframe::MatrixX>&,
                                                                                       bool);

}  // namespace Eigen
