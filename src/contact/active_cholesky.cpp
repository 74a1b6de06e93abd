#include "contact/active_cholesky.hpp"

#include <Eigen/Jacobi>
#include <cmath>

namespace nsframe {

double ActiveCholesky::coefficients(Eigen::Index c, VectorX& d) {
  const Eigen::Index k = size();
  row_.resize(k);
  for (Eigen::Index i = 0; i < k; ++i) row_[i] = W_(pairs_[static_cast<std::size_t>(i)], c);
  const auto L = L_.topLeftCorner(k, k).triangularView<Eigen::Lower>();
  L.solveInPlace(row_);
  d = row_;
  L.transpose().solveInPlace(d);
  return W_(c, c) - row_.squaredNorm();
}

void ActiveCholesky::add(Eigen::Index c, double left) {
  const Eigen::Index k = size();
  L_.row(k).head(k) = row_.transpose();
  L_(k, k) = std::sqrt(left);
  pairs_.push_back(c);
}

void ActiveCholesky::remove(Eigen::Index place) {
  const Eigen::Index k = size();
  pairs_.erase(pairs_.begin() + place);
  for (Eigen::Index i = place; i + 1 < k; ++i) L_.row(i).head(i + 2) = L_.row(i + 1).head(i + 2);
  // rotations of neighbouring columns make the factor lower again
  for (Eigen::Index j = place; j + 1 < k; ++j) {
    Eigen::JacobiRotation<double> rotation;
    rotation.makeGivens(L_(j, j), L_(j, j + 1));
    L_.middleRows(j, k - 1 - j).applyOnTheRight(j, j + 1, rotation);
    if (L_(j, j) < 0) L_.col(j).segment(j, k - 1 - j) *= -1;
  }
}

void ActiveCholesky::solve(VectorX& x) const {
  const auto L = L_.topLeftCorner(size(), size()).triangularView<Eigen::Lower>();
  L.solveInPlace(x);
  L.transpose().solveInPlace(x);
}

}  // namespace nsframe
