// Inverse of a small symmetric matrix of fixed size: Gauss-Jordan elimination on the diagonal, in registers; with pivoting
// (Eigen) where a pivot has lost its digits, which positive definite matrices far from singular never see.
#pragma once

#include <cmath>

#include "base/types.hpp"

namespace nsframe {

template <int n>
Eigen::Matrix<double, n, n> symmetric_inverse(const Eigen::Matrix<double, n, n>& matrix) {
  constexpr double lost = 1e-6;  // of the diagonal
  Eigen::Matrix<double, n, n> work = matrix;
  for (int k = 0; k < n; ++k) {
    const double pivot = work(k, k);
    if (!(std::abs(pivot) > lost * std::abs(matrix(k, k)))) return matrix.inverse();
    work(k, k) = 1;
    work.col(k) /= pivot;
    for (int j = 0; j < n; ++j) {
      if (j == k) continue;
      const double factor = work(k, j);
      work(k, j) = 0;
      work.col(j) -= factor * work.col(k);
    }
  }
  return work * (2 * Eigen::Matrix<double, n, n>::Identity() - matrix * work);  // Newton-Schulz: the digits that pivots cost
}

}  // namespace nsframe
