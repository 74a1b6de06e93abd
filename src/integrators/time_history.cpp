#include "integrators/time_history.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/errors.hpp"
#include "base/large_pages.hpp"
#include "base/timer.hpp"
#include "integrators/history_reads.hpp"

namespace nsframe {

namespace {

constexpr int quiet_sampling = 16;  // steps between two looks at the quiet fibers

// Numbers that change when the mass, a record or a file of targets does: a scene only names its files.
std::vector<double> fingerprint(const Model& model) {
  std::vector<double> numbers{model.mass.norm(), model.viscous_damping.norm(), model.gravity_load.norm()};
  for (const StaticStage& stage : model.stages) {  // targets may come from a file
    numbers.insert(numbers.end(), stage.options.targets.begin(), stage.options.targets.end());
  }
  for (const GroundMotion& motion : model.motions) {
    const Eigen::Map<const VectorX> samples(motion.acceleration.data(), static_cast<Eigen::Index>(motion.acceleration.size()));
    numbers.insert(numbers.end(), {motion.duration(), samples.sum(), samples.norm()});
  }
  return numbers;
}

class TimeHistory {
 public:
  TimeHistory(System& system, Scheme& scheme, const AnalysisOptions& options, const std::vector<Observer*>& observers,
              const RunControl& control, const LargerModel* larger)
      : system_(system), scheme_(scheme), options_(options), observers_(observers), control_(control), shown_(system.model, larger),
        reads_(observers, options.dt) {}

  TimeHistoryResult run(double duration, State& committed);

 private:
  void begin(State& committed, double duration);
  // One step of the user's dt; false when it could not be made to converge.
  bool step(int number, State& committed, State& trial);
  // Advances `committed` by h into `trial`, in halves where Newton fails.
  void advance(const State& committed, State& trial, double h, int halvings);
  // Notes steps in which the first algorithm failed.
  void record_ladder(const State& committed);
  // Energies are those of the motion relative to the base: what moved supports add to strain energy and input.
  void add_support_work(double start, double end, const State& trial, StepResult& step);
  void add(const StepResult& step, double time);
  void watch_energy(const State& state, std::optional<double> kinetic);
  bool stop_now();
  double observer_seconds() const { return earlier_observer_seconds_ + clock_.apart_seconds(); }
  bool save_is_due();
  void save(const State& committed);
  void restore(State& committed);

  template <class Call>
  void observe(const Call& call) {
    if (observers_.empty()) return;
    clock_.apart(call);
  }
  template <class Call>
  void each_observer(const Call& call) {
    for (Observer* observer : observers_) call(*observer);
  }

