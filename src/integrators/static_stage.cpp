#include "integrators/static_stage.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/errors.hpp"
#include "integrators/algorithms.hpp"
#include "integrators/static_control.hpp"

namespace nsframe {

namespace {

// The elastic displacement under the pattern, for scales and first guesses.
VectorX response_to(System& system, const VectorX& pattern, const StaticPoint& start) {
  StaticStep step(system, system.static_load, pattern, 1);
  const auto unit_load = [&](const VectorX& q, double factor, StaticConstraint& c) {
    c = {factor - start.factor, 1, VectorX::Zero(q.size()), 1};
  };
  step.prepare(start, unit_load, VectorX::Zero(pattern.size()), 0, {});
  step.restart();
  step.factor(Tangent::current);
  VectorX rhs(pattern.size() + 1), x;
  rhs << pattern, 0;
  step.solve(rhs, x);
  return x.head(pattern.size());
}

// Under load control only its distance tells the next equilibrium of a path from another one, beyond a limit point that the
// load cannot pass: how many times as far as the last increment leads. What lies so far on the path itself, where much
// yields at once, is found by Newton's method or by shorter steps. The arc length holds the distance of all DOFs together, but the
// control DOF may be a small part of it: its share is compared.
constexpr double farthest = 30;

class StageRun {
 public:
  StageRun(System& system, const StaticStage& stage, const StageControl& control, State& state)
      : system_(system), stage_(stage), control_(control), state_(state), ladder_(control.algorithms) {}

  StageResult run();

 private:
  bool find_points(StaticControl& control, StaticStep& step);
  // One point by the ladder; false when no algorithm finds it.
  bool find(StaticStep& step);
  // Of an equilibrium that Newton's method didn't find, under load control or by the arc length: beyond `farthest`.
  bool is_far(const StaticStep& step);
  void keep(const StaticStep& step, const StaticPoint& found);
  void give_up(const StaticControl& control, const StaticStep& step);

