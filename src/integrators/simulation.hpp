// From a model to results: stability check, static loads, modes, damping, static stages, time history, summary.
#pragma once

#include "assembly/damping.hpp"
#include "integrators/static_stage.hpp"
#include "integrators/time_history.hpp"

namespace nsframe {

class Simulation {
 public:
  // Checks the model, finds the static equilibrium under gravity and pretension, the modes there, and the damping.
  // Throws InputError (unstable parts, unknown modes, impossible options) or ConvergenceError.
  Simulation(const Model& model, const AnalysisOptions& options, int modes = 12);

  // Runs the time history with the options' duration (or that of the longest motion), from the initial state.
  // Or from a snapshot, when `control` has one; the summary is that of the whole time history. The static stages come
  // first, also then: they are found again. Without duration and motion they are all. Observers see the states of `larger`, if it is
  // given, in place of those of the model here.
  Summary run(const std::vector<Observer*>& observers, const RunControl& control = {},
              const std::vector<StageObserver*>& stage_observers = {}, const LargerModel* larger = nullptr);

  System& system() { return system_; }
  const std::vector<StructureModes>& modes() const { return modes_; }
  const SparseMatrix& initial_stiffness() const { return stiffness_; }
  State& state() { return state_; }
  double duration() const;
  const Scheme& scheme() const { return *scheme_; }
  double setup_seconds() const { return setup_seconds_; }
  // Why this scheme.
  const std::string& scheme_reason() const { return scheme_reason_; }
  // With the patterns of modes filled in.
  const std::vector<StaticStage>& stages() const { return stages_; }
  // Runs stages [0, count) from the first rest; false when one cannot go on, which the last result tells.
  bool run_stages(std::size_t count, const StageControl& control, std::vector<StageResult>& results);
  // What of a summary is known before the run: sizes, frequencies, numerical damping.
  Summary outline() const;

 private:
  void check_stages_fit() const;
  // The force pattern of a mode by its name, "structure.L1".
  VectorX mode_pattern(const StaticStage& stage) const;

  const Model& model_;
  AnalysisOptions options_;
  System system_;
  State state_;
  SparseMatrix stiffness_;
  std::vector<StructureModes> modes_;
  std::unique_ptr<Scheme> scheme_;
  std::string scheme_reason_;
  std::vector<StaticStage> stages_;
  double setup_seconds_ = 0;
};

}  // namespace nsframe
