#include "integrators/static_analysis.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "base/errors.hpp"
#include "integrators/algorithms.hpp"
#include "integrators/penalty_forces.hpp"
#include "integrators/static_step.hpp"

namespace nsframe {

State virgin_state(System& system) {
  State state;
  const int size = system.model.dofs.size();
  state.displacement = state.velocity = state.acceleration = state.internal_force = VectorX::Zero(size);
  state.history = system.assembler.virgin_history();
  state.impulse = VectorX::Zero(system.contacts().size());
  state.contact_episodes = no_contact_episodes(system.contacts());
  State trial = state;
  system.assembler.start_step(state.history, trial.history);
  system.assembler.internal_force(state.displacement, state.history, trial.history, state.internal_force);
  if (system.initial_stiffness.rows() == 0) system.initial_stiffness = system.assembler.tangent();
  return state;
}

void solve_static(System& system, const VectorX& load, const StaticOptions& options, State& state) {
  const VectorX start = state.internal_force, change = load - start;
  // the norm of the internal force at the start is all that there is to compare with where pretension alone is released
  const StaticTolerance tolerance{options.tolerance, start.norm()};
  StaticStep step(system, start, change, 1);
  StaticPoint committed{state, 0};
  const double members = system.assembler.load_factor(state.history);
  double increment = 1;
  Ladder ladder({});
  std::vector<Attempt> attempts;
  for (int halvings = 0; committed.factor < 1;) {
    const double level = std::min(1.0, committed.factor + increment);
    const auto constraint = [level](const VectorX& q, double factor, StaticConstraint& c) {
      c = {factor - level, 1e-12, VectorX::Zero(q.size()), 1};
    };
    step.prepare(committed, constraint, VectorX::Zero(load.size()), 0, tolerance);
    step.set_member_loads(members + level * (1 - members));
    if (ladder.climb(step, options.max_iterations, attempts)) {
      step.trial().factor = level;
      std::swap(committed, step.trial());
      continue;
    }
    if (++halvings > options.max_halvings) {
      state = committed.state;
      throw ConvergenceError(fmt::format("static equilibrium not found at {:.4g} of the load {}{}", level,
                                         told_residual(step.relative_residual(), step.worst_element()),
                                         attempts.back().reason.empty() ? "" : ": " + attempts.back().reason));
    }
    increment /= 2;
  }
  state = std::move(committed.state);
}

}  // namespace nsframe
