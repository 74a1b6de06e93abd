#include "integrators/simulation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "assembly/stability.hpp"
#include "base/errors.hpp"
#include "base/timer.hpp"
#include "integrators/algorithms.hpp"
#include "integrators/initial_state.hpp"
#include "integrators/scheme_choice.hpp"
#include "integrators/static_analysis.hpp"
#include "integrators/static_control.hpp"

namespace nsframe {

namespace {

// Shows observers of static stages the states of the larger model.
class ExpandedStages : public StageObserver {
 public:
  ExpandedStages(const LargerModel& larger, const std::vector<StageObserver*>& observers) : larger_(larger), observers_(observers) {}

  void start(const Model&, const StaticStage& stage, const State& state) override {
    const State expanded = expand(state);
    for (StageObserver* observer : observers_) observer->start(*larger_.model, stage, expanded);
  }
  void point(const StagePoint& point, const State& state) override {
    const State expanded = expand(state);
    for (StageObserver* observer : observers_) observer->point(point, expanded);
  }
  void finish(const StageResult& result) override {
    for (StageObserver* observer : observers_) observer->finish(result);
  }

 private:
  State expand(const State& state) const {
    State expanded = state;
    larger_.reduction.expand(state, larger_.model->motions, expanded);
    return expanded;
  }

