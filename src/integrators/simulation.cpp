#include "integrators/simulation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "assembly/stability.hpp"
#include "base/errors.hpp"
#include "base/timer.hpp"
#include "integrators/static_analysis.hpp"

namespace nsframe {

namespace {

void check_options(const AnalysisOptions& options) {
  Diagnostics diagnostics;
  const auto require_that = [&](bool valid, const std::string& rule) {
    if (!valid) diagnostics.error({}, rule);
  };
  require_that(options.dt > 0 && std::isfinite(options.dt), fmt::format("analysis.dt = {} s, must be positive", options.dt));
  require_that(options.theta >= 0.5 && options.theta <= 1, fmt::format("analysis.theta = {}, must lie in [0.5, 1]", options.theta));
  require_that(options.gamma >= 0, fmt::format("analysis.gamma = {}, must not be negative", options.gamma));
  require_that(options.duration >= 0, fmt::format("analysis.duration = {} s, must not be negative", options.duration));
  require_that(options.newton_tolerance > 0, "analysis.newton_tolerance must be positive");
  diagnostics.throw_if_any();
}

}  // namespace

Simulation::Simulation(const Model& model, const AnalysisOptions& options, int modes)
    : model_(model), options_(options), system_(model, options.threads) {
  const Timer timer;
  check_options(options);
  state_ = virgin_state(system_);
  Diagnostics diagnostics;
  check_stability(model, system_.assembler.tangent(), diagnostics);
  diagnostics.throw_if_any();
  find_initial_state();
  stiffness_ = system_.assembler.tangent();
  modes_ = structure_modes(model, stiffness_, modes);
  assemble_damping(system_, stiffness_, modes_);
  scheme_ = make_scheme(options, system_);
  setup_seconds_ = timer.seconds();
}

void Simulation::find_initial_state() {
  system_.static_load = model_.gravity_load;
  const bool statically = model_.gravity_statically_first && model_.loaded();
  const bool pretensioned = state_.internal_force.cwiseAbs().maxCoeff() > 0;
  if (statically) {
    for (const Structure& structure : model_.structures) {
      if (structure.may_move_freely) {
        Diagnostics diagnostics;
        diagnostics.error(structure.at, fmt::format("gravity cannot act statically on structure '{}', which may move freely; "
                                                    "set statically_first = false in [gravity]", structure.name));
        diagnostics.throw_if_any();
      }
    }
  }
  if (statically || pretensioned) {
    const VectorX load = statically ? model_.gravity_load : VectorX::Zero(model_.dofs.size());
    solve_static(system_, load, StaticOptions{}, state_);
  }
  const bool loads_act_suddenly = system_.assembler.load_factor(state_.history) != 1;
  if (model_.initial_displacement.cwiseAbs().maxCoeff() > 0 || loads_act_suddenly) {
    State displaced = state_;
    displaced.displacement += model_.initial_displacement;
    system_.assembler.start_step(state_.history, displaced.history);
    system_.assembler.set_load_factor(1, displaced.history);
    system_.assembler.internal_force(displaced.displacement, state_.history, displaced.history, displaced.internal_force);
    state_ = displaced;
  }
  state_.velocity = model_.initial_velocity;
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
  summary.dt = options_.dt;
  summary.theta = options_.theta;
  summary.gamma = options_.gamma;
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
    }
    summary.frequencies.push_back(std::move(frequencies));
  }
  for (const ContactPair& pair : model_.contacts.pairs) summary.pairs.push_back(pair.name);
  return summary;
}

Summary Simulation::run(const std::vector<Observer*>& observers, const RunControl& control) {
  Summary summary = outline();
  if (!(duration() > 0)) throw InputError("error: analysis.duration is missing, and there is no motion to take it from");
  TimeHistoryResult result = run_time_history(system_, *scheme_, options_, duration(), state_, observers, control);
  summary.steps = result.steps;
  summary.end_time = state_.time;
  summary.impacts = std::move(result.impacts);
  summary.energy = result.energy;
  summary.worst_balance_error = result.worst_balance_error;
  summary.max_penetration = result.max_penetration;
  summary.max_complementarity_error = result.max_complementarity_error;
  summary.newton_iterations = result.newton_iterations;
  summary.halved_steps = result.halved_steps;
  summary.factorizations = scheme_->factorizations();
  summary.completed = result.completed;
  summary.interrupted = result.interrupted;
  summary.stop_reason = result.stop_reason;
  summary.timing = {setup_seconds_, result.step_seconds, result.observer_seconds};
  return summary;
}

}  // namespace nsframe
