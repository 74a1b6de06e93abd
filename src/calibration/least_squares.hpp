// Levenberg and Marquardt's method with bounds: least |r(x)|^2 for lower <= x <= upper (theory.md, 330 to 333).
#pragma once

#include <functional>
#include <optional>

#include "base/types.hpp"

namespace nsframe {

struct Residuals {
  VectorX value;
  MatrixX jacobian;
};

struct LeastSquaresOptions {
  int max_iterations = 50;
  double gradient = 1e-8;    // converged: cosine between r and every column of J that may still move
  double residual = 1e-10;   // converged: |r|
  double largest_step = 0.7; // of a component, in one iteration
};

struct LeastSquaresResult {
  VectorX x;
  Residuals residuals;
  int iterations = 0, rejected = 0;
  bool converged = false;
  double cosine = 0;  // the largest that is left
};

// `value` gives r at a trial point, or nothing where the point cannot be used: the step is then shortened. `jacobian` is asked for at
// points whose value was accepted, the first included, in that order.
struct LeastSquaresProblem {
  std::function<std::optional<VectorX>(const VectorX& x)> value;
  std::function<MatrixX(const VectorX& x)> jacobian;
  VectorX lower, upper;
};

// Throws std::invalid_argument where there is no value at `start`.
LeastSquaresResult solve_least_squares(const LeastSquaresProblem& problem, const VectorX& start, const LeastSquaresOptions& options);

}  // namespace nsframe
