#include "integrators/event_split.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/errors.hpp"
#include "integrators/gap_roots.hpp"
#include "integrators/mode_response.hpp"

namespace nsframe {

namespace {

constexpr int most_parts = 100000;   // of a step
// Overlap after a step that is an error: [m], and of what the fastest approach so far moves in a step.
constexpr double least_overlap = 1e-7, overlap_of_motion = 0.01;
constexpr double instant = 1e-3;         // of the step, after which what touches without rate is seen to open or to press
constexpr int most_follow_ups = 40;      // of what has no mass, until it rests
constexpr double massless_rest = 1e-6;   // of the motion of a part, that may be left
constexpr double least_acceleration = 1e-3;  // counts as zero when the residual is judged [m/s2]

const System& accepted(const System& system) {
  const char* why = nullptr;
  if (system.assembler.rate_dependent()) why = "has elements whose force depends on the rate of deformation";
  if (system.damping.follows_tangent()) why = "has Rayleigh damping on the committed or current stiffness";
  if (why) throw InputError(fmt::format("error: scheme 'event-split' cannot take this scene: it {}; use scheme = \"moreau-jean\"", why));
  return system;
}

}  // namespace

EventSplit::EventSplit(const AnalysisOptions& options, const System& system)
    : options_(options), matrix_(accepted(system)), impact_(system), ladder_(options.algorithm),
      least_scale_(least_acceleration * system.mass().diagonal().norm()), flow_(options.theta, matrix_), stiffness_(system.initial_stiffness) {
  const int pairs = system.contacts().size();
  touching_.assign(static_cast<std::size_t>(pairs), false);
  offset_ = contact_impulse_ = step_impulse_ = rate_ = VectorX::Zero(pairs);
  for (Eigen::Index i = 0; i < system.mass().rows(); ++i) massless_.push_back(impact_.massless(i));
}

bool EventSplit::is_closed(int pair) const { return std::binary_search(closed_.begin(), closed_.end(), pair); }

double EventSplit::gap_tolerance(const System& system, int pair) const {
  double size = std::abs(system.contacts().initial_gap[pair]);
  for (SparseRows::InnerIterator entry(system.contacts().jacobian, pair); entry; ++entry) size += std::abs(entry.value() * q_[entry.col()]);
  return 64 * machine_epsilon * size + 1e-18;
}

double EventSplit::look_ahead(double remaining) const { return std::min(remaining, instant * step_length_); }

double EventSplit::rate_tolerance() const { return 64 * machine_epsilon * v_.cwiseAbs().maxCoeff() + 1e-12 * largest_approach_; }

void EventSplit::find_gaps(const System& system) {
  gap_ = system.contacts().jacobian * q_;
  gap_ += system.contacts().initial_gap + offset_;
}

void EventSplit::rest_massless(System& system, double sufficient) {
  if (!impact_.any_massless()) return;
  double last = std::numeric_limits<double>::infinity();
  for (int i = 0; i < most_follow_ups; ++i) {
    const VectorX change = impact_.follow(system.static_load - force_);
    const double size = change.cwiseAbs().maxCoeff();
    if (!(size > sufficient + 4 * machine_epsilon * q_.cwiseAbs().maxCoeff()) || size >= last) break;  // to rounding
    last = size;
    q_ += change;
    system.assembler.start_step(*from_, *to_);
    system.assembler.internal_force(q_, *from_, *to_, force_, false);
  }
}

void EventSplit::start(System& system, const State& committed) {
  rest_massless(system, 0);
  if (!system.linear() && q_ != committed.displacement) {
    from_ = to_;
    std::swap(to_, other_);
  }
  closed_.clear();
  std::fill(touching_.begin(), touching_.end(), false);
  offset_.setZero();
  contact_impulse_.setZero();
  if (system.contacts().size() == 0) return;
  find_gaps(system);
  for (int c = 0; c < system.contacts().size(); ++c) {
    const double tolerance = 1e-12 * (std::abs(system.contacts().initial_gap[c]) + 1e-6) + gap_tolerance(system, c);
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
  flow_.hold(system.contacts(), held);
  flow_.begin(system, v_, force_, part_load(system, time, length), massless_);
  if (system.contacts().size() > 0) flow_.gap_coefficients(system.contacts(), path_);
}

EventSplit::Event EventSplit::find_event(double length) {
  Event event{length, Event::Kind::none, -1};
  for (std::size_t k = 0; k < closed_.size(); ++k) {
    const double at = flow_.release(k, length);
    if (at < event.time) event = {at, Event::Kind::opens, closed_[k]};
  }
  for (int c = 0; c < static_cast<int>(touching_.size()); ++c) {
    if (is_closed(c)) continue;
    const double s = event.time, c0 = path_(c, 0), c1 = path_(c, 1), c2 = path_(c, 2), c3 = path_(c, 3);
    if (gap_[c] - s * (std::abs(c0) + s * (std::abs(c1) + s * (std::abs(c2) + s * std::abs(c3)))) > 0) continue;
    double at = s;
    if (touching_[static_cast<std::size_t>(c)]) {
      // without rate, settle() has seen that it is open `look_ahead()` later
      const double x = c0 > rate_tolerance() ? 0 : look_ahead(s), rest = s - x;
      const double p0 = c0 + x * (c1 + x * (c2 + x * c3));  // of g / s from there on
      const double p1 = rest * (c1 + x * (2 * c2 + 3 * x * c3)), p2 = rest * rest * (c2 + 3 * x * c3), p3 = rest * rest * rest * c3;
      if (rest <= 0 || p0 <= 0) continue;
      at = x + rest * std::min(1.0, first_negative(Eigen::Vector4d(p0, p0 + p1 / 3, p0 + (2 * p1 + p2) / 3, p0 + p1 + p2 + p3), 0));
    } else {
      const double a0 = c0 * s, a1 = c1 * s * s, a2 = c2 * s * s * s, a3 = c3 * s * s * s * s;
      VectorX b(5);
      b << gap_[c], gap_[c] + a0 / 4, gap_[c] + a0 / 2 + a1 / 6, gap_[c] + 0.75 * a0 + a1 / 2 + a2 / 4, gap_[c] + a0 + a1 + a2 + a3;
      at = s * std::min(1.0, first_negative(b, 0));
    }
    if (at < event.time) event = {at, Event::Kind::closes, c};
  }
  return event;
}

void EventSplit::evaluate(System& system, double s, double time, StepResult& result) {
  const VectorX before = force_, old_velocity = v_;
  VectorX change = s * flow_.mean_velocity(s);
  q_ += change;
  flow_.velocity(s, v_);
  system.assembler.start_step(*from_, *to_);
  system.assembler.internal_force(q_, *from_, *to_, force_, false);
  ++result.evaluations;
  if (!system.linear()) {
    const VectorX reached = q_;
    rest_massless(system, massless_rest * change.cwiseAbs().maxCoeff());
    change += q_ - reached;
    VectorX departure = force_ - before, correction;
    departure.noalias() -= stiffness_ * change;
    flow_.solve(departure, correction);
    v_ -= (0.5 * s) * correction;
    from_ = to_;
    std::swap(to_, other_);
  }
  account(system, time, s, change, old_velocity, before, result);
}

void EventSplit::account(const System& system, double time, double s, const VectorX& change, const VectorX& old_velocity, const VectorX& old_force,
                         StepResult& result) {
  const VectorX mean = change / s;
  result.strain += 0.5 * change.dot(old_force + force_);
  VectorX load;
  system.load_impulse(time, time + s, load);
  result.input += load.dot(mean);
  VectorX damping = VectorX::Zero(v_.size());
  system.damping.add_force(system.assembler.blocks(), s, mean, damping);
  result.damping += damping.dot(mean);
  const VectorX velocity_change = v_ - old_velocity, momentum_change = system.mass() * velocity_change;
  if (s == step_length_ && (system.linear() || flow_.whole())) {
    result.numerical += (options_.theta - 0.5) * (velocity_change.dot(momentum_change) + change.dot(force_ - old_force));
  } else {  // what the part's formulas leave (theory.md, 294)
    result.numerical -= 0.5 * (v_ + old_velocity).dot(momentum_change) + 0.5 * change.dot(old_force + force_) + damping.dot(mean) - load.dot(mean);
  }
}

// Far from contact: the gaps at both ends are larger than what their rates there could do in the whole step.
bool EventSplit::clear(const System& system, double h) {
  const SparseRows& H = system.contacts().jacobian;
  if (H.rows() == 0) return true;
  if (!closed_.empty() || std::find(touching_.begin(), touching_.end(), true) != touching_.end()) return false;
  VectorX after;
  flow_.velocity(h, after);
  const VectorX reach = h * ((H * v_).cwiseAbs() + (H * after).cwiseAbs()), end = gap_ + h * (H * flow_.mean_velocity(h));
  return (gap_.cwiseMin(end) - reach).minCoeff() > 0;
}

double EventSplit::advance(System& system, double time, double length, StepResult& result) {
  if (length == step_length_ && closed_.empty()) {
    VectorX load;
    system.load_impulse(time, time + length, load);
    flow_.begin_whole(system, v_, force_, load, massless_);
    if (clear(system, length)) {
      take_whole(system, time, result);
      if (gap_.size() == 0) return length;
      find_gaps(system);
      result.least_gap = std::min(result.least_gap, gap_.minCoeff());
      return length;
    }
  }
  begin_flow(system, time, length, closed_);
  const Event event = find_event(length);
  const double s = event.time;
  result.active_pairs = std::max(result.active_pairs, static_cast<int>(closed_.size()));
  for (std::size_t k = 0; k < closed_.size(); ++k) {
    contact_impulse_[closed_[k]] += flow_.impulse(k, s);
    step_impulse_[closed_[k]] += flow_.impulse(k, s);
  }
  if (s > 0) evaluate(system, s, time, result);
  const int pairs = system.contacts().size();
  if (pairs == 0) return s;
  find_gaps(system);
  for (int c = 0; c < pairs; ++c) {
    if (is_closed(c)) continue;
    const auto i = static_cast<std::size_t>(c);
    const double tolerance = gap_tolerance(system, c);
    const bool hit = event.kind == Event::Kind::closes && (c == event.pair || std::abs(gap_[c]) <= tolerance);
    result.least_gap = std::min(result.least_gap, hit ? 0 : gap_[c]);
    touching_[i] = hit || (touching_[i] && gap_[c] <= tolerance);
    if (hit || (touching_[i] && std::abs(gap_[c]) <= tolerance)) {
      offset_[c] -= gap_[c];
      gap_[c] = 0;
    } else if (gap_[c] > 1e6 * tolerance) {
      offset_[c] = 0;
    }
  }
  remove_drift(system);
  if (event.kind == Event::Kind::opens) {
    end_contact(event.pair, time + s, result);
    touching_[static_cast<std::size_t>(event.pair)] = false;
  }
  const double left = length - s;
  if (event.kind != Event::Kind::none) collide(system, time + s, left > 0 ? left : step_length_, result);
  if (event.kind == Event::Kind::opens && !is_closed(event.pair)) touching_[static_cast<std::size_t>(event.pair)] = true;
  return event.kind == Event::Kind::none ? length : s;
}

void EventSplit::check_gaps(const System& system, double time) const {
  if (gap_.size() == 0) return;
  Eigen::Index pair = 0;
  const double least = gap_.minCoeff(&pair);
  if (least >= -(least_overlap + overlap_of_motion * step_length_ * largest_approach_)) return;
  throw ConvergenceError(fmt::format("contact pair '{}' overlaps by {:.3g} m after the step to t = {:.9g} s: its closing was missed",
                                     system.contacts().pairs[static_cast<std::size_t>(pair)].name, -least, time));
}

void EventSplit::step(System& system, const State& committed, State& trial, double h, StepResult& result) {
  result = StepResult{};
  result.least_gap = std::numeric_limits<double>::infinity();
  const bool fresh = last_displacement_.size() != committed.displacement.size() || last_displacement_ != committed.displacement ||
                     last_velocity_ != committed.velocity;
  last_displacement_.resize(0);  // a step that fails leaves contact somewhere: the next one then begins afresh
  q_ = committed.displacement;
  v_ = committed.velocity;
  force_ = committed.internal_force;
  step_length_ = h;
  if (!matrix_.ready(options_.theta * h)) matrix_.factor(system, stiffness_, options_.theta * h);
  flow_.set_step(h);
  step_impulse_.setZero();
  from_ = &committed.history;
  to_ = &trial.history;
  other_ = &history_;
  history_.resize(committed.history.size());
  if (fresh) start(system, committed);
  if (system.contacts().size() > 0) {
    find_gaps(system);
    // new loads may close pairs that touched without force
    if (fresh || std::find(touching_.begin(), touching_.end(), true) != touching_.end()) collide(system, committed.time, h, result);
  }
  double at = 0;
  for (int parts = 0; at < h; ++parts) {
    if (parts > most_parts) throw ConvergenceError(fmt::format("more than {} events within one step at t = {:.9g} s", most_parts, committed.time + at));
    const double length = h - at, s = advance(system, committed.time + at, length, result);
    at = s == length ? h : at + s;
  }
  check_gaps(system, committed.time + h);
  if (!system.linear() && from_ != &trial.history) trial.history = *from_;
  trial.time = committed.time + h;
  trial.displacement = q_;
  trial.velocity = v_;
  trial.internal_force = force_;
  trial.acceleration = (v_ - committed.velocity) / h;
  trial.impulse = step_impulse_;
  last_displacement_ = q_;
  last_velocity_ = v_;
}

Scheme::ModeResponse EventSplit::mode_response(double w, double xi, double h) const { return theta_method_response(options_.theta, w, xi, h); }

void EventSplit::save(Snapshot& snapshot) const {
  matrix_.save(snapshot);
  VectorX flags = VectorX::Zero(offset_.size());
  for (Eigen::Index c = 0; c < flags.size(); ++c) flags[c] = touching_[static_cast<std::size_t>(c)] ? 1 : 0;
  for (const int c : closed_) flags[c] = 2;
  snapshot.put("event_split.contact", flags);
  snapshot.put("event_split.offset", offset_);
  snapshot.put("event_split.contact_impulse", contact_impulse_);
  snapshot.put("event_split.largest_approach", largest_approach_);
  snapshot.put("event_split.displacement", last_displacement_);
  snapshot.put("event_split.velocity", last_velocity_);
}

void EventSplit::restore(System& system, const Snapshot& snapshot) {
  matrix_.restore(system, snapshot);
  const std::vector<double>& factored = snapshot.array("iteration_matrix.stiffness");
  if (!factored.empty()) std::copy(factored.begin(), factored.end(), stiffness_.valuePtr());
  VectorX flags = VectorX::Zero(offset_.size());
  snapshot.read("event_split.contact", flags);
  closed_.clear();
  for (Eigen::Index c = 0; c < flags.size(); ++c) {
    touching_[static_cast<std::size_t>(c)] = flags[c] == 1;
    if (flags[c] == 2) closed_.push_back(static_cast<int>(c));
  }
  snapshot.read("event_split.offset", offset_);
  snapshot.read("event_split.contact_impulse", contact_impulse_);
  largest_approach_ = snapshot.number("event_split.largest_approach");
  last_displacement_ = last_velocity_ = VectorX::Zero(system.mass().rows());
  snapshot.read("event_split.displacement", last_displacement_);
  snapshot.read("event_split.velocity", last_velocity_);
}

}  // namespace nsframe
