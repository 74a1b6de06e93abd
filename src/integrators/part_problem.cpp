#include "integrators/part_problem.hpp"

namespace nsframe {

PartProblem::PartProblem(const Tools& tools, double s, const Motion& start, const VectorX& committed, VectorX& trial, StepResult& result)
    : tools_(tools), s_(s), a_(tools.flow.rule().theta * s), committed_(committed), trial_(trial), result_(result), guess_(tools.flow.shift(s)) {
  const VectorX unbent = s * tools.flow.mean_velocity(s) - guess_;
  reached_ = start.q + unbent;
  known_ = start.P;
  known_.noalias() += tools.rest.stiffness * unbent;
  const SparseMatrix& M = tools.system.mass();
  VectorX end;
  tools.flow.velocity(s, end);
  const double moving = std::max(start.v.dot(M * start.v), end.dot(M * end));
  const double still = negligible_acceleration * s;
  scale_ = s * std::sqrt(moving + still * still * M.diagonal().sum());
  tools.tangent.in_use = tools.tangent.in_use && tools.tangent.own.matrix.ready(a_);
  if (tools.tangent.in_use) tools.tangent.held.hold(tools.system.contacts(), tools.flow.held().pairs());
}

void PartProblem::restart() {
  tools_.system.assembler.start_step(committed_, trial_);
  x = guess_;
  evaluate(false, determination());
}

void PartProblem::settle() {
  if (tools_.system.assembler.unsettled()) evaluate(false, StateDetermination::remaining);
}

void PartProblem::evaluate(bool with_tangent, StateDetermination how) {
  System& system = tools_.system;
  system.assembler.internal_force(reached_ + x, committed_, trial_, P, with_tangent, how);
  if (how != StateDetermination::remaining) ++result_.evaluations;
  residual_ = P - known_;
  residual_.noalias() += (1 / (a_ * a_)) * (system.mass() * x);
  system.damping.add_force(system.assembler.blocks(), 1 / a_, x, residual_);
  corrected_ = false;
  solve(residual_, correction_);
  corrected_ = true;
  result_.residual = a_ * std::sqrt(std::abs(correction_.dot(residual_))) / std::max(scale_, 1e-300);
}

void PartProblem::factor(Tangent which) {
  System& system = tools_.system;
  if (which == Tangent::current && !system.assembler.tangent_is_current()) evaluate(true, determination());
  FactoredStiffness& own = tools_.tangent.own;
  own.stiffness = which == Tangent::initial ? system.initial_stiffness : system.assembler.tangent();
  tools_.tangent.in_use = false;
  own.matrix.factor(system, own.stiffness, a_);
  tools_.tangent.held.hold(system.contacts(), tools_.flow.held().pairs());
  tools_.tangent.in_use = true;
  corrected_ = false;
}

void PartProblem::solve_at_rest(const VectorX& rhs, VectorX& solution) {
  const Contacts& contacts = tools_.system.contacts();
  HeldSolution& held = tools_.flow.held();
  VectorX left = rhs, followed;
  forces.setZero(static_cast<Eigen::Index>(held.pairs().size()));
  if (tools_.impact.any_massless()) {
    followed = tools_.impact.follow(contacts, held.pairs(), rhs, &forces);
    left.noalias() -= tools_.rest.stiffness * followed;
    for (std::size_t k = 0; k < held.pairs().size(); ++k) {
      const double force = forces[static_cast<Eigen::Index>(k)];
      for (SparseRows::InnerIterator entry(contacts.jacobian, held.pairs()[k]); entry; ++entry) left[entry.col()] += force * entry.value();
    }
    for (Eigen::Index i = 0; i < left.size(); ++i) {
      if (tools_.impact.massless(i)) left[i] = 0;
    }
  }
  VectorX others;
  held.solve((a_ * a_) * left, solution, &others);
  forces = -forces - others / (a_ * a_);
  if (followed.size() > 0) solution += followed;
}

void PartProblem::solve(const VectorX& rhs, VectorX& solution) {
  if (corrected_ && &rhs == &residual_) {
    solution = correction_;
    return;
  }
  ++result_.solves;
  if (!tools_.tangent.in_use) return solve_at_rest(rhs, solution);
  tools_.tangent.held.solve((a_ * a_) * rhs, solution, &forces);
  forces *= -1 / (a_ * a_);
}

void PartProblem::move(const VectorX& change) {
  x += change;
  evaluate(false, determination());
}

}  // namespace nsframe
