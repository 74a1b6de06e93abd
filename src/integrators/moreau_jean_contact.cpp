// Restitution and friction of the theta scheme where several pairs collide at once (theory.md, 270-279).
#include "base/errors.hpp"
#include "contact/friction.hpp"
#include "contact/impact_law.hpp"
#include "integrators/moreau_jean.hpp"

namespace nsframe {

VectorX MoreauJean::target_rates(const System& system, const MatrixX& delassus) const {
  const VectorX before = rate_(active_), e = system.contacts().restitution(active_);
  if (options_.impact_law == ImpactLaw::newton) return -e.cwiseProduct(before);
  const ContactOptions options{options_.contact_tolerance, options_.max_contact_sweeps};
  const PoissonImpact impact = poisson_impact(delassus, before, e, [&](const ContactProblem& problem) {
    ContactSolution solution = solve_active_set(problem, options);
    if (!solution.converged) throw ConvergenceError("the contact problem of Poisson's law did not converge");
    return solution.impulse;
  });
  return (impact.impulse.array() > 0).select(impact.rate, 0.0);
}

// Rows 3i, 3i + 1, 3i + 2: normal and tangents of active pair i. `problem` comes with the normals and leaves with all rows of W.
ContactSolution MoreauJean::solve_with_friction(const System& system, ContactProblem& problem, const State& trial) {
  const Contacts& contacts = system.contacts();
  const auto count = static_cast<Eigen::Index>(active_.size());
  FrictionProblem all{MatrixX::Zero(3 * count, 3 * count), VectorX::Zero(3 * count), contacts.friction(active_)};
  VectorX guess(3 * count);
  for (Eigen::Index a = 0; a < count; ++a) {
    const int pair = active_[static_cast<std::size_t>(a)];
    guess[3 * a] = impulse_[a];
    guess.segment<2>(3 * a + 1) = friction_impulse_.segment<2>(2 * a);
    all.rhs[3 * a] = problem.rhs[a];
    for (Eigen::Index b = 0; b < count; ++b) all.delassus(3 * a, 3 * b) = problem.delassus(a, b);
    if (contacts.friction[pair] == 0) continue;
    for (int k = 0; k < 2; ++k) {
      const auto tangent = contacts.tangents.row(2 * pair + k);
      const Eigen::Index row = 3 * a + 1 + k;
      all.rhs[row] = tangent.dot(trial.velocity);
      for (Eigen::Index b = 0; b < count; ++b) {
        const int other = active_[static_cast<std::size_t>(b)];
        all.delassus(row, 3 * b) = matrix_.response(contacts, other).rate(contacts.tangents, 2 * pair + k);
        all.delassus(3 * b, row) = matrix_.tangent_response(contacts, 2 * pair + k).rate(contacts.jacobian, other);
        for (int l = 0; l < 2 && contacts.friction[other] > 0; ++l) {
          all.delassus(row, 3 * b + 1 + l) = matrix_.tangent_response(contacts, 2 * other + l).rate(contacts.tangents, 2 * pair + k);
        }
      }
    }
  }
  ContactSolution solution = solve_friction(all, {options_.contact_tolerance, options_.max_contact_sweeps}, std::move(guess));
  VectorX normal(count);
  for (Eigen::Index a = 0; a < count; ++a) {
    normal[a] = solution.impulse[3 * a];
    friction_impulse_.segment<2>(2 * a) = solution.impulse.segment<2>(3 * a + 1);
  }
  solution.impulse = std::move(normal);
  problem.delassus = std::move(all.delassus);
  return solution;
}

void MoreauJean::add_friction(const Contacts& contacts, double factor, VectorX& momentum) const {
  for (Eigen::Index i = 0; i < friction_impulse_.size(); ++i) {
    if (friction_impulse_[i] == 0) continue;
    const int row = 2 * active_[static_cast<std::size_t>(i / 2)] + static_cast<int>(i % 2);
    momentum += factor * friction_impulse_[i] * contacts.tangents.row(row).transpose();
  }
}

void MoreauJean::add_friction_response(const Contacts& contacts, double factor, VectorX& velocity) {
  for (Eigen::Index i = 0; i < friction_impulse_.size(); ++i) {
    if (friction_impulse_[i] == 0) continue;
    const int row = 2 * active_[static_cast<std::size_t>(i / 2)] + static_cast<int>(i % 2);
    matrix_.tangent_response(contacts, row).add_to(factor * friction_impulse_[i], velocity);
  }
}

void MoreauJean::report_simultaneous(const System& system, const State& committed, const State& trial, double h, StepResult& result) const {
  const Contacts& contacts = system.contacts();
  if (active_.empty() || impulse_.maxCoeff() <= 0) return;
  const int rows = contacts.frictional() ? 3 : 1;
  const auto count = static_cast<Eigen::Index>(active_.size());
  VectorX impulse = VectorX::Zero(rows * count), before = impulse, after = impulse;
  for (Eigen::Index a = 0; a < count; ++a) {
    const int pair = active_[static_cast<std::size_t>(a)];
    impulse[rows * a] = impulse_[a];
    before[rows * a] = rate_[pair];
    after[rows * a] = contacts.jacobian.row(pair).dot(trial.velocity) + (support_rate_.size() > 0 ? support_rate_[pair] : 0);
    if (rows == 1 || contacts.friction[pair] == 0 || impulse_[a] <= 0) continue;
    Slip slip{pair};
    Vector2 path;
    for (int k = 0; k < 2; ++k) {
      const auto tangent = contacts.tangents.row(2 * pair + k);
      const Eigen::Index row = rows * a + 1 + k;
      impulse[row] = friction_impulse_[2 * a + k];
      before[row] = tangent.dot(committed.velocity);
      after[row] = tangent.dot(trial.velocity);
      path[k] = h * tangent.dot(mid_velocity_);
      slip.energy -= 0.5 * impulse[row] * (before[row] + after[row]);
      result.numerical -= impulse[row] * (after[row] - before[row]);
    }
    slip.distance = path.norm();
    result.friction += slip.energy;
    result.slips.push_back(slip);
  }
  result.created = created_energy(delassus_, impulse, before, after);
}

}  // namespace nsframe
