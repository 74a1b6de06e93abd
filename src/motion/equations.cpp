#include "motion/equations.hpp"

#include <cmath>
#include <stdexcept>
#include <utility>

namespace nsframe {

std::vector<double> solve_equations(std::vector<double> A, std::vector<double> b) {
  const std::size_t n = b.size();
  if (A.size() != n * n) throw std::invalid_argument("the matrix must have the size of its right-hand side");
  for (std::size_t k = 0; k < n; ++k) {
    std::size_t pivot = k;
    for (std::size_t i = k + 1; i < n; ++i)
      if (std::abs(A[i * n + k]) > std::abs(A[pivot * n + k])) pivot = i;
    if (A[pivot * n + k] == 0) throw std::invalid_argument("a system of equations is singular");
    if (pivot != k) {
      for (std::size_t j = 0; j < n; ++j) std::swap(A[k * n + j], A[pivot * n + j]);
      std::swap(b[k], b[pivot]);
    }
    for (std::size_t i = k + 1; i < n; ++i) {
      const double factor = A[i * n + k] / A[k * n + k];
      if (factor == 0) continue;
      for (std::size_t j = k; j < n; ++j) A[i * n + j] -= factor * A[k * n + j];
      b[i] -= factor * b[k];
    }
  }
  for (std::size_t k = n; k-- > 0;) {
    for (std::size_t j = k + 1; j < n; ++j) b[k] -= A[k * n + j] * b[j];
    b[k] /= A[k * n + k];
  }
  return b;
}

}  // namespace nsframe
