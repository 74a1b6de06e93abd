#include "integrators/event_flow.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/decompositions.hpp"
#include "base/errors.hpp"
#include "integrators/exact_kernel.hpp"

namespace nsframe {

namespace {

constexpr int most_events = 1000000;      // between two kept results: some seconds of work
constexpr double time_quantum = 0x1p-40;  // of dt: lengths of pieces are multiples, so that their coefficients recur

double highest_mode(const AnalysisOptions& options) {
  return options.highest_frequency > 0 ? 2 * pi * options.highest_frequency : std::numeric_limits<double>::infinity();
}

}  // namespace

EventFlow::EventFlow(const AnalysisOptions& options, const System& system, const SparseMatrix& stiffness)
    : options_(options),
      highest_(highest_mode(options)),
      modes_(exact_modes(system, stiffness, highest_)),
      propagator_(modes_),
      sustained_(modes_, propagator_),
      flight_(modes_, propagator_, sustained_) {
  const int pairs = modes_.pairs();
  contact_.touching.assign(static_cast<std::size_t>(pairs), false);
  contact_.constant = modes_.gap_offset;
  contact_impulse_ = step_impulse_ = VectorX::Zero(pairs);
}

Scheme::LeftOut EventFlow::left_out() const { return {modes_.left_out, modes_.kept_mass.size() > 0 ? modes_.kept_mass.minCoeff() : 1}; }

void EventFlow::start(const System& system, const State& committed) {
  double done = 0;
  for (const double cut : cuts(system, committed.time, options_.dt)) propagator_.prepare(cut - std::exchange(done, cut));
  modes_.projection.multiply(committed.displacement, state_.x);
  modes_.projection.multiply(committed.velocity, state_.y);
  for (const DampingCoupling& coupling : modes_.couplings) {
    for (Eigen::Index i = 0; i < coupling.rest.size(); ++i) state_.x[coupling.places[static_cast<std::size_t>(coupling.square.size() + i)]] -= coupling.rest[i];
  }
  propagator_.coupled().clear_rates(state_);
  state_.f0 = state_.f1 = VectorX::Zero(modes_.padded);
  set_load(system, committed.time, 0);
  contact_.closed.clear();
  std::fill(contact_.touching.begin(), contact_.touching.end(), false);
  contact_.constant = modes_.gap_offset;
  contact_impulse_.setZero();
  disturbed_ = true;
  if (modes_.pairs() == 0) return;
  gap_ = modes_.gap * state_.x + contact_.constant;
  rate_ = modes_.gap * state_.y;
  for (int c = 0; c < modes_.pairs(); ++c) {
    const auto at = static_cast<std::size_t>(c);
    const double tolerance = 1e-12 * (std::abs(contact_.constant[c]) + modes_.gap_size.row(c).dot(state_.x.cwiseAbs()) + 1e-6);
    if (gap_[c] > tolerance) continue;
    if (modes_.compliant[at]) {
      contact_.closed.push_back(c);
    } else if (gap_[c] < -tolerance) {
      throw InputError(fmt::format("error: contact pair '{}' overlaps by {:.3g} m at t = {:g} s; the scheme starts from open or touching pairs",
                                   system.contacts().pairs[at].name, -gap_[c], committed.time));
    } else {
      contact_.touching[at] = true;
      contact_.constant[c] -= gap_[c];
      gap_[c] = 0;
    }
  }
}

void EventFlow::find_load(const System& system, double time, double length, VectorX& f0, VectorX& f1) const {
  const auto& motions = system.model.motions;
  if (force_.value.size() > 0) {
    f0 = modes_.static_load - force_.value - (time - force_.time) * force_.slope;
    f1 = -force_.slope;
  } else {
    f0 = modes_.static_load;
    f1.setZero(modes_.padded);
  }
  for (std::size_t i = 0; i < motions.size(); ++i) {
    const GroundMotion& motion = motions[i];
    // the samples around the middle of the piece: its ends may round to either side of a sample
    const double middle = time + 0.5 * length;
    if (motion.acceleration.size() < 2 || middle < motion.start || middle > motion.duration()) continue;
    const auto [k, since, slope] = motion.piece_at(middle);
    f0 += (motion.acceleration[k] + slope * (time - motion.start - static_cast<double>(k) * motion.dt)) * modes_.motion_load[i];
    f1 += slope * modes_.motion_load[i];
  }
}

void EventFlow::set_force(const VectorX& value, const VectorX& slope, double time) {
  force_.value = value;
  force_.slope = slope;
  force_.time = time;
}

void EventFlow::set_load(const System& system, double time, double length) {
  find_load(system, time, length, state_.f0, slope_);
  disturbed_ = disturbed_ || slope_ != state_.f1;
  std::swap(state_.f1, slope_);
}

const std::vector<double>& EventFlow::cuts(const System& system, double time, double h) {
  if (time == cut_time_ && h == cut_length_) return cuts_;
  cut_time_ = time;
  cut_length_ = h;
  std::vector<double>& cuts = cuts_;
  cuts.clear();
  for (const GroundMotion& motion : system.model.motions) {
    if (motion.acceleration.empty()) continue;
    const double close = 1e-9 * std::min(motion.dt, h);
    for (double k = std::max(0.0, std::ceil((time + close - motion.start) / motion.dt)); k < static_cast<double>(motion.acceleration.size()); ++k) {
      const double at = motion.start + k * motion.dt - time;
      if (at >= h - close) break;
      if (at > close) cuts.push_back(at);
    }
  }
  if (cuts.empty()) {
    cuts.push_back(h);
    return cuts;
  }
  const double quantum = h * time_quantum;
  for (double& cut : cuts) cut = std::round(cut / quantum) * quantum;
  cuts.push_back(h);
  std::sort(cuts.begin(), cuts.end());
  cuts.erase(std::unique(cuts.begin(), cuts.end()), cuts.end());
  return cuts;
}

void EventFlow::copy_to(FlowState& state) const {
  state.modal = state_;
  state.contact = contact_;
  state.gap = gap_;
  state.rate = rate_;
  state.contact_impulse = contact_impulse_;
  state.step_impulse = step_impulse_;
  state.largest_approach = largest_approach_;
}

void EventFlow::go_back(const FlowState& state) {
  state_ = state.modal;
  contact_ = state.contact;
  gap_ = state.gap;
  rate_ = state.rate;
  contact_impulse_ = state.contact_impulse;
  step_impulse_ = state.step_impulse;
  largest_approach_ = state.largest_approach;
  disturbed_ = true;
}

void EventFlow::travel(const System& system, double time, double h, bool starting, StepResult& result) {
  double done = 0;
  for (const double cut : cuts(system, time, h)) {
    set_load(system, time + done, cut - done);
    if (starting && done == 0) collide(system, time, h, result);
    advance(system, time + done, cut - done, result);
    done = cut;
  }
}

bool EventFlow::glide(const System& system, double time, double h, ModalState& end) {
  const int pairs = modes_.pairs();
  if (!modes_.couplings.empty() || !contact_.closed.empty()) return false;
  for (int c = 0; c < pairs; ++c) {
    if (contact_.touching[static_cast<std::size_t>(c)] || gap_[c] <= h * std::abs(rate_[c])) return false;
  }
  piece_.x = state_.x;
  piece_.y = state_.y;
  double done = 0;
  for (const double cut : cuts(system, time, h)) {
    find_load(system, time + done, cut - done, piece_.f0, piece_.f1);
    propagator_.step(piece_, cut - done, end);
    done = cut;
    if (cut < h) std::swap(piece_, end);
  }
  if (pairs == 0) return true;
  glide_gap_.resize(pairs);
  glide_rate_.resize(pairs);
  multiply_gaps(modes_.padded, pairs, modes_.gap.data(), end.x.data(), end.y.data(), glide_gap_.data(), glide_rate_.data());
  return ((glide_gap_ + contact_.constant - h * glide_rate_.cwiseAbs()).array() > 0).all();
}

void EventFlow::add_contact_load(VectorX& load) const {
  const ContactForces& forces = flight_.forces();
  for (std::size_t k = 0; k < forces.pairs.size(); ++k) {
    load += SustainedContact::value(forces, k, flight_.end_time()) * modes_.gap.row(forces.pairs[k]).transpose();
  }
}

void EventFlow::write(VectorX& displacement, VectorX& velocity) {
  propagator_.coupled().set_rates(state_);
  modes_.shape.multiply(modes_.rest, state_.x, state_.y, displacement, velocity);
  propagator_.coupled().clear_rates(state_);
  if (closed_pairs(true).empty()) return;
  displacement += modes_.massless_response * compliant_forces(contact_.constant + modes_.gap * state_.x);
  velocity += modes_.massless_response * compliant_forces(modes_.gap * state_.y);
}

std::vector<int> EventFlow::closed_pairs(bool compliant) const {
  std::vector<int> pairs;
  for (const int c : contact_.closed) {
    if (modes_.compliant[static_cast<std::size_t>(c)] == compliant) pairs.push_back(c);
  }
  return pairs;
}

// Forces of the closed compliant pairs that close these gaps (or their rates), 0 elsewhere.
VectorX EventFlow::compliant_forces(const VectorX& gap) const {
  VectorX forces = VectorX::Zero(modes_.pairs());
  const std::vector<int> springs = closed_pairs(true);
  if (springs.empty()) return forces;
  const MatrixX Y = modes_.compliance(springs, springs);
  const VectorX closing = -gap(springs), solution = RankRevealing<double>(Y, machine_epsilon * static_cast<double>(Y.rows())).solve(closing);
  forces(springs) = solution;
  return forces;
}

// With the forces of the flight that has just been found: of rigid pairs they do no work, of compliant ones they are in the strain.
void EventFlow::add_energy(double time, double s, StepResult& result) {
  const ModalState& end = flight_.end();
  FlightEnergy change = flight_.energy(s);
  change.work += sustained_.work(state_.f1, flight_.forces(), s);
  double springs = 0, rest = 0;
  if (!contact_.closed.empty()) {
    const VectorX before = compliant_forces(contact_.constant + modes_.gap * state_.x), after = compliant_forces(contact_.constant + modes_.gap * end.x);
    springs = 0.5 * (after.dot(modes_.compliance * after) - before.dot(modes_.compliance * before));
    rest = modes_.rest_gap.dot(after - before);
  }
  rest += propagator_.coupled().rest_work(state_.x, end.x);
  double against = 0;
  if (force_.value.size() > 0) {
    against = propagator_.energy(force_.value + (time - force_.time) * force_.slope, force_.slope, state_, end, s).work +
              sustained_.work(force_.slope, flight_.forces(), s);
  }
  result.strain += change.strain + springs + rest + against;
  result.input += change.work + rest + against;
  if (!modes_.undamped) result.damping += change.work - change.strain - springs - change.kinetic;
}

void EventFlow::refuse_to_go_on(const System& system, double time, double interval) const {
  Eigen::Index nearest = 0;
  gap_.cwiseAbs().minCoeff(&nearest);
  const auto pair = static_cast<std::size_t>(nearest);
  throw ConvergenceError(fmt::format("more than {} impacts and openings within one step at t = {:.9g} s, one every {:.2g} s, at last at pair '{}': a "
                                     "light mass between heavy ones with a restitution near 1 ({:g}) does that",
                                     most_events, time, interval, system.contacts().pairs[pair].name, system.contacts().restitution[nearest]));
}

void EventFlow::advance(const System& system, double time, double length, StepResult& result) {
  const double end = length;
  double at = 0;
  for (int events = 0; at < end; ++events) {
    if (events > most_events) refuse_to_go_on(system, time + at, at / most_events);
    const FlightEvent event = flight_.find(state_, contact_, gap_, rate_, end - at, at == 0, disturbed_);
    disturbed_ = false;
    const double s = event.time;
    result.active_pairs = std::max(result.active_pairs, static_cast<int>(contact_.closed.size()));
    add_energy(time + at, s, result);
    const ContactForces& forces = flight_.forces();
    for (std::size_t k = 0; k < forces.pairs.size(); ++k) {
      const double impulse = SustainedContact::impulse(forces, k, s);
      contact_impulse_[forces.pairs[k]] += impulse;
      step_impulse_[forces.pairs[k]] += impulse;
    }
    std::swap(state_, flight_.end());
    const bool last = event.kind == FlightEvent::Kind::none && s >= end - at;
    at = last ? end : at + s;
    if (modes_.pairs() == 0) continue;
    gap_ = flight_.end_gap();
    rate_ = flight_.end_rate();
    if (event.far) {
      result.least_gap = std::min(result.least_gap, gap_.minCoeff());
      contact_.constant = modes_.gap_offset;
      continue;
    }
    for (int c = 0; c < modes_.pairs(); ++c) {
      const auto i = static_cast<std::size_t>(c);
      if (std::binary_search(contact_.closed.begin(), contact_.closed.end(), c)) continue;
      const bool hit = event.kind == FlightEvent::Kind::closes && (c == event.pair || std::abs(gap_[c]) <= flight_.tolerance(c));
      contact_.touching[i] = hit || gap_[c] <= flight_.tolerance(c);
      result.least_gap = std::min(result.least_gap, gap_[c]);
      if (contact_.touching[i]) {  // take rounding out: the gap is zero now
        contact_.constant[c] -= gap_[c];
        gap_[c] = 0;
      } else if (gap_[c] > 1e6 * flight_.tolerance(c)) {
        contact_.constant[c] = modes_.gap_offset[c];
      }
    }
    remove_drift();
    const bool opens = event.kind == FlightEvent::Kind::opens;
    if (opens) {
      end_contact(event.pair, time + at, result);
      contact_.touching[static_cast<std::size_t>(event.pair)] = false;  // its force is zero: rounding may not close it again at once
    }
    if (event.kind != FlightEvent::Kind::none) collide(system, time + at, end - at, result);
    if (opens && !std::binary_search(contact_.closed.begin(), contact_.closed.end(), event.pair)) contact_.touching[static_cast<std::size_t>(event.pair)] = true;
  }
}

void EventFlow::save(Snapshot& snapshot) const {
  snapshot.put("flow.x", state_.x);
  snapshot.put("flow.y", state_.y);
  snapshot.put("flow.f0", state_.f0);
  snapshot.put("flow.f1", state_.f1);
  snapshot.put("flow.constant", contact_.constant);
  snapshot.put("flow.gap", gap_);
  snapshot.put("flow.rate", rate_);
  VectorX flags = VectorX::Zero(modes_.pairs());
  for (int c = 0; c < modes_.pairs(); ++c) flags[c] = contact_.touching[static_cast<std::size_t>(c)] ? 1 : 0;
  for (const int c : contact_.closed) flags[c] = 2;
  snapshot.put("flow.contact", flags);
  snapshot.put("flow.contact_impulse", contact_impulse_);
  snapshot.put("flow.largest_approach", largest_approach_);
}

void EventFlow::restore(const Snapshot& snapshot) {
  state_.x = state_.y = state_.f0 = state_.f1 = VectorX::Zero(modes_.padded);
  snapshot.read("flow.x", state_.x);
  snapshot.read("flow.y", state_.y);
  snapshot.read("flow.f0", state_.f0);
  snapshot.read("flow.f1", state_.f1);
  snapshot.read("flow.constant", contact_.constant);
  gap_ = rate_ = VectorX::Zero(modes_.pairs());
  snapshot.read("flow.gap", gap_);
  snapshot.read("flow.rate", rate_);
  VectorX flags = VectorX::Zero(modes_.pairs());
  snapshot.read("flow.contact", flags);
  contact_.closed.clear();
  for (int c = 0; c < modes_.pairs(); ++c) {
    contact_.touching[static_cast<std::size_t>(c)] = flags[c] == 1;
    if (flags[c] == 2) contact_.closed.push_back(c);
  }
  snapshot.read("flow.contact_impulse", contact_impulse_);
  largest_approach_ = snapshot.number("flow.largest_approach");
  disturbed_ = true;
}

std::vector<std::string> EventFlow::describe() const {
  std::vector<std::string> lines;
  lines.push_back(fmt::format("natural modes: {}{}", modes_.moving,
                              modes_.massless > 0 ? fmt::format(", {} DOFs without mass condensed", modes_.massless) : ""));
  if (modes_.left_out > 0) {
    std::string mass;
    if (modes_.kept_mass.size() > 0) mass = fmt::format("; those that move hold {:.1f} % of the mass that the motion shakes", 100 * left_out().kept_mass);
    lines.push_back(fmt::format("{} modes above {:g} Hz left out of motion and contact: they follow static loads and what yields at once{}", modes_.left_out,
                                options_.highest_frequency, mass));
  }
  for (const DampingCoupling& coupling : modes_.couplings) {
    const auto first_order = coupling.rate.size();
    lines.push_back(fmt::format("damping ties {} modes of structure '{}' together{}: complex modes, condition {:.3g}", coupling.square.size(), coupling.structure,
                                first_order > 0 ? fmt::format(", with {} motion{} of first order (dashpots without mass)", first_order, first_order == 1 ? "" : "s") : "",
                                coupling.form.condition));
  }
  const auto springs = std::count(modes_.compliant.begin(), modes_.compliant.end(), true);
  if (springs > 0) lines.push_back(fmt::format("{} contact pair{} reached through DOFs without mass: springs in series, without impulse", springs, springs == 1 ? "" : "s"));
  return lines;
}

}  // namespace nsframe
