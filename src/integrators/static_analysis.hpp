// Static equilibrium P(q) = load, by the ladder of solution algorithms with load increments.
#pragma once

#include "assembly/system.hpp"

namespace nsframe {

struct StaticOptions {
  double tolerance = 1e-10;  // residual relative to the load or the internal forces
  int max_iterations = 50;
  int max_halvings = 10;     // of the load increment
};

// Brings `state` (displacement, history, internal force) into equilibrium with `load` [N]. Velocities are not used.
// Throws ConvergenceError that names the element with the largest residual.
void solve_static(System& system, const VectorX& load, const StaticOptions& options, State& state);

// The virgin state at zero displacement.
State virgin_state(System& system);

}  // namespace nsframe