  System& system_;
  const StaticStage& stage_;
  const StageControl& control_;
  State& state_;
  StaticPoint committed_;
  double compliance_ = 0;  // displacement by load factor, of the last increment or elastic
  double share_ = 0;       // of the control DOF in all displacements, likewise
  double share_of_control(const VectorX& change) const;
  Ladder ladder_;
  std::vector<Attempt> attempts_;
  StageResult result_;
};

bool StageRun::find(StaticStep& step) {
  bool found = ladder_.climb(step, stage_.options.max_iterations, attempts_);
  if (found && stage_.options.control != "displacement" && attempts_.size() > 1) found = !is_far(step);
  for (const Attempt& attempt : attempts_) result_.iterations += attempt.iterations;
  if (attempts_.size() > 1) {
    result_.ladder.push_back({stage_.name, static_cast<int>(result_.points.size()), committed_.factor, attempts_});
  }
  return found;
}

double StageRun::share_of_control(const VectorX& change) const {
  const double all = change.norm();
  return stage_.control_row.size() > 0 && all > 0 ? std::abs(stage_.control_row.dot(change)) / all : 0;
}

bool StageRun::is_far(const StaticStep& step) {
  const StaticPoint& found = step.trial();
  const VectorX change = found.state.displacement - committed_.state.displacement;
  Attempt& last = attempts_.back();
  if (stage_.options.control != "load") {
    const double ratio = share_ > 0 ? share_of_control(change) / share_ : 0;
    if (!(ratio > farthest)) return false;
    last.converged = false;
    last.reason = fmt::format("an equilibrium where {} moves {:.0f} times as far as the last increment leads", stage_.control_name, ratio);
    return true;
  }
  const double led = compliance_ * std::abs(found.factor - committed_.factor);
  const double ratio = change.norm() / led;
  if (!(ratio > farthest)) return false;
  last.converged = false;
  last.reason = fmt::format("an equilibrium {:.0f} times as far as the last increment leads; displacement control or the arc "
                            "length follow the path", ratio);
  return true;
}

void StageRun::keep(const StaticStep& step, const StaticPoint& found) {
  StagePoint point;
  point.load_factor = found.factor;
  point.displacement = stage_.control_row.size() > 0 ? stage_.control_row.dot(found.state.displacement) : 0;
  point.iterations = attempts_.empty() ? 0 : attempts_.back().iterations;
  point.residual = step.relative_residual();
  result_.points.push_back(point);
  if (const Contacts& contacts = system_.contacts(); contacts.size() > 0) {
    const VectorX gap = contacts.jacobian * found.state.displacement + contacts.initial_gap;
    result_.least_gap = std::min(result_.least_gap, gap.minCoeff());
  }
  for (StageObserver* observer : control_.observers) observer->point(point, found.state);
}

void StageRun::give_up(const StaticControl& control, const StaticStep& step) {
  const std::string where = stage_.control_name.empty() ? "" : fmt::format(", {} = {:.6g}", stage_.control_name,
                                                                           result_.points.back().displacement);
  if (!control.complaint().empty()) {
    result_.stop_reason = fmt::format("stage '{}': {}{}", stage_.name, control.complaint(), where);
    return;
  }
  result_.stop_reason = fmt::format("stage '{}' cannot go on from load factor {:.6g}{} {}; tried: {}", stage_.name, committed_.factor, where,
                                    told_residual(step.relative_residual(), step.worst_element()), tried(attempts_));
  if (stage_.options.control == "arc-length") {
    result_.stop_reason += "; where a path snaps back at a kink, displacement control of a DOF that goes on moving there follows it";
  }
}

bool StageRun::find_points(StaticControl& control, StaticStep& step) {
  double largest_force = 0;
  while (!control.done()) {
    if (control_.stop_requested && control_.stop_requested()) {
      result_.interrupted = true;
      result_.stop_reason = fmt::format("stage '{}': interrupted", stage_.name);
      return false;
    }
    PlannedPoint planned = control.next(committed_);
    step.prepare(committed_, std::move(planned.constraint), planned.change, planned.factor_change,
                 {stage_.options.tolerance, largest_force});
    if (!find(step)) {
      ++result_.halved;
      if (control.retreat()) continue;
      give_up(control, step);
      return false;
    }
    if (!control.accept(committed_, step.trial(), attempts_.back().iterations)) {
      if (control.complaint().empty()) continue;
      give_up(control, step);
      return false;
    }
    largest_force = std::max(largest_force, step.largest_force());
    const VectorX change = step.trial().state.displacement - committed_.state.displacement;
    if (const double factor = std::abs(step.trial().factor - committed_.factor); factor > 0) compliance_ = change.norm() / factor;
    share_ = share_of_control(change);
    std::swap(committed_, step.trial());
    keep(step, committed_);
  }
  return true;
}

StageResult StageRun::run() {
  result_.name = stage_.name;
  result_.control = stage_.options.control;
  result_.at = stage_.control_name;
  committed_ = {state_, 0};
  const VectorX response = response_to(system_, stage_.pattern, committed_);
  const double size = compliance_ = response.norm();
  share_ = share_of_control(response);
  StaticStep step(system_, system_.static_load, stage_.pattern, size > 0 ? 1 / size : 1);
  const auto control = make_control({stage_, system_.model, committed_, response});
  for (StageObserver* observer : control_.observers) observer->start(system_.model, stage_, committed_.state);
  step.prepare(committed_, [](const VectorX& q, double, StaticConstraint& c) { c = {0, 1, VectorX::Zero(q.size()), 1}; },
               VectorX::Zero(response.size()), 0, {});
  step.restart();
  keep(step, committed_);
  result_.completed = find_points(*control, step);
  result_.factorizations = step.factorizations();
  for (StageObserver* observer : control_.observers) observer->finish(result_);
  state_ = committed_.state;
  system_.static_load += committed_.factor * stage_.pattern;
  return std::move(result_);
}

}  // namespace

StageResult run_stage(System& system, const StaticStage& stage, const StageControl& control, State& state) {
  return StageRun(system, stage, control, state).run();
}

}  // namespace nsframe
