#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "base/decompositions.hpp"
#include "contact/contact_problem.hpp"

namespace nsframe {

namespace {

// Minimum-norm solution of W_AA p_A = -rhs_A on the active pairs; W_AA may be singular. W is scaled to unit diagonal.
VectorX solve_on(const std::vector<Eigen::Index>& active, const MatrixX& W, const VectorX& rhs) {
  if (active.size() == 1) return VectorX::Constant(1, -rhs[active[0]] / W(active[0], active[0]));
  return RankRevealing<double>(W(active, active), 1e-12).solve(-rhs(active));
}

}  // namespace

ContactSolution solve_lawson_hanson(const ContactProblem& problem, const ContactOptions& options) {
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
