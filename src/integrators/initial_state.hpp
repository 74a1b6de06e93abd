// Where a model stands at t = 0: at rest under gravity, loads on members and pretension, then displaced as the scene asks.
#pragma once

#include "assembly/system.hpp"

namespace nsframe {

// From the virgin state; sets system.static_load, and the assembler's tangent is that of the rest. Throws InputError where gravity
// acts statically on what may move freely, ConvergenceError where no rest is found.
void find_initial_state(System& system, State& state);

}  // namespace nsframe
