#include "integrators/static_analysis.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "base/errors.hpp"

namespace nsframe {

namespace {

// Solves K x = r for a general sparse K.
VectorX solve_sparse(const SparseMatrix& K, bool symmetric, const VectorX& r) {
  if (symmetric) {
    const Eigen::SimplicialLDLT<SparseMatrix> factor(K);
    if (factor.info() == Eigen::Success) {
      const VectorX x = factor.solve(r);
      if (x.allFinite()) return x;
    }
  }
  Eigen::SparseLU<SparseMatrix> factor(K);
  if (factor.info() != Eigen::Success) throw ConvergenceError("the stiffness is singular under static loads");
  return factor.solve(r);
}

// One load level by Newton, with `members` of the loads on members; false when it does not converge. `start`: norm of the internal force of the first level, which
// is all that there is to compare with where pretension alone is released.
bool reach(System& system, const VectorX& load, double members, double start, const StaticOptions& options, const State& committed, State& trial,
           double& worst) {
  trial = committed;
  system.assembler.start_step(committed.history, trial.history);
  system.assembler.set_load_factor(members, trial.history);
  for (int iteration = 0; iteration <= options.max_iterations; ++iteration) {
    system.assembler.internal_force(trial.displacement, committed.history, trial.history, trial.internal_force);
    const VectorX residual = load - trial.internal_force;
    if (iteration == 0) start = std::max(start, trial.internal_force.norm());  // all there is where members alone are loaded
    const double scale = std::max({load.norm(), trial.internal_force.norm(), start});
    worst = residual.norm() / std::max(scale, 1e-300);
    if (residual.norm() <= options.tolerance * scale) return true;
    if (!residual.allFinite()) return false;
    trial.displacement += solve_sparse(system.assembler.tangent(), system.assembler.symmetric(), residual);
  }
  return false;
}

}  // namespace

State virgin_state(System& system) {
  State state;
  const int size = system.model.dofs.size();
  state.displacement = state.velocity = state.acceleration = state.internal_force = VectorX::Zero(size);
  state.history = system.assembler.virgin_history();
  state.impulse = VectorX::Zero(system.contacts().size());
  State trial = state;
  system.assembler.start_step(state.history, trial.history);
  system.assembler.internal_force(state.displacement, state.history, trial.history, state.internal_force);
  return state;
}

void solve_static(System& system, const VectorX& load, const StaticOptions& options, State& state) {
  const VectorX start = state.internal_force;
  const double members = system.assembler.load_factor(state.history);
  double reached = 0, increment = 1;
  State trial = state;
  for (int halvings = 0; reached < 1;) {
    const double level = std::min(1.0, reached + increment);
    double worst = 0;
    bool converged = false;
    std::string reason;
    try {
      converged = reach(system, start + level * (load - start), members + level * (1 - members), start.norm(), options, state, trial, worst);
    } catch (const ConvergenceError& problem) {
      reason = std::string(": ") + problem.what();
    }
    if (converged) {
      std::swap(state, trial);
      reached = level;
      continue;
    }
    if (++halvings > options.max_halvings) {
      throw ConvergenceError(fmt::format("static equilibrium not found at {:.4g} of the load (relative residual {:.1e}), "
                                         "largest in element '{}'{}",
                                         level, worst, system.assembler.worst_element(load - trial.internal_force), reason));
    }
    increment /= 2;
  }
}

}  // namespace nsframe
