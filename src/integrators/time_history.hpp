// Runs a scheme over time: halves steps that do not converge, sums energies, collects impacts, calls observers, and
// takes the snapshots from which a run goes on later.
#pragma once

#include <functional>

#include "integrators/run_sums.hpp"
#include "integrators/scheme.hpp"
#include "integrators/shown_states.hpp"

namespace nsframe {

inline constexpr std::size_t most_ladder_records = 200;

struct TimeHistoryResult : RunSums {
  std::vector<Impact> impacts;
  std::vector<LadderRecord> ladder;  // of the first laddered_steps, at most most_ladder_records
  bool completed = false;
  bool interrupted = false;          // stop_requested() said so
  std::string stop_reason;
  double begin_seconds = 0, step_seconds = 0, observer_seconds = 0;  // before the first step, of the steps, of the observers
};

// Stopping early and going on later; with the defaults, a run does neither.
struct RunControl {
  const Snapshot* resume = nullptr;                   // go on from here
  std::function<bool()> stop_requested;               // looked at after every step
  std::function<void(const Snapshot&)> keep_snapshot;  // called at the end, however it comes, and in between:
  double snapshot_interval = 0;                       // of wall-clock time [s]; 0: only at the end
};

// Throws InputError when a snapshot is beyond the end of a time history of that duration.
void check_duration(const Snapshot& snapshot, double duration);

// Steps of options.dt from state.time over `duration`; `state` ends at the last accepted step, also when a step
// could not be made to converge: then `completed` is false and stop_reason says where. A run that goes on from a
// snapshot ends at the same time as one from the start, with the same bits in results and observers. These see the states of
// `larger`, if it is given, in place of those of the system's model.
TimeHistoryResult run_time_history(System& system, Scheme& scheme, const AnalysisOptions& options, double duration,
                                   State& state, const std::vector<Observer*>& observers,
                                   const RunControl& control = {}, const LargerModel* larger = nullptr);

}  // namespace nsframe
