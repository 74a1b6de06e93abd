#include "contact/contact_problem.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "base/decompositions.hpp"

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

namespace {

// Error that rounding of the impulses alone makes: large where impulses are, as below a heavy mass on a light one.
double rounding_error(const ContactProblem& problem, const VectorX& impulse) {
  const double rates = (problem.delassus.cwiseAbs() * impulse).maxCoeff();
  const double scale = std::max(problem.rhs.cwiseAbs().maxCoeff(), std::numeric_limits<double>::min());
  return 16 * static_cast<double>(impulse.size()) * std::numeric_limits<double>::epsilon() * rates / scale;
}

// Minimum-norm solution of W_AA p_A = -rhs_A on the active pairs; W_AA may be singular. W is scaled to unit diagonal.
VectorX solve_on(const std::vector<Eigen::Index>& active, const MatrixX& W, const VectorX& rhs) {
  if (active.size() == 1) return VectorX::Constant(1, -rhs[active[0]] / W(active[0], active[0]));
  Eigen::CompleteOrthogonalDecomposition<MatrixX> factor;
  factor.setThreshold(1e-12);
  factor.compute(MatrixX(W(active, active)));
  return factor.solve(VectorX(-rhs(active)));
}

}  // namespace

ContactSolution solve_active_set(const ContactProblem& problem, const ContactOptions& options) {
  const Eigen::Index n = problem.rhs.size();
  ContactSolution solution;
  if (n == 0) return {VectorX(0), 0, 0, true};
  // unit diagonal, so that pairs between heavy and between light bodies weigh the same
  const VectorX scale = problem.delassus.diagonal().cwiseSqrt().cwiseInverse();
  const MatrixX W = scale.asDiagonal() * problem.delassus * scale.asDiagonal();
  const VectorX rhs = scale.cwiseProduct(problem.rhs);
  VectorX p = VectorX::Zero(n);
  std::vector<bool> is_active(static_cast<std::size_t>(n), false);
  const double tolerance = 4 * static_cast<double>(n) * std::numeric_limits<double>::epsilon() * rhs.cwiseAbs().maxCoeff();
  const int limit = std::min(options.max_iterations, 100 + 10 * static_cast<int>(n));
  for (solution.iterations = 0; solution.iterations < limit; ++solution.iterations) {
    const VectorX rate = W * p + rhs;
    Eigen::Index worst = -1;
    double least = -tolerance * (1 + p.cwiseAbs().maxCoeff() / std::max(rhs.cwiseAbs().maxCoeff(), 1e-300));
    for (Eigen::Index i = 0; i < n; ++i) {
      if (!is_active[static_cast<std::size_t>(i)] && rate[i] < least) {
        least = rate[i];
        worst = i;
      }
    }
    if (worst < 0) break;
    is_active[static_cast<std::size_t>(worst)] = true;
    // move to the minimum on the active set; a pair that would pull leaves it on the way
    for (Eigen::Index guard = 0; guard <= n; ++guard) {
      std::vector<Eigen::Index> active;
      for (Eigen::Index i = 0; i < n; ++i) {
        if (is_active[static_cast<std::size_t>(i)]) active.push_back(i);
      }
      if (active.empty()) break;
      const VectorX wanted = solve_on(active, W, rhs);
      double step = 1;
      for (std::size_t k = 0; k < active.size(); ++k) {
        const double now = p[active[k]], then = wanted[static_cast<Eigen::Index>(k)];
        if (then < 0) step = std::min(step, now / (now - then));
      }
      for (std::size_t k = 0; k < active.size(); ++k) {
        double& value = p[active[k]];
        value += step * (wanted[static_cast<Eigen::Index>(k)] - value);
        if (step < 1 && wanted[static_cast<Eigen::Index>(k)] < 0 && value <= 1e-15 * std::abs(wanted[static_cast<Eigen::Index>(k)])) {
          value = 0;
          is_active[static_cast<std::size_t>(active[k])] = false;
        }
      }
      if (step >= 1) break;
    }
  }
  solution.impulse = scale.cwiseProduct(p.cwiseMax(0.0));
  solution.error = complementarity_error(problem, solution.impulse);
  // redundant or badly scaled pairs: a few sweeps polish what rounding left
  if (solution.error > options.tolerance) {
    ContactOptions polish = options;
    polish.max_iterations = 100;
    ContactSolution polished = solve_gauss_seidel(problem, polish, solution.impulse);
    if (polished.error < solution.error) {
      solution.impulse = std::move(polished.impulse);
      solution.error = polished.error;
    }
  }
  solution.converged = solution.error <= std::max(options.tolerance, rounding_error(problem, solution.impulse));
  return solution;
}

}  // namespace nsframe