  const LargerModel& larger_;
  const std::vector<StageObserver*>& observers_;
};

void check_options(const AnalysisOptions& options) {
  Diagnostics diagnostics;
  const auto require_that = [&](bool valid, const std::string& rule) {
    if (!valid) diagnostics.error({}, rule);
  };
  require_that(options.dt > 0 && std::isfinite(options.dt), fmt::format("analysis.dt = {} s, must be positive", options.dt));
  require_that(options.theta >= 0.5 && options.theta <= 1, fmt::format("analysis.theta = {}, must lie in [0.5, 1]", options.theta));
  require_that(options.rho_infinity >= 0 && options.rho_infinity <= 1,
               fmt::format("analysis.rho_infinity = {}, must lie in [0, 1]", options.rho_infinity));
  require_that(options.gamma >= 0, fmt::format("analysis.gamma = {}, must not be negative", options.gamma));
  require_that(options.duration >= 0, fmt::format("analysis.duration = {} s, must not be negative", options.duration));
  require_that(options.newton_tolerance > 0, "analysis.newton_tolerance must be positive");
  diagnostics.throw_if_any();
}

void check_supports_rest(const Model& model) {
  for (std::size_t k = 0; k < model.driven.size(); ++k) {
    if (model.driven[k].size() == 0) continue;
    throw InputError(fmt::format("error: motion '{}' moves supports, which a Simulation takes only once they are taken out of the model: "
                                 "use ReducedSimulation", model.motions[k].source));
  }
}

}  // namespace

Simulation::Simulation(const Model& model, const AnalysisOptions& options, int modes)
    : model_(model), options_(options), system_(model, options.threads) {
  const Timer timer;
  check_options(options);
  check_supports_rest(model);
  state_ = virgin_state(system_);
  Diagnostics diagnostics;
  check_stability(model, system_.assembler.tangent(), diagnostics);
  diagnostics.throw_if_any();
  system_.initial_stiffness = system_.assembler.tangent();
  check_stages_fit();
  find_initial_state(system_, state_);
  stiffness_ = system_.initial_stiffness = system_.assembler.tangent();
  modes_ = structure_modes(model, stiffness_, modes);
  assemble_damping(system_, stiffness_, modes_);
  SchemeChoice choice = choose_scheme(options, system_, state_);
  scheme_ = std::move(choice.scheme);
  scheme_reason_ = std::move(choice.reason);
  stages_ = model.stages;
  for (StaticStage& stage : stages_) {
    if (!stage.mode.empty()) stage.pattern = mode_pattern(stage);
  }
  setup_seconds_ = timer.seconds();
}

void Simulation::check_stages_fit() const {
  if (model_.stages.empty()) return;
  Diagnostics diagnostics;
  check_stages(model_.stages, diagnostics);
  const Location& at = model_.stages.front().at;
  if (!model_.gravity_statically_first && model_.loaded()) {
    diagnostics.error(at, "static stages begin at rest: they need statically_first = true in [gravity]");
  }
  if (model_.initial_displacement.cwiseAbs().maxCoeff() > 0) {
    diagnostics.error(at, "static stages begin at rest: initial displacements cannot be given beside them");
  }
  for (const Structure& structure : model_.structures) {
    if (structure.may_move_freely) {
      diagnostics.error(structure.at, fmt::format("structure '{}' may move freely: static stages need structures that resist",
                                                  structure.name));
    }
  }
  diagnostics.throw_if_any();
}

// M phi, forces of 1 N in all. A mode has no sign of its own: L, T and V push along x, y and z, R turns about z.
VectorX Simulation::mode_pattern(const StaticStage& stage) const {
  const std::size_t dot = stage.mode.rfind('.');
  const std::string structure = stage.mode.substr(0, dot), mode = stage.mode.substr(dot + 1);
  Diagnostics diagnostics;
  for (std::size_t s = 0; s < modes_.size(); ++s) {
    if (model_.structures[s].name != structure) continue;
    const auto found = std::find(modes_[s].names.begin(), modes_[s].names.end(), mode);
    if (found == modes_[s].names.end()) {
      diagnostics.error(stage.mode_at, fmt::format("structure '{}' has no mode '{}' among its first {}{}", structure, mode,
                                                   modes_[s].names.size(), did_you_mean(mode, modes_[s].names)));
      break;
    }
    const int first = model_.structures[s].first_dof, size = model_.structures[s].last_dof - first;
    VectorX shape = VectorX::Zero(model_.dofs.size());
    shape.segment(first, size) = modes_[s].modes.shape.col(found - modes_[s].names.begin());
    const VectorX full = model_.nodal_mass.cwiseProduct(model_.dofs.expand(shape));
    double forces = 0;
    Eigen::Vector4d pushed = Eigen::Vector4d::Zero();  // along x, y and z, and turned about z
    for (int i = 0; i < model_.nodes.size(); ++i) {
      const Vector3 force = full.segment<3>(6 * i), place = model_.nodes.position[static_cast<std::size_t>(i)];
      forces += force.lpNorm<1>();
      pushed.head<3>() += force;
      pushed[3] += place.x() * force.y() - place.y() * force.x() + full[6 * i + 5];
    }
    if (!(forces > 0)) {
      diagnostics.error(stage.mode_at, fmt::format("mode '{}' moves no mass along x, y or z: no load can follow it", stage.mode));
      break;
    }
    const double sense = pushed[mode[0] == 'L' ? 0 : mode[0] == 'T' ? 1 : mode[0] == 'V' ? 2 : 3];
    return std::copysign(1 / forces, sense) * (model_.mass * shape);
  }
  diagnostics.throw_if_any();
  return {};
}

bool Simulation::run_stages(std::size_t count, const StageControl& control, std::vector<StageResult>& results) {
  for (std::size_t i = 0; i < count; ++i) {
    results.push_back(run_stage(system_, stages_[i], control, state_));
    if (!results.back().completed) return false;
  }
  if (count > 0) state_.acceleration.setZero();
  return true;
}

double Simulation::duration() const {
  double duration = options_.duration;
  if (duration == 0) {
    for (const GroundMotion& motion : model_.motions) duration = std::max(duration, motion.duration());
  }
  return duration;
}

Summary Simulation::outline() const {
  Summary summary;
  summary.scheme = scheme_->name();
  summary.scheme_reason = scheme_reason_;
  summary.dt = options_.dt;
  summary.theta = options_.theta;
  summary.gamma = options_.gamma;
  if (scheme_->name() == "event-split") summary.integrator = options_.integrator;
  summary.rho_infinity = options_.rho_infinity;
  summary.struck_frequency = scheme_->struck_frequency() / (2 * pi);
  summary.resting_frequency = scheme_->resting_frequency() / (2 * pi);
  const auto [left_out, kept_mass] = scheme_->left_out();
  summary.left_out_modes = left_out;
  summary.kept_mass = kept_mass;
  summary.duration = duration();
  summary.dofs = model_.dofs.size();
  summary.nodes = model_.nodes.size();
  for (const auto& group : model_.groups) summary.elements += group->size();
  summary.fibers = static_cast<int>(system_.assembler.fibers());
  for (std::size_t s = 0; s < modes_.size(); ++s) {
    const std::string& name = model_.structures[s].name;
    summary.structures.push_back(name);
    std::vector<double> frequencies;
    for (int i = 0; i < modes_[s].modes.size(); ++i) {
      const double w = modes_[s].modes.circular_frequency[i], ratio = modes_[s].damping_ratio[i];
      frequencies.push_back(w / (2 * pi));
      const Scheme::ModeResponse response = scheme_->mode_response(w, ratio, options_.dt);
      summary.modes.push_back({name, modes_[s].names[static_cast<std::size_t>(i)], w / (2 * pi), ratio,
                               response.damping_ratio, response.circular_frequency / (2 * pi)});
      const Scheme::ModeResponse tied = scheme_->complex_mode(static_cast<int>(s), i);
      summary.modes.back().complex_frequency = tied.circular_frequency / (2 * pi);
      summary.modes.back().complex_damping = tied.damping_ratio;
    }
    summary.frequencies.push_back(std::move(frequencies));
  }
  for (const ContactPair& pair : model_.contacts.pairs) summary.pairs.push_back(pair.name);
  return summary;
}

Summary Simulation::run(const std::vector<Observer*>& observers, const RunControl& control,
                        const std::vector<StageObserver*>& stage_observers, const LargerModel* larger) {
  Summary summary = outline();
  const Timer stage_clock;
  std::optional<ExpandedStages> expanded;
  std::vector<StageObserver*> watching = stage_observers;
  if (larger && !stage_observers.empty()) watching = {&expanded.emplace(*larger, stage_observers)};
  const auto note_state_work = [&] { summary.state_work = system_.assembler.state_work(); };
  const bool arrived = run_stages(stages_.size(), {options_.algorithm, watching, control.stop_requested}, summary.stages);
  summary.softened_members = system_.assembler.softened_members(state_.history);
  if (!arrived || (!stages_.empty() && !(duration() > 0))) {
    summary.completed = arrived;
    if (!arrived) {
      summary.interrupted = summary.stages.back().interrupted;
      summary.stop_reason = summary.stages.back().stop_reason;
    }
    summary.timing = {setup_seconds_, stage_clock.seconds(), 0};
    note_state_work();
    return summary;
  }
  if (system_.damping.follows_tangent()) {
    State trial = state_;
    system_.assembler.start_step(state_.history, trial.history);
    system_.assembler.internal_force(state_.displacement, state_.history, trial.history, trial.internal_force);
    const SparseMatrix& K = system_.assembler.tangent();
    state_.damping_stiffness = Eigen::Map<const VectorX>(K.valuePtr(), K.nonZeros());
  }
  if (!(duration() > 0)) throw InputError("error: analysis.duration is missing, and there is no motion to take it from");
  TimeHistoryResult result = run_time_history(system_, *scheme_, options_, duration(), state_, observers, control, larger);
  summary.steps = result.steps;
  summary.end_time = state_.time;
  summary.softened_members = system_.assembler.softened_members(state_.history);
  summary.impacts = std::move(result.impacts);
  summary.energy = result.energy;
  summary.slips = std::move(result.slips);
  summary.created = result.created;
  summary.worst_balance_error = result.worst_balance_error;
  summary.max_penetration = result.max_penetration;
  summary.max_complementarity_error = result.max_complementarity_error;
  summary.accumulations = result.accumulations;
  summary.newton_iterations = result.newton_iterations;
  summary.halved_steps = result.halved_steps;
  summary.evaluations = result.evaluations;
  summary.rejected_parts = result.rejected_parts;
  summary.stiffened_steps = result.stiffened_steps;
  summary.laddered_steps = result.laddered_steps;
  summary.ladder = std::move(result.ladder);
  summary.factorizations = scheme_->factorizations();
  summary.savings = {system_.assembler.linear_elements(),
                     result.quiet_samples > 0 ? result.quiet_fibers / double(result.quiet_samples * system_.assembler.fibers()) : 0,
                     result.guessed_steps, std::max(0L, result.solves - summary.factorizations)};
  note_state_work();
  summary.completed = result.completed;
  summary.interrupted = result.interrupted;
  summary.stop_reason = result.stop_reason;
  summary.timing = {setup_seconds_ + result.begin_seconds, result.step_seconds, result.observer_seconds};
  return summary;
}

}  // namespace nsframe
