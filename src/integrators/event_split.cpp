#include "integrators/event_split.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/errors.hpp"
#include "integrators/gap_roots.hpp"

namespace nsframe {

namespace {

constexpr int most_parts = 100000;   // of a step
// Overlap after a step that is an error: [m], and of what the fastest approach so far moves in a step.
constexpr double least_overlap = 1e-7, overlap_of_motion = 0.01;
constexpr double instant = 1e-3;     // of the longest part, after which what touches without rate is seen to open or to press
constexpr double calm = 30;          // angle by which a struck point rings on after contact, until whole steps are taken again
constexpr double least_part = 1e-6;  // of the longest part, from which loads have a slope

const System& accepted_by_event_split(const System& system) {
  const char* why = nullptr;
  if (system.assembler.rate_dependent()) why = "has elements whose force depends on the rate of deformation";
  if (system.damping.follows_tangent()) why = "has Rayleigh damping on the committed or current stiffness";
  if (why) throw InputError(fmt::format("error: scheme 'event-split' cannot take this scene: it {}; use scheme = \"moreau-jean\"", why));
  return system;
}

SparseMatrix symmetric_stiffness(const System& system) {
  const SparseMatrix& K = system.initial_stiffness;
  return 0.5 * (K + SparseMatrix(K.transpose()));
}

}  // namespace

EventSplit::EventSplit(const AnalysisOptions& options, const System& system)
    : options_(options), method_(make_flight_method(options, accepted_by_event_split(system))), impact_(system),
      parts_{IterationMatrix(system), symmetric_stiffness(system)}, flow_(method_->part_rule(), parts_.matrix), tangent_(system),
      ladder_(options.algorithm) {
  const Contacts& contacts = system.contacts();
  touching_.assign(static_cast<std::size_t>(contacts.size()), false);
  offset_ = contact_impulse_ = step_impulse_ = rate_ = VectorX::Zero(contacts.size());
  for (Eigen::Index i = 0; i < system.mass().rows(); ++i) massless_.push_back(impact_.massless(i));
  for (int c = 0; c < contacts.size(); ++c) {
    if (impact_.compliant(c)) continue;
    const VectorX jump = impact_.velocity_change(VectorX(contacts.jacobian.row(c).transpose()));
    const double inertia = jump.dot(system.mass() * jump);
    if (inertia > 0) struck_ = std::max(struck_, std::sqrt(jump.dot(parts_.stiffness * jump) / inertia));
  }
}

std::vector<std::string> EventSplit::describe() const {
  std::vector<std::string> lines{method_->describe()};
  if (struck_ > 0) {
    lines.push_back(fmt::format("struck points ring at up to {:.0f} Hz: steps near contact go in {} part{}", struck_ / (2 * pi), parts_of(options_.dt),
                                parts_of(options_.dt) == 1 ? "" : "s"));
  }
  return lines;
}

bool EventSplit::is_closed(int pair) const { return std::binary_search(closed_.begin(), closed_.end(), pair); }

double EventSplit::gap_tolerance(const System& system, int pair) const {
  double size = std::abs(system.contacts().initial_gap[pair]);
  const SparseRows& H = system.contacts().jacobian;
  for (SparseRows::InnerIterator entry(H, pair); entry; ++entry) size += std::abs(entry.value() * now_.q[entry.col()]);
  return 64 * machine_epsilon * size + 1e-18;
}

double EventSplit::look_ahead(double remaining) const { return std::min(remaining, instant * part_length_); }

double EventSplit::rate_tolerance() const { return 64 * machine_epsilon * now_.v.cwiseAbs().maxCoeff() + 1e-12 * largest_approach_; }

void EventSplit::find_gaps(const System& system) {
  gap_ = system.contacts().jacobian * now_.q;
  gap_ += system.contacts().initial_gap + offset_;
}

EventSplit::Event EventSplit::find_event(double length) const {
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

bool EventSplit::clear(const System& system, const Motion& motion, double h) const {
  const Contacts& contacts = system.contacts();
  const VectorX gap = contacts.jacobian * motion.q + contacts.initial_gap, rate = contacts.jacobian * motion.v;
  return (gap - h * rate.cwiseAbs()).minCoeff() > 0;
}

bool EventSplit::fly(System& system, double time, double h, StepResult& result) {
  const bool contact = system.contacts().size() > 0;
  if (!closed_.empty() || std::find(touching_.begin(), touching_.end(), true) != touching_.end()) return false;
  if (contact && (!clear(system, now_, h) || (parts_of(h) > 1 && (time - last_contact_) * struck_ < calm))) return false;
  method_->step(system, {time, h, now_, *from_, *to_}, next_, result);
  if (contact && !clear(system, next_, h)) {
    result.guess_stood = false;
    return false;
  }
  std::swap(now_, next_);
  if (!system.linear()) {
    from_ = to_;
    std::swap(to_, other_);
  }
  account(system, next_, time, h, method_->dissipated(system, next_, now_), result);
  if (!contact) return true;
  offset_.setZero();
  find_gaps(system);
  result.least_gap = std::min(result.least_gap, gap_.minCoeff());
  return true;
}

double EventSplit::advance(System& system, double time, double length, StepResult& result) {
  begin_flow(system, time, length, closed_);
  const Event event = system.linear() ? find_event(length) : solve_part(system, time, length, result);
  const double s = event.time;
  result.active_pairs = std::max(result.active_pairs, static_cast<int>(closed_.size()));
  for (std::size_t k = 0; k < closed_.size(); ++k) {
    contact_impulse_[closed_[k]] += flow_.impulse(k, s);
    step_impulse_[closed_[k]] += flow_.impulse(k, s);
  }
  if (s > 0) evaluate(system, s, time, result);
  const int pairs = system.contacts().size();
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
  if (event.kind != Event::Kind::none || !closed_.empty()) last_contact_ = time + s;
  const double left = length - s;
  if (event.kind != Event::Kind::none) collide(system, time + s, left > least_part * part_length_ ? left : part_length_, result);
  if (event.kind == Event::Kind::opens && !is_closed(event.pair)) touching_[static_cast<std::size_t>(event.pair)] = true;
  return event.kind == Event::Kind::none ? length : s;
}

void EventSplit::check_gaps(const System& system, double time, double h) const {
  if (gap_.size() == 0) return;
  Eigen::Index pair = 0;
  const double least = gap_.minCoeff(&pair);
  if (least >= -(least_overlap + overlap_of_motion * h * largest_approach_)) return;
  throw ConvergenceError(fmt::format("contact pair '{}' overlaps by {:.3g} m after the step to t = {:.9g} s: its closing was missed",
                                     system.contacts().pairs[static_cast<std::size_t>(pair)].name, -least, time));
}

void EventSplit::step(System& system, const State& committed, State& trial, double h, StepResult& result) {
  result.clear();
  const bool fresh = !std::exchange(goes_on_, false);  // a step that fails leaves contact somewhere: the next one then begins afresh
  now_ = {committed.displacement, committed.velocity, committed.internal_force, fresh ? VectorX() : std::move(now_.a), {}};
  step_impulse_.setZero();
  tangent_.in_use = false;
  from_ = &committed.history;
  to_ = &trial.history;
  other_ = &history_;
  history_.resize(committed.history.size());
  if (fresh) start(system, committed);
  if (!fly(system, committed.time, h, result)) {
    prepare_parts(system, h);
    find_gaps(system);
    // new loads may close pairs that touched without force
    const bool touching = std::find(touching_.begin(), touching_.end(), true) != touching_.end();
    if (fresh || touching) collide(system, committed.time, part_length_, result);
    double at = 0;
    for (int parts = 0; at < h; ++parts) {
      if (parts > most_parts) {
        throw ConvergenceError(fmt::format("more than {} events within one step at t = {:.9g} s", most_parts, committed.time + at));
      }
      const bool last = h - at < part_length_ * (1 + least_part);
      const double length = last ? h - at : part_length_, s = advance(system, committed.time + at, length, result);
      at = last && s == length ? h : at + s;
    }
    check_gaps(system, committed.time + h, h);
  }
  if (!system.linear() && from_ != &trial.history) trial.history = *from_;
  trial.time = committed.time + h;
  trial.displacement = now_.q;
  trial.velocity = now_.v;
  trial.internal_force = now_.P;
  trial.acceleration = (now_.v - committed.velocity) / h;
  trial.impulse = step_impulse_;
  goes_on_ = true;
}

void EventSplit::save(Snapshot& snapshot) const {
  method_->save(snapshot);
  parts_.save(snapshot, "event_split.parts");
  tangent_.own.save(snapshot, "event_split.tangent");
  VectorX flags = VectorX::Zero(offset_.size());
  for (Eigen::Index c = 0; c < flags.size(); ++c) flags[c] = touching_[static_cast<std::size_t>(c)] ? 1 : 0;
  for (const int c : closed_) flags[c] = 2;
  snapshot.put("event_split.contact", flags);
  snapshot.put("event_split.offset", offset_);
  snapshot.put("event_split.contact_impulse", contact_impulse_);
  snapshot.put("event_split.largest_approach", largest_approach_);
  snapshot.put("event_split.last_contact", last_contact_);
  snapshot.put("event_split.goes_on", goes_on_ ? 1.0 : 0.0);
  snapshot.put("event_split.acceleration", now_.a);
}

void EventSplit::restore(System& system, const Snapshot& snapshot) {
  method_->restore(system, snapshot);
  parts_.restore(system, snapshot, "event_split.parts");
  tangent_.own.restore(system, snapshot, "event_split.tangent");
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
  last_contact_ = snapshot.number("event_split.last_contact");
  goes_on_ = snapshot.number("event_split.goes_on") != 0;
  const std::vector<double>& acceleration = snapshot.array("event_split.acceleration");
  now_.a = Eigen::Map<const VectorX>(acceleration.data(), static_cast<Eigen::Index>(acceleration.size()));
}

}  // namespace nsframe
