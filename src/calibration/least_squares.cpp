#include "calibration/least_squares.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "base/decompositions.hpp"

namespace nsframe {

namespace {

// Components that a descent may move: not those at a bound that the gradient pushes against.
std::vector<Eigen::Index> free_components(const LeastSquaresProblem& problem, const VectorX& x, const VectorX& gradient) {
  std::vector<Eigen::Index> out;
  for (Eigen::Index i = 0; i < x.size(); ++i) {
    const bool held = (x[i] <= problem.lower[i] && gradient[i] > 0) || (x[i] >= problem.upper[i] && gradient[i] < 0);
    if (!held) out.push_back(i);
  }
  return out;
}

double largest_cosine(const Residuals& r, const VectorX& gradient, const std::vector<Eigen::Index>& free) {
  const double norm = r.value.norm();
  double largest = 0;
  for (const Eigen::Index i : free) {
    const double column = r.jacobian.col(i).norm();
    if (column > 0 && norm > 0) largest = std::max(largest, std::abs(gradient[i]) / (column * norm));
  }
  return largest;
}

// (J'J + mu D^2) step = -g in the free components.
VectorX damped_step(const Residuals& r, const VectorX& gradient, const VectorX& scale, double damping,
                    const std::vector<Eigen::Index>& free) {
  const MatrixX J = r.jacobian(Eigen::all, free);
  const VectorX weight = scale(free);
  MatrixX A = J.transpose() * J;
  A.diagonal() += damping * weight.cwiseAbs2();
  const Eigen::LLT<MatrixX> factor(A);
  VectorX step = VectorX::Zero(gradient.size());
  const VectorX right = -gradient(free), solution = factor.solve(right);
  step(free) = solution;
  return step;
}

}  // namespace

LeastSquaresResult solve_least_squares(const LeastSquaresProblem& problem, const VectorX& start, const LeastSquaresOptions& options) {
  LeastSquaresResult result;
  result.x = start.cwiseMax(problem.lower).cwiseMin(problem.upper);
  const auto first = problem.value(result.x);
  if (!first) throw std::invalid_argument("no value at the start");
  result.residuals = {*first, problem.jacobian(result.x)};
  VectorX scale = VectorX::Zero(start.size());
  double damping = 1e-3, growth = 2;
  constexpr double least_damping = 1e-10, least_step = 1e-12;
  while (true) {
    Residuals& r = result.residuals;
    const VectorX gradient = r.jacobian.transpose() * r.value;
    const std::vector<Eigen::Index> free = free_components(problem, result.x, gradient);
    result.cosine = largest_cosine(r, gradient, free);
    result.converged = r.value.norm() <= options.residual || result.cosine <= options.gradient;
    if (result.converged || result.iterations == options.max_iterations) return result;
    // a column that is all zero gets the scale of the others, and a gradient of zero keeps its component where it is
    scale = scale.cwiseMax(r.jacobian.colwise().norm().transpose());
    const VectorX used = scale.cwiseMax(1e-8 * scale.maxCoeff());
    ++result.iterations;
    for (bool accepted = false; !accepted;) {
      VectorX step = damped_step(r, gradient, used, damping, free);
      const double longest = step.cwiseAbs().maxCoeff();
      if (longest > options.largest_step) step *= options.largest_step / longest;
      const VectorX trial = (result.x + step).cwiseMax(problem.lower).cwiseMin(problem.upper);
      step = trial - result.x;
      // shorter steps would be rounding: what is left of the gradient decides
      if (!(step.cwiseAbs().maxCoeff() > least_step)) {
        result.converged = result.cosine <= std::sqrt(options.gradient);
        return result;
      }
      const auto value = problem.value(trial);
      const double predicted = -(gradient.dot(step) + 0.5 * (r.jacobian * step).squaredNorm());
      const double actual = value ? 0.5 * (r.value.squaredNorm() - value->squaredNorm()) : -1;
      const double ratio = predicted > 0 ? actual / predicted : -1;
      accepted = actual > 0 && ratio > 1e-4;
      if (accepted) {
        result.x = trial;
        r.value = *value;
        r.jacobian = problem.jacobian(trial);
        damping = std::max(least_damping, damping * std::max(1.0 / 3, 1 - std::pow(2 * ratio - 1, 3)));
        growth = 2;
      } else {
        ++result.rejected;
        damping = std::max(damping, 1e-6) * growth;
        growth *= 2;
      }
    }
  }
}

}  // namespace nsframe
