#include "contact/contact_problem.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace nsframe {

double complementarity_error(const ContactProblem& problem, const VectorX& impulse) {
  if (problem.rhs.size() == 0) return 0;
  const VectorX rate = problem.delassus * impulse + problem.rhs;
  const double scale = std::max(problem.rhs.cwiseAbs().maxCoeff(), std::numeric_limits<double>::min());
  double error = 0;
  for (Eigen::Index i = 0; i < rate.size(); ++i) {
    error = std::max(error, std::abs(std::min(impulse[i] * problem.delassus(i, i), rate[i])));
  }
  return error / scale;
}

double rounding_error(const ContactProblem& problem, const VectorX& impulse) {
  if (problem.rhs.size() == 0) return 0;
  const double rates = problem.delassus.cwiseAbs().lazyProduct(impulse.cwiseAbs()).maxCoeff();
  const double scale = std::max(problem.rhs.cwiseAbs().maxCoeff(), std::numeric_limits<double>::min());
  return 16 * static_cast<double>(impulse.size()) * std::numeric_limits<double>::epsilon() * rates / scale;
}

ContactSolution solve_gauss_seidel(const ContactProblem& problem, const ContactOptions& options, VectorX guess) {
  ContactSolution solution;
  solution.impulse = std::move(guess);
  VectorX& p = solution.impulse;
  const MatrixX& W = problem.delassus;
  const Eigen::Index n = p.size();
  for (solution.iterations = 1; solution.iterations <= options.max_iterations; ++solution.iterations) {
    for (Eigen::Index a = 0; a < n; ++a) {
      const double rate = W.col(a).dot(p) + problem.rhs[a];
      p[a] = std::max(0.0, p[a] - rate / W(a, a));
    }
    solution.error = complementarity_error(problem, p);
    if (solution.error <= options.tolerance) {
      solution.converged = true;
      break;
    }
  }
  return solution;
}

}  // namespace nsframe
