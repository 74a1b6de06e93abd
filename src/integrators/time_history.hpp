// Runs a scheme over time: halves steps that do not converge, sums energies, collects impacts, calls observers.
#pragma once

#include "integrators/scheme.hpp"

namespace nsframe {

struct TimeHistoryResult {
  int steps = 0;
  long newton_iterations = 0, halved_steps = 0;
  Energy energy;
  double worst_balance_error = 0;    // relative to the largest energy so far
  double max_penetration = 0;        // [m]
  double max_complementarity_error = 0;
  std::vector<Impact> impacts;
  bool completed = false;
  std::string stop_reason;
  double step_seconds = 0, observer_seconds = 0;
};

// Steps of options.dt from state.time over `duration`; `state` ends at the last accepted step, also when a step
// could not be made to converge: then `completed` is false and stop_reason says where.
TimeHistoryResult run_time_history(System& system, Scheme& scheme, const AnalysisOptions& options, double duration,
                                   State& state, const std::vector<Observer*>& observers);

}  // namespace nsframe
