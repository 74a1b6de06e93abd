#include "integrators/reduced_simulation.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace nsframe {

namespace {

// Shows observers the states of the larger model.
class ExpandedStates : public Observer {
 public:
  ExpandedStates(const Model& model, const Reduction& reduction, const std::vector<Observer*>& observers)
      : model_(model), reduction_(reduction), observers_(observers) {}

  void start(const Model&, const State& state) override {
    after_ = reduction_.expand(state, model_.motions);
    for (Observer* observer : observers_) observer->start(model_, after_);
  }
  void step(const State&, const State& after, const StepReport& report, const Energy& energy) override {
    std::swap(before_, after_);  // one step begins where the last one ended
    after_ = reduction_.expand(after, model_.motions);
    StepReport expanded = report;
    for (VelocityJump& jump : expanded.jumps) jump.change = reduction_.expand_change(jump.change);
    for (Observer* observer : observers_) observer->step(before_, after_, expanded, energy);
  }
  void impact(const Impact& impact) override {
    for (Observer* observer : observers_) observer->impact(impact);
  }
  void finish() override {
    for (Observer* observer : observers_) observer->finish();
  }
  void save(Snapshot& snapshot) override {
    for (Observer* observer : observers_) observer->save(snapshot);
  }
  void resume(const Model&, const State& state, const Snapshot& snapshot) override {
    after_ = reduction_.expand(state, model_.motions);
    for (Observer* observer : observers_) observer->resume(model_, after_, snapshot);
  }

 private:
  const Model& model_;
  const Reduction& reduction_;
  const std::vector<Observer*>& observers_;
  State before_, after_;
};

class ExpandedStages : public StageObserver {
 public:
  ExpandedStages(const Model& model, const Reduction& reduction, const std::vector<StageObserver*>& observers)
      : model_(model), reduction_(reduction), observers_(observers) {}

  void start(const Model&, const StaticStage& stage, const State& state) override {
    const State expanded = reduction_.expand(state, model_.motions);
    for (StageObserver* observer : observers_) observer->start(model_, stage, expanded);
  }
  void point(const StagePoint& point, const State& state) override {
    const State expanded = reduction_.expand(state, model_.motions);
    for (StageObserver* observer : observers_) observer->point(point, expanded);
  }
  void finish(const StageResult& result) override {
    for (StageObserver* observer : observers_) observer->finish(result);
  }

 private:
  const Model& model_;
  const Reduction& reduction_;
  const std::vector<StageObserver*>& observers_;
};

}  // namespace

ReducedSimulation::ReducedSimulation(const Model& model, const AnalysisOptions& options) : model_(model) {
  const Model* used = &model;
  if (std::any_of(model.driven.begin(), model.driven.end(), [](const VectorX& unit) { return unit.size() > 0; })) {
    held_ = without_moved_supports(model, reduction_.emplace());
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
  reduction_ = reduction_ ? reduction_->then(condensation_.reduction) : std::move(condensation_.reduction);
  simulation_.reset();
  simulation_.emplace(smaller_, chosen);
}

Summary ReducedSimulation::run(const std::vector<Observer*>& observers, const RunControl& control, const std::vector<StageObserver*>& stage_observers) {
  if (!reduction_) {
    Summary summary = simulation_->run(observers, control, stage_observers);
    summary.savings.massless_dofs = condensation_.candidates;
    return summary;
  }
  ExpandedStates expanded(model_, *reduction_, observers);
  ExpandedStages stages(model_, *reduction_, stage_observers);
  std::vector<StageObserver*> stage_list;
  if (!stage_observers.empty()) stage_list.push_back(&stages);
  std::vector<Observer*> list;
  if (!observers.empty()) list.push_back(&expanded);
  Summary summary = simulation_->run(list, control, stage_list);
  summary.dofs = dofs();
  summary.savings.massless_dofs = condensation_.candidates;
  summary.savings.condensed_dofs = condensation_.condensed;
  if (condensation_.condensed > 0) {
    summary.savings.condensed_entries = static_cast<double>(condensation_.entries_after) / static_cast<double>(condensation_.entries_before);
  }
  return summary;
}

int ReducedSimulation::dofs() const {
  const auto driven = [](const VectorX& unit) { return unit.size() > 0; };
  return std::any_of(model_.driven.begin(), model_.driven.end(), driven) ? held_.dofs.size() : model_.dofs.size();
}

std::vector<std::string> ReducedSimulation::describe() const {
  std::vector<std::string> lines = simulation_->scheme().describe();
  if (condensation_.condensed > 0) {
    lines.push_back(fmt::format("DOFs without mass condensed: {} of {}; factors and stiffness keep {:.0f} % of their entries", condensation_.condensed,
                                dofs(), 100.0 * static_cast<double>(condensation_.entries_after) / static_cast<double>(condensation_.entries_before)));
  } else if (condensation_.candidates > 0) {
    lines.push_back(fmt::format("{} DOFs without mass are kept: {}", condensation_.candidates,
                                model_.stages.empty() ? "condensed, the matrices would have more entries" : "static stages may load them"));
  }
  return lines;
}

}  // namespace nsframe
