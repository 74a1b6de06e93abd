// Runs a static stage: a load pattern beside the constant loads, led on by a control, each point by the ladder of solution
// algorithms, with smaller increments where none of them converges.
#pragma once

#include <functional>

#include "integrators/static_step.hpp"
#include "models/results.hpp"

namespace nsframe {

struct StageControl {
  std::vector<std::string> algorithms;            // the ladder
  std::vector<StageObserver*> observers;
  std::function<bool()> stop_requested;           // looked at after every point; may be empty
};

// Goes on from `state` under system.static_load; both end at the last point found, the stage's load added to the latter.
// A stage that cannot go on has `completed` false and says why.
StageResult run_stage(System& system, const StaticStage& stage, const StageControl& control, State& state);

}  // namespace nsframe
