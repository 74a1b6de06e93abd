// Motion of the scheme `event-split` over parts of a step (theory.md, 290-294, 350-353).
#include <fmt/format.h>

#include <algorithm>

#include "base/errors.hpp"
#include "integrators/event_split.hpp"
#include "integrators/part_problem.hpp"

namespace nsframe {

namespace {

constexpr int most_follow_ups = 40;      // of what has no mass, until it rests
constexpr double resolved = 0.25;        // angle by which a struck point may turn in a part
constexpr int most_cuts = 64;            // of a step
constexpr int most_probes = 50;          // of the end of a part
constexpr double slow_probes = 0.25;     // factor of the last correction of that end, above which they take the secant

}  // namespace

int EventSplit::parts_of(double h) const {
  int parts = 1;
  while (parts < most_cuts && struck_ * h > resolved * parts) parts *= 2;
  return parts;
}

void EventSplit::prepare_parts(const System& system, double h) {
  part_length_ = h / parts_of(h);
  const double a = flow_.rule().theta * part_length_;
  if (!parts_.matrix.ready(a)) parts_.matrix.factor(system, parts_.stiffness, a);
  flow_.set_longest(part_length_);
}

void EventSplit::rest_massless(System& system) {
  if (!impact_.any_massless()) return;
  double last = std::numeric_limits<double>::infinity();
  for (int i = 0; i < most_follow_ups; ++i) {
    const VectorX change = impact_.follow(system.contacts(), closed_, system.static_load - now_.P);
    const double size = change.cwiseAbs().maxCoeff();
    if (!(size > 4 * machine_epsilon * now_.q.cwiseAbs().maxCoeff()) || size >= last) break;
    last = size;
    now_.q += change;
    system.assembler.start_step(*from_, *to_);
    system.assembler.internal_force(now_.q, *from_, *to_, now_.P, false);
  }
}

double EventSplit::start_tolerance(const System& system, int pair) const {
  return 1e-12 * (std::abs(system.contacts().initial_gap[pair]) + 1e-6) + gap_tolerance(system, pair);
}

void EventSplit::start(System& system, const State& committed) {
  closed_.clear();
  offset_.setZero();
  if (system.contacts().size() > 0) {
    find_gaps(system);
    for (int c = 0; c < system.contacts().size(); ++c) {
      if (impact_.compliant(c) && gap_[c] <= start_tolerance(system, c)) closed_.push_back(c);  // until what has no mass rests
    }
  }
  rest_massless(system);
  if (!system.linear() && now_.q != committed.displacement) {
    from_ = to_;
    std::swap(to_, other_);
  }
  closed_.clear();
  std::fill(touching_.begin(), touching_.end(), false);
  contact_impulse_.setZero();
  if (system.contacts().size() == 0) return;
  find_gaps(system);
  for (int c = 0; c < system.contacts().size(); ++c) {
    const double tolerance = start_tolerance(system, c);
    if (gap_[c] > tolerance) continue;
    if (gap_[c] < -tolerance && committed.time == 0) {  // later it is what check_gaps() let pass
      throw InputError(fmt::format("error: contact pair '{}' overlaps by {:.3g} m; scheme 'event-split' starts from open or touching pairs",
                                   system.contacts().pairs[static_cast<std::size_t>(c)].name, -gap_[c]));
    }
    touching_[static_cast<std::size_t>(c)] = true;
    offset_[c] -= gap_[c];
    gap_[c] = 0;
  }
}

PartLoad EventSplit::part_load(const System& system, double time, double length) const {
  PartLoad load{system.static_load, {}};
  for (std::size_t i = 0; i < system.model.motions.size(); ++i) {
    const GroundMotion& motion = system.model.motions[i];
    const double mean = (motion.velocity_at(time + length) - motion.velocity_at(time)) / length;
    const double slope = (motion.acceleration_at(time + length) - motion.acceleration_at(time)) / length;
    load.start += (mean - 0.5 * slope * length) * system.model.motion_load[i];
    if (slope == 0) continue;
    if (load.slope.size() == 0) load.slope.setZero(load.start.size());
    load.slope += slope * system.model.motion_load[i];
  }
  return load;
}

void EventSplit::begin_flow(const System& system, double time, double length, const std::vector<int>& held) {
  flow_.held().hold(system.contacts(), held);
  flow_.begin(system, now_.v, now_.P, part_load(system, time, length), massless_);
  flow_.gap_coefficients(system.contacts(), path_);
}

EventSplit::Event EventSplit::solve_part(System& system, double time, double length, StepResult& result) {
  Event event = find_event(length), probe = event;
  double last_at = 0, last_shift = std::numeric_limits<double>::infinity();
  for (int i = 0; i < most_probes; ++i) {
    if (!(probe.time > 0)) return probe;
    PartProblem problem({system, impact_, flow_, parts_, tangent_, options_}, probe.time, now_, *from_, *to_, result);
    solve_flight(ladder_, problem, options_, system, time, result);
    next_.P = std::move(problem.P);
    if (result.guess_stood && probe.kind != Event::Kind::probe) return probe;
    flow_.bend(probe.time, problem.x, problem.forces);
    flow_.gap_coefficients(system.contacts(), path_);
    event = find_event(length);
    const double shift = event.time - probe.time;
    if (shift == 0) return event;
    Event next = event;
    if (std::abs(shift) > slow_probes * std::abs(last_shift)) {  // by the secant of what the last two have found
      const double at = probe.time - shift * (probe.time - last_at) / (shift - last_shift);
      if (at > 0 && at < length) next = {at, Event::Kind::probe, -1};
    }
    last_at = probe.time;
    last_shift = shift;
    probe = next;
  }
  throw ConvergenceError(fmt::format("an event within the step at t = {:.9g} s was not found in {} solutions", time, most_probes));
}

void EventSplit::evaluate(System& system, double s, double time, StepResult& result) {
  const Motion start = now_;
  now_.change = s * flow_.mean_velocity(s);
  now_.q += now_.change;
  flow_.velocity(s, now_.v);
  now_.a.resize(0);
  if (system.linear()) {
    system.assembler.start_step(*from_, *to_);
    system.assembler.internal_force(now_.q, *from_, *to_, now_.P, false);
    ++result.evaluations;
  } else {
    now_.P = next_.P;
    from_ = to_;
    std::swap(to_, other_);
  }
  account(system, start, time, s, std::nullopt, result);
}

void EventSplit::account(const System& system, const Motion& start, double time, double s, std::optional<double> dissipated,
                         StepResult& result) {
  const VectorX mean = now_.change / s;
  const double strain = 0.5 * now_.change.dot(start.P + now_.P);
  VectorX load, damping = VectorX::Zero(mean.size());
  system.load_impulse(time, time + s, load);
  system.damping.add_force(system.assembler.blocks(), s, mean, damping);
  const double input = load.dot(mean), damped = damping.dot(mean);
  const double kinetic = 0.5 * (now_.v + start.v).dot(system.mass() * (now_.v - start.v));
  result.strain += strain;
  result.input += input;
  result.damping += damped;
  result.numerical += dissipated ? *dissipated : input - kinetic - strain - damped;  // what the formulas leave (theory.md, 294)
}

}  // namespace nsframe