  System& system_;
  Scheme& scheme_;
  const AnalysisOptions& options_;
  const std::vector<Observer*>& observers_;
  const RunControl& control_;
  ShownStates shown_;
  TimeHistoryResult result_;
  RunSums before_halving_;  // before the step whose first attempt failed
  StepReport report_;
  StepResult step_;
  std::vector<Impact> step_impacts_;
  VectorX support_force_;      // of moved supports along each motion, at the end of the last step [N]
  double support_kinetic_ = 0;  // what they add to the kinetic energy [J]
  double start_ = 0;           // of the time history [s]
  double rest_rounding_ = 0;   // of the work that static loads did before, which hides smaller energies [J]
  HistoryReads reads_;
  int steps_asked_ = 0;
  SharedTimer clock_;           // apart: observers and snapshots
  double loop_start_ = 0;       // on the clock, observers not counted [s]
  double last_save_ = 0, last_look_ = 0;  // on the clock [s]
  int unlooked_steps_ = 0, steps_a_look_ = 1;
  double earlier_seconds_ = 0, earlier_observer_seconds_ = 0;  // of the run that this one continues
};

void TimeHistory::advance(const State& committed, State& trial, double h, int halvings) {
  try {
    scheme_.step(system_, committed, trial, h, step_);
    record_ladder(committed);
    if (system_.model.moves_supports()) add_support_work(committed.time, committed.time + h, trial, step_);
    add(step_, committed.time);
  } catch (const ConvergenceError&) {
    if (halvings == 0) before_halving_ = result_;
    record_ladder(committed);
    if (halvings >= options_.max_halvings || !scheme_.shorter_steps_help()) throw;
    ++result_.halved_steps;
    ++report_.substeps;
    State middle = committed;
    advance(committed, middle, h / 2, halvings + 1);
    advance(middle, trial, h / 2, halvings + 1);
    trial.impulse += middle.impulse;
  }
}

void TimeHistory::record_ladder(const State& committed) {
  if (step_.attempts.empty() || step_.attempts.front().converged) return;
  ++result_.laddered_steps;
  if (result_.ladder.size() < most_ladder_records) result_.ladder.push_back({"", result_.steps + 1, committed.time, step_.attempts});
}

void TimeHistory::add_support_work(double start, double end, const State& trial, StepResult& step) {
  const VectorX force = system_.support_forces(trial.displacement, end);
  const auto& motions = system_.model.motions;
  for (std::size_t k = 0; k < motions.size(); ++k) {
    if (system_.model.support_effects[k].displacement.size() == 0) continue;
    const auto at = static_cast<Eigen::Index>(k);
    const double work = 0.5 * (motions[k].displacement_at(end) - motions[k].displacement_at(start)) * (support_force_[at] + force[at]);
    step.strain += work;
    step.input += work;
  }
  support_force_ = force;
}

void TimeHistory::add(const StepResult& step, double time) {
  report_.newton_iterations += step.newton_iterations;
  report_.active_pairs = std::max(report_.active_pairs, step.active_pairs);
  report_.residual = std::max(report_.residual, step.residual);
  report_.complementarity_error = std::max(report_.complementarity_error, step.complementarity_error);
  result_.newton_iterations += step.newton_iterations;
  result_.solves += step.solves;
  result_.evaluations += step.evaluations;
  result_.rejected_parts += step.rejected_parts;
  result_.stiffened_steps += step.stiffened_steps;
  if (step.guess_stood) ++result_.guessed_steps;
  result_.max_complementarity_error = std::max(result_.max_complementarity_error, step.complementarity_error);
  result_.max_penetration = std::max(result_.max_penetration, -step.least_gap);
  result_.accumulations.ended += step.accumulations.ended;
  result_.accumulations.plastic += step.accumulations.plastic;
  result_.accumulations.largest_bounce = std::max(result_.accumulations.largest_bounce, step.accumulations.largest_bounce);
  result_.energy.strain += step.strain;
  result_.energy.damping += step.damping;
  result_.energy.contact += step.contact;
  result_.energy.friction += step.friction;
  result_.energy.numerical += step.numerical;
  result_.energy.input += step.input;
  for (const Slip& slip : step.slips) {
    const auto sum = std::find_if(result_.slips.begin(), result_.slips.end(), [&](const Slip& s) { return s.pair == slip.pair; });
    sum->distance += slip.distance;
    sum->energy += slip.energy;
  }
  result_.created.sum += step.created;
  if (step.created > result_.created.largest) {
    result_.created.largest = step.created;
    result_.created.largest_time = time;
  }
  step_impacts_.insert(step_impacts_.end(), step.impacts.begin(), step.impacts.end());
  report_.jumps.insert(report_.jumps.end(), step.jumps.begin(), step.jumps.end());
}

void TimeHistory::watch_energy(const State& state, std::optional<double> kinetic) {
  Energy& energy = result_.energy;
  double& largest = result_.largest_energy;
  energy.kinetic = kinetic ? *kinetic : system_.kinetic_energy(state.velocity);
  if (system_.model.moves_supports()) {
    const double carried = system_.support_kinetic_energy(state.velocity, state.time);
    energy.kinetic += carried;
    energy.input += carried - support_kinetic_;
    support_kinetic_ = carried;
  }
  largest = std::max({largest, energy.kinetic, std::abs(energy.strain), std::abs(energy.input), energy.initial});
  if (largest > rest_rounding_) {
    result_.worst_balance_error = std::max(result_.worst_balance_error, std::abs(energy.balance_error()) / largest);
  }
}

void TimeHistory::begin(State& committed, double duration) {
  for (int i = 0; i < system_.contacts().friction.size(); ++i) {
    if (system_.contacts().friction[i] > 0) result_.slips.push_back({i});
  }
  if (control_.resume) {
    check_duration(*control_.resume, duration);
    restore(committed);
    observe([&] {
      shown_.begin(committed, [&](const Model& model, const State& state) {
        each_observer([&](Observer& observer) { observer.resume(model, state, *control_.resume); });
      });
    });
    return;
  }
  start_ = committed.time;
  if (system_.model.moves_supports()) {
    State trial = committed;
    system_.place_supports(committed.time);
    system_.assembler.start_step(committed.history, trial.history);
    system_.assembler.internal_force(committed.displacement, committed.history, trial.history, trial.internal_force);
    support_force_ = system_.support_forces(committed.displacement, committed.time);
  }
  rest_rounding_ = 64 * machine_epsilon * system_.static_load.cwiseAbs().dot(committed.displacement.cwiseAbs());
  result_.energy.initial = system_.kinetic_energy(committed.velocity);
  watch_energy(committed, {});
  observe([&] {
    shown_.begin(committed, [&](const Model& model, const State& state) {
      each_observer([&](Observer& observer) { observer.start(model, state); });
    });
  });
  scheme_.begin_anew(system_, committed);
}

bool TimeHistory::step(int number, State& committed, State& trial) {
  report_ = StepReport{};
  report_.step = number;
  step_impacts_.clear();
  try {
    // times from the step number, so that rounding does not add up
    const double end = start_ + number * options_.dt;
    if (scheme_.leaves_histories_behind()) scheme_.histories_wanted_after(reads_.steps(committed.time, steps_asked_ - result_.steps));
    advance(committed, trial, options_.dt, 0);
    trial.time = end;
  } catch (const ConvergenceError& problem) {
    static_cast<RunSums&>(result_) = before_halving_;
    result_.stop_reason = problem.what();
    return false;
  }
  ++result_.steps;
  watch_energy(trial, step_.kinetic);
  if (result_.steps % quiet_sampling == 0 && !step_.histories_behind && system_.assembler.fibers() > 0) {
    result_.quiet_fibers += static_cast<double>(system_.assembler.quiet_fibers(trial.history));
    ++result_.quiet_samples;
  }
  result_.impacts.insert(result_.impacts.end(), step_impacts_.begin(), step_impacts_.end());
  observe([&] {
    shown_.step(committed, trial, report_, [&](const State& before, const State& after, const StepReport& report) {
      each_observer([&](Observer& observer) {
        for (const Impact& impact : step_impacts_) observer.impact(impact);
        observer.step(before, after, report, result_.energy);
      });
    });
  });
  return true;
}

bool TimeHistory::stop_now() {
  if (step_.histories_behind || !control_.stop_requested || !control_.stop_requested()) return false;
  result_.interrupted = true;
  result_.stop_reason = "interrupted";
  return true;
}

// The clock is looked at every few steps where many steps fit between two snapshots.
bool TimeHistory::save_is_due() {
  if (++unlooked_steps_ < steps_a_look_) return false;
  unlooked_steps_ = 0;
  const double now = clock_.seconds(), often = std::min(1e-3 * control_.snapshot_interval, 0.01);
  steps_a_look_ = now - last_look_ < often ? std::min(2 * steps_a_look_, 1 << 14) : std::max(1, steps_a_look_ / 2);
  last_look_ = now;
  return now - last_save_ >= control_.snapshot_interval;
}

void TimeHistory::save(const State& committed) {
  if (!control_.keep_snapshot) return;
  result_.observer_seconds = observer_seconds();
  clock_.apart([&] {
    Snapshot snapshot;
    for (Observer* observer : observers_) observer->save(snapshot);
    snapshot.put("model.fingerprint", fingerprint(system_.model));
    nsframe::save(committed, snapshot);
    scheme_.save(snapshot);
    snapshot.put("time_history.start", start_);
    snapshot.put("time_history.rest_rounding", rest_rounding_);
    snapshot.put("time_history.wall_seconds", earlier_seconds_ + clock_.seconds() - loop_start_);
    snapshot.put("time_history.observer_seconds", result_.observer_seconds);
    visit_sums(result_, [&](const char* name, auto value) {
      snapshot.put(std::string("time_history.") + name, static_cast<double>(value));
    });
    visit_state_work(system_.assembler.state_work(), [&](const char* name, long value) {
      snapshot.put(std::string("state_work.") + name, static_cast<double>(value));
    });
    for (const Slip& slip : result_.slips) {
      snapshot.put(fmt::format("time_history.slip.{}", slip.pair), std::vector<double>{slip.distance, slip.energy});
    }
    if (system_.model.moves_supports()) snapshot.put("time_history.support_force", support_force_);
    nsframe::save("time_history.impacts", result_.impacts, snapshot);
    nsframe::save("time_history.ladder", result_.ladder, snapshot);
    control_.keep_snapshot(snapshot);
  });
  last_save_ = last_look_ = clock_.seconds();
}

void TimeHistory::restore(State& committed) {
  const Snapshot& snapshot = *control_.resume;
  if (snapshot.array("model.fingerprint") != fingerprint(system_.model)) {
    throw InputError("error: masses or ground motions are not those of the checkpoint: has a record been changed?");
  }
  nsframe::restore(committed, snapshot);
  scheme_.restore(system_, snapshot);
  start_ = snapshot.number("time_history.start");
  rest_rounding_ = snapshot.number("time_history.rest_rounding");
  result_.observer_seconds = snapshot.number("time_history.observer_seconds");
  visit_sums(result_, [&](const char* name, auto& value) {
    value = static_cast<std::remove_reference_t<decltype(value)>>(snapshot.number(std::string("time_history.") + name));
  });
  StateWorkSums work;
  visit_state_work(work, [&](const char* name, long& value) { value = static_cast<long>(snapshot.number(std::string("state_work.") + name)); });
  system_.assembler.set_state_work(work);
  for (Slip& slip : result_.slips) {
    const std::vector<double>& sums = snapshot.array(fmt::format("time_history.slip.{}", slip.pair));
    slip = {slip.pair, sums[0], sums[1]};
  }
  if (system_.model.moves_supports()) {
    support_force_.resize(static_cast<Eigen::Index>(system_.model.motions.size()));
    snapshot.read("time_history.support_force", support_force_);
    support_kinetic_ = system_.support_kinetic_energy(committed.velocity, committed.time);
  }
  earlier_seconds_ = snapshot.number("time_history.wall_seconds");
  earlier_observer_seconds_ = result_.observer_seconds;
  result_.impacts = restore_impacts("time_history.impacts", snapshot);
  result_.ladder = restore_ladder("time_history.ladder", snapshot);
}

TimeHistoryResult TimeHistory::run(double duration, State& committed) {
  steps_asked_ = static_cast<int>(std::llround(duration / options_.dt));
  begin(committed, duration);
  VectorX history = on_large_pages(committed.history);
  committed.history.resize(0);  // never three of them at a time
  State trial = committed;
  committed.history = on_large_pages(history);
  trial.history = std::move(history);
  loop_start_ = clock_.seconds() - clock_.apart_seconds();
  const bool saves = control_.keep_snapshot && control_.snapshot_interval > 0;
  while (result_.steps < steps_asked_ && !stop_now() && step(result_.steps + 1, committed, trial)) {
    std::swap(committed, trial);
    if (saves && !step_.histories_behind && save_is_due()) save(committed);
  }
  result_.completed = result_.steps == steps_asked_;
  if (!step_.histories_behind) save(committed);
  for (const Impact& impact : scheme_.open_contacts(system_, committed)) {
    result_.impacts.push_back(impact);
    observe([&] { each_observer([&](Observer& observer) { observer.impact(impact); }); });
  }
  if (system_.contacts().size() > 0) {
    VectorX gap;
    system_.gaps(committed.displacement, committed.time, gap);
    result_.max_penetration = std::max(result_.max_penetration, -gap.minCoeff());
  }
  observe([&] { each_observer([](Observer& observer) { observer.finish(); }); });
  result_.observer_seconds = observer_seconds();
  result_.begin_seconds = loop_start_;
  result_.step_seconds = earlier_seconds_ + clock_.seconds() - result_.observer_seconds - loop_start_;
  return std::move(result_);
}

}  // namespace

void check_duration(const Snapshot& snapshot, double duration) {
  const double done = snapshot.number("state.time") - snapshot.number("time_history.start");
  if (done <= duration * (1 + 1e-9)) return;
  throw InputError(fmt::format("error: the checkpoint is at t = {:g} s, beyond the duration of {:g} s", done, duration));
}

TimeHistoryResult run_time_history(System& system, Scheme& scheme, const AnalysisOptions& options, double duration,
                                   State& state, const std::vector<Observer*>& observers, const RunControl& control,
                                   const LargerModel* larger) {
  return TimeHistory(system, scheme, options, observers, control, larger).run(duration, state);
}

}  // namespace nsframe
