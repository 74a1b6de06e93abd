#include "integrators/flight.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "integrators/exact_kernel.hpp"

namespace nsframe {

namespace {

constexpr double series_angle = 0.05;  // w s up to which a return of a bounce is found from derivatives
constexpr std::array<double, 7> factorial{1, 1, 2, 6, 24, 120, 720};
constexpr int most_halvings = 60;
constexpr double near = 1e-8;          // of the size of what a gap is made of

}  // namespace

Flight::Flight(const ExactModes& modes, Propagator& propagator, SustainedContact& sustained)
    : modes_(modes), propagator_(propagator), sustained_(sustained) {
  if (!modes.special.empty() || !modes.couplings.empty() || modes.pairs() == 0) return;
  far_factor_ = (modes.gap.cwiseAbs2() * modes.square.cwiseAbs2().cwiseProduct(modes.square)).cwiseSqrt();
  row_size_ = modes.gap.rowwise().norm();
}

bool Flight::stays_far(const VectorX& gap, const VectorX& rate, double length, const ModalSize& size) const {
  const double fourth = std::sqrt(size.energy) * length * length * length * length / 384, x = std::sqrt(size.square);
  for (int c = 0; c < modes_.pairs(); ++c) {
    // the cubic through the ends' values and slopes, and what the gap may differ from it
    const double least = std::min(gap[c], finish_.gap[c]) - 0.25 * length * std::max(std::abs(rate[c]), std::abs(finish_.rate[c])) - fourth * far_factor_[c];
    if (!(least > near * (std::abs(contact_->constant[c]) + row_size_[c] * x))) return false;
  }
  return true;
}

void Flight::bound(double length, bool disturbed) {
  if (disturbed || !bound_holds_ || !contact_->closed.empty()) {
    rounding_.resize(modes_.pairs());
    rate_rounding_.resize(modes_.pairs());
    propagator_.bound_fourth(*state_, fourth_);
    size_ = state_->x.cwiseAbs();
    rate_size_ = state_->y.cwiseAbs();
    multiply_gaps(modes_.padded, modes_.pairs(), modes_.gap_size.data(), size_.data(), rate_size_.data(), rounding_.data(), rate_rounding_.data());
    rounding_ = 64 * machine_epsilon * (rounding_ + contact_->constant.cwiseAbs());
    rate_rounding_ *= 64 * machine_epsilon;
    for (int c = 0; c < modes_.pairs() && !forces_.empty(); ++c) fourth_[c] += sustained_.fourth_bound(forces_, c);
    bound_holds_ = contact_->closed.empty();
  }
  tolerance_ = rounding_ + length * rate_rounding_;
}

void Flight::add_compliance(double s, VectorX& gap, VectorX& rate) const {
  for (std::size_t k = 0; k < forces_.pairs.size(); ++k) {
    const int other = forces_.pairs[k];
    if (!modes_.compliant[static_cast<std::size_t>(other)]) continue;
    gap += SustainedContact::value(forces_, k, s) * modes_.compliance.col(other);
    rate += sustained_.slope(forces_, k, s) * modes_.compliance.col(other);
  }
}

void Flight::evaluate(double s, Sample& sample) {
  sample.time = s;
  sample.gap.resize(modes_.pairs());
  sample.rate.resize(modes_.pairs());
  if (forces_.empty()) {
    propagator_.move(*state_, s, probe_);
  } else {
    sustained_.move(*state_, forces_, s, probe_);
  }
  ++evaluations_;
  multiply_gaps(modes_.padded, modes_.pairs(), modes_.gap.data(), probe_.x.data(), probe_.y.data(), sample.gap.data(), sample.rate.data());
  sample.gap += contact_->constant;
  add_compliance(s, sample.gap, sample.rate);
}

Eigen::Matrix<double, 7, 1> Flight::derivatives(int pair) {
  if (!have_derivatives_) {
    propagator_.derivatives(*state_, mode_derivatives_);
    have_derivatives_ = true;
  }
  Eigen::Matrix<double, 7, 1> gap = mode_derivatives_.transpose() * modes_.gap.row(pair).transpose();
  if (!forces_.empty()) sustained_.add_derivatives(forces_, pair, gap);
  return gap;
}

void Flight::find_openings(FlightEvent& event) const {
  for (std::size_t k = 0; k < forces_.pairs.size(); ++k) {
    const VectorX b = sustained_.bernstein(forces_, k);
    const double at = forces_.length * first_negative(b, std::max(1e-11 * b.cwiseAbs().maxCoeff(), forces_.noise[static_cast<Eigen::Index>(k)]));
    if (at < event.time) event = {at, FlightEvent::Kind::opens, forces_.pairs[k]};
  }
}

// Pairs that touch now: open for certain over the (possibly shortened) flight, or back at zero within it.
void Flight::follow_touching(FlightEvent& event) {
  for (int c = 0; c < modes_.pairs(); ++c) {
    if (skip_[static_cast<std::size_t>(c)] || !contact_->touching[static_cast<std::size_t>(c)]) continue;
    const Eigen::Matrix<double, 7, 1> d = derivatives(c);
    const double noise = 16 * machine_epsilon * modes_.gap_size.row(c).dot(state_->y.cwiseAbs());
    const double rate = d[1] > noise ? d[1] : 0;
    const double noise2 = 64 * machine_epsilon * mode_derivatives_.col(2).cwiseAbs().dot(modes_.gap_size.row(c).transpose());
    const double second = std::abs(d[2]) > noise2 ? d[2] : 0;
    if (rate > 0 && second < 0) {
      double back = -2 * rate / second;
      if (back * modes_.highest < series_angle) {
        double change = back;
        for (int i = 0; i < 20 && std::abs(change) > 4 * machine_epsilon * back; ++i) {  // Newton on g(s) / s
          double value = 0, slope = 0;
          for (int n = 6; n >= 1; --n) {
            slope = slope * back + value;
            value = value * back + d[n] / factorial[static_cast<std::size_t>(n)];
          }
          change = -value / slope;
          back += change;
        }
        if (back > 0 && std::abs(change) <= 64 * machine_epsilon * back) {  // open until then
          if (back <= event.time) event = {back, FlightEvent::Kind::closes, c};
          skip_[static_cast<std::size_t>(c)] = true;
          continue;
        }
      }
    }
    if (rate == 0 && second <= 0 && !(second == 0 && d[3] > 0)) continue;  // touches without leaving: judged by the tolerance
    const double open = certain_opening(rate, second, d[3], fourth_[c], event.time);
    if (open <= 0) continue;
    skip_[static_cast<std::size_t>(c)] = true;
    if (open < event.time) event = {open, FlightEvent::Kind::none, -1};
  }
}

GapPiece Flight::piece(int pair, const Sample& a, const Sample& b) const {
  return {b.time - a.time, a.gap[pair], a.rate[pair], b.gap[pair], b.rate[pair], fourth_[pair]};
}

double Flight::refine(int pair, const Sample& a, const Sample& b) {
  double low = a.time, high = b.time;
  const GapPiece whole = piece(pair, a, b);
  const double error = whole.fourth * std::pow(whole.h, 4) / 384;
  double at = low + first_fall(whole, whole.start > tolerance_[pair] ? 0 : -0.5 * tolerance_[pair]);
  if (error <= 0.25 * tolerance_[pair] || whole.start <= 0) return at;
  Sample sample;
  for (int i = 0; i < 60; ++i) {
    if (!(at > low && at < high)) at = 0.5 * (low + high);
    evaluate(at, sample);
    const double gap = sample.gap[pair];
    (gap > 0 ? low : high) = at;
    const double change = -gap / sample.rate[pair];
    if (std::abs(gap) <= tolerance_[pair] / 64 || high - low <= 2 * machine_epsilon * high || std::abs(change) <= machine_epsilon * at) break;
    at += change;
  }
  return at;
}

FlightEvent Flight::search(const Sample& a, const Sample& b, int depth) {
  bool unsure = false;
  std::vector<int> closing;
  for (int c = 0; c < modes_.pairs(); ++c) {
    if (skip_[static_cast<std::size_t>(c)]) continue;
    const Verdict verdict = judge(piece(c, a, b), tolerance_[c]);
    if (verdict == Verdict::closes) closing.push_back(c);
    if (verdict == Verdict::unsure) unsure = true;
  }
  if (unsure && depth < most_halvings) {
    Sample middle;
    evaluate(0.5 * (a.time + b.time), middle);
    const FlightEvent first = search(a, middle, depth + 1);
    return first.kind != FlightEvent::Kind::none ? first : search(middle, b, depth + 1);
  }
  FlightEvent event{b.time, FlightEvent::Kind::none, -1};
  for (const int c : closing) {
    const double at = refine(c, a, b);
    if (at <= event.time) event = {at, FlightEvent::Kind::closes, c};
  }
  return event;
}

FlightEvent Flight::find(const ModalState& state, const ContactState& contact, const VectorX& gap, const VectorX& rate, double length, bool regular,
                         bool disturbed) {
  state_ = &state;
  contact_ = &contact;
  have_derivatives_ = have_energy_ = false;
  propagator_.begin(state);
  const int pairs = modes_.pairs();
  FlightEvent event{length, FlightEvent::Kind::none, -1};
  if (pairs == 0) {
    regular ? propagator_.step(state, length, end_) : propagator_.move(state, length, end_);
    return event;
  }
  forces_.pairs.clear();
  for (Sample* sample : {&start_, &finish_}) {
    sample->gap.resize(pairs);
    sample->rate.resize(pairs);
  }
  const auto find_gaps = [&](double s) {
    multiply_gaps(modes_.padded, pairs, modes_.gap.data(), end_.x.data(), end_.y.data(), finish_.gap.data(), finish_.rate.data());
    finish_.gap += contact.constant;
    add_compliance(s, finish_.gap, finish_.rate);
    finish_.time = s;
  };
  const auto move_to = [&](double s) {
    have_energy_ = false;
    if (!forces_.empty()) {
      sustained_.move(state, forces_, s, end_);
    } else if (regular && s == length) {
      propagator_.step(state, s, end_);
    } else {
      propagator_.move(state, s, end_);
    }
    find_gaps(s);
  };
  const bool open = contact.closed.empty() && std::none_of(contact.touching.begin(), contact.touching.end(), [](bool touches) { return touches; });
  bool moved = false;
  if (open && far_factor_.size() > 0) {
    if (regular) {
      sums_ = propagator_.step_and_sum(state, length, end_);
      have_energy_ = true;
    } else {
      propagator_.move(state, length, end_);
      sums_.size = propagator_.size(state);
    }
    find_gaps(length);
    if (stays_far(gap, rate, length, sums_.size)) {
      bound_holds_ = bound_holds_ && !disturbed;
      event.far = true;
      return event;
    }
    moved = true;
  }
  skip_.assign(static_cast<std::size_t>(pairs), false);
  if (!contact.closed.empty()) {
    event.time = std::min(length, sustained_.panel());
    forces_ = sustained_.solve(state, contact.constant, contact.closed);
    for (const int c : contact.closed) skip_[static_cast<std::size_t>(c)] = true;
    find_openings(event);
  }
  bound(event.time, disturbed);
  follow_touching(event);
  multiply_gaps(modes_.padded, pairs, modes_.gap.data(), state.x.data(), state.y.data(), start_.gap.data(), start_.rate.data());
  start_.gap += contact.constant;
  add_compliance(0, start_.gap, start_.rate);
  for (int c = 0; c < pairs; ++c) {
    if (contact.touching[static_cast<std::size_t>(c)]) start_.gap[c] = 0;
  }
  if (!moved) move_to(event.time);
  const FlightEvent earlier = search(start_, finish_, 0);
  if (earlier.kind != FlightEvent::Kind::none) {
    event = earlier;
    move_to(event.time);
  }
  return event;
}

}  // namespace nsframe
