#include "integrators/time_history.hpp"

#include <algorithm>
#include <cmath>

#include "base/errors.hpp"
#include "base/timer.hpp"

namespace nsframe {

namespace {

class TimeHistory {
 public:
  TimeHistory(System& system, Scheme& scheme, const AnalysisOptions& options, const std::vector<Observer*>& observers)
      : system_(system), scheme_(scheme), options_(options), observers_(observers) {}

  TimeHistoryResult run(double duration, State& committed);

 private:
  // Advances `committed` by h into `trial`, in halves where Newton fails.
  void advance(const State& committed, State& trial, double h, int halvings);
  void add(const StepResult& step);
  void watch_energy(const State& state);

  System& system_;
  Scheme& scheme_;
  const AnalysisOptions& options_;
  const std::vector<Observer*>& observers_;
  TimeHistoryResult result_;
  StepReport report_;
  StepResult step_;
  VectorX momentum_;
  double largest_energy_ = 0;
};

void TimeHistory::advance(const State& committed, State& trial, double h, int halvings) {
  try {
    scheme_.step(system_, committed, trial, h, step_);
    add(step_);
  } catch (const ConvergenceError&) {
    if (halvings >= options_.max_halvings) throw;
    ++result_.halved_steps;
    ++report_.substeps;
    State middle = committed;
    advance(committed, middle, h / 2, halvings + 1);
    advance(middle, trial, h / 2, halvings + 1);
  }
}

void TimeHistory::add(const StepResult& step) {
  report_.newton_iterations += step.newton_iterations;
  report_.active_pairs = std::max(report_.active_pairs, step.active_pairs);
  report_.residual = std::max(report_.residual, step.residual);
  report_.complementarity_error = std::max(report_.complementarity_error, step.complementarity_error);
  result_.newton_iterations += step.newton_iterations;
  result_.max_complementarity_error = std::max(result_.max_complementarity_error, step.complementarity_error);
  result_.max_penetration = std::max(result_.max_penetration, -step.least_gap);
  result_.energy.strain += step.strain;
  result_.energy.damping += step.damping;
  result_.energy.contact += step.contact;
  result_.energy.numerical += step.numerical;
  result_.energy.input += step.input;
  result_.impacts.insert(result_.impacts.end(), step.impacts.begin(), step.impacts.end());
}

void TimeHistory::watch_energy(const State& state) {
  Energy& energy = result_.energy;
  momentum_.noalias() = system_.mass() * state.velocity;
  energy.kinetic = 0.5 * state.velocity.dot(momentum_);
  largest_energy_ = std::max({largest_energy_, energy.kinetic, std::abs(energy.strain), std::abs(energy.input), energy.initial});
  if (largest_energy_ > 0) {
    result_.worst_balance_error = std::max(result_.worst_balance_error, std::abs(energy.balance_error()) / largest_energy_);
  }
}

TimeHistoryResult TimeHistory::run(double duration, State& committed) {
  const double start = committed.time;
  const int steps = static_cast<int>(std::llround(duration / options_.dt));
  State trial = committed;
  result_.energy.initial = 0.5 * committed.velocity.dot(system_.mass() * committed.velocity);
  watch_energy(committed);
  const Timer clock;
  double observing = 0;
  const auto observe = [&](auto&& call) {
    if (observers_.empty()) return;
    const Timer timer;
    for (Observer* observer : observers_) call(*observer);
    observing += timer.seconds();
  };
  observe([&](Observer& observer) { observer.start(system_.model, committed); });
  result_.completed = true;
  for (int n = 1; n <= steps; ++n) {
    report_ = StepReport{};
    report_.step = n;
    const Energy energy = result_.energy;
    const std::size_t impacts = result_.impacts.size();
    try {
      // times from the step number, so that rounding does not add up
      const double end = start + n * options_.dt;
      advance(committed, trial, options_.dt, 0);
      trial.time = end;
    } catch (const ConvergenceError& problem) {
      result_.completed = false;
      result_.stop_reason = problem.what();
      result_.energy = energy;  // without the substeps of the step that was given up
      result_.impacts.resize(impacts);
      break;
    }
    ++result_.steps;
    watch_energy(trial);
    observe([&](Observer& observer) {
      for (std::size_t i = impacts; i < result_.impacts.size(); ++i) observer.impact(result_.impacts[i]);
      observer.step(committed, trial, report_, result_.energy);
    });
    std::swap(committed, trial);
  }
  if (system_.contacts().size() > 0) {
    const VectorX gap = system_.contacts().jacobian * committed.displacement + system_.contacts().initial_gap;
    result_.max_penetration = std::max(result_.max_penetration, -gap.minCoeff());
  }
  observe([](Observer& observer) { observer.finish(); });
  result_.observer_seconds = observing;
  result_.step_seconds = clock.seconds() - observing;
  return std::move(result_);
}

}  // namespace

TimeHistoryResult run_time_history(System& system, Scheme& scheme, const AnalysisOptions& options, double duration,
                                   State& state, const std::vector<Observer*>& observers) {
  return TimeHistory(system, scheme, options, observers).run(duration, state);
}

}  // namespace nsframe
