#include "integrators/position_projection.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "base/errors.hpp"

namespace nsframe {

VectorX shift_to_closed(const Contacts& contacts, IterationMatrix& matrix, const std::vector<ProjectedPair>& pairs) {
  const auto count = static_cast<Eigen::Index>(pairs.size());
  ContactProblem problem{MatrixX(count, count), VectorX(count)};
  for (Eigen::Index a = 0; a < count; ++a) {
    const ProjectedPair& pair = pairs[static_cast<std::size_t>(a)];
    problem.rhs[a] = pair.opens ? pair.gap : std::max(pair.gap, 0.0);
  }
  if (count == 0 || problem.rhs.minCoeff() >= 0) return {};
  for (Eigen::Index a = 0; a < count; ++a) {
    const VectorX& rates = matrix.rates_by(contacts, pairs[static_cast<std::size_t>(a)].pair);
    for (Eigen::Index b = 0; b < count; ++b) problem.delassus(b, a) = rates[pairs[static_cast<std::size_t>(b)].pair];
  }
  const ContactSolution solution = solve_active_set(problem, {});
  if (!solution.converged) {
    throw ConvergenceError(fmt::format("the projection of penetrations did not converge (error {:.1e}), first pair {}", solution.error,
                                       contacts.pairs[static_cast<std::size_t>(pairs.front().pair)].name));
  }
  VectorX shift = VectorX::Zero(contacts.jacobian.cols());
  for (Eigen::Index a = 0; a < count; ++a) {
    matrix.response(contacts, pairs[static_cast<std::size_t>(a)].pair).add_to(solution.impulse[a], shift);
  }
  return shift;
}

}  // namespace nsframe
