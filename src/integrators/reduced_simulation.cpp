#include "integrators/reduced_simulation.hpp"

#include <fmt/format.h>

namespace nsframe {

ReducedSimulation::ReducedSimulation(const Model& model, const AnalysisOptions& options) : model_(model) {
  const Model* used = &model;
  if (model.drives_dofs()) {
    larger_.emplace().model = &model;
    held_ = without_moved_supports(model, larger_->reduction);
    used = &held_;
  }
  AnalysisOptions chosen = options;
  if (options.scheme != "moreau-jean" && options.scheme != "event-split") {
    simulation_.emplace(*used, options);
    if (simulation_->scheme().condenses_massless()) return;
    chosen.scheme = simulation_->scheme().name();
    chosen.scheme_reason = simulation_->scheme_reason();
  }
  condensation_ = find_condensation(*used);
  if (condensation_.condensed == 0) {
    if (!simulation_) simulation_.emplace(*used, options);
    return;
  }
  smaller_ = reduced_model(*used, condensation_.reduction);
  larger_ = LargerModel{&model, larger_ ? larger_->reduction.then(condensation_.reduction) : condensation_.reduction};
  simulation_.reset();
  simulation_.emplace(smaller_, chosen);
}

Summary ReducedSimulation::run(const std::vector<Observer*>& observers, const RunControl& control, const std::vector<StageObserver*>& stage_observers) {
  Summary summary = simulation_->run(observers, control, stage_observers, larger_ ? &*larger_ : nullptr);
  summary.dofs = held().dofs.size();
  StoredEntries entries = simulation_->system().assembler.stiffness_entries();
  summary.savings.stored_entries = (entries += simulation_->scheme().factor_entries()).stored_share();
  summary.savings.massless_dofs = condensation_.candidates;
  summary.savings.condensed_dofs = condensation_.condensed;
  if (condensation_.condensed > 0) {
    summary.savings.condensed_entries = static_cast<double>(condensation_.entries_after) / static_cast<double>(condensation_.entries_before);
  }
  return summary;
}

const Model& ReducedSimulation::held() const { return model_.drives_dofs() ? held_ : model_; }

std::vector<std::string> ReducedSimulation::describe() const {
  std::vector<std::string> lines = simulation_->scheme().describe();
  if (condensation_.condensed > 0) {
    lines.push_back(fmt::format("DOFs without mass condensed: {} of {}; factors and stiffness keep {:.0f} % of their entries", condensation_.condensed,
                                held().dofs.size(), 100.0 * static_cast<double>(condensation_.entries_after) / static_cast<double>(condensation_.entries_before)));
  } else if (condensation_.candidates > 0) {
    lines.push_back(fmt::format("{} DOFs without mass are kept: {}", condensation_.candidates,
                                condensation_.kept_for_arcs ? "the arc length of static stages counts them"
                                                            : "condensed, the matrices would lose less than a quarter of their entries"));
  }
  return lines;
}

}  // namespace nsframe
