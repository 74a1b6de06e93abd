#include "integrators/exact_propagator.hpp"

#include <algorithm>
#include <cmath>

namespace nsframe {

namespace {

constexpr std::size_t most_steps = 64;

// Impulse response B and its integrals by their Taylor series: for (w + 2 a) s up to 1.
StepCoefficients by_series(long double square, long double a, const TaylorPowers& power) {
  long double A = 0, B = 0, L = 0, R = 0, Q = 0;   // A: of B'
  long double before = 0, r = 1, last = 1;         // r: n-th derivative of the impulse response at 0
  for (int n = 1; n <= TaylorPowers::terms; ++n) {
    const long double slope = r * power[n - 1], term = std::abs(slope);
    if (std::max(term, last) < 0x1p-68L) break;  // two in turn too small to change a sum: the rest are smaller
    last = term;
    A += slope;
    B += r * power[n];
    L += r * power[n + 1];
    R += r * power[n + 2];
    Q += r * power[n + 3];
    const long double next = -2 * a * r - square * before;
    before = r;
    r = next;
  }
  return {A + 2 * a * B, B, L, R, Q};
}

}  // namespace

TaylorPowers::TaylorPowers(long double time) : s(time) {
  power_[0] = 1;
  for (std::size_t k = 1; k < power_.size(); ++k) power_[k] = power_[k - 1] * s / static_cast<long double>(k);
}

StepCoefficients step_coefficients(long double square, long double a, const TaylorPowers& powers) {
  const long double s = powers.s, w = std::sqrt(square);
  if ((w + 2 * a) * s <= 1) return by_series(square, a, powers);
  if (square == 0) {  // drag alone
    const long double B = -std::expm1(-2 * a * s) / (2 * a), L = (s - B) / (2 * a), R = (s * s / 2 - L) / (2 * a);
    return {1, B, L, R, (s * s * s / 6 - R) / (2 * a)};
  }
  StepCoefficients c{};
  if (square > a * a) {
    const long double wd = std::sqrt(square - a * a), fade = std::exp(-a * s), x = wd * s;
    c.B = fade * (x < 1e-4L ? s * (1 - x * x / 6) : std::sin(x) / wd);
    c.A = fade * std::cos(x) + a * c.B;
  } else {
    const long double p = std::sqrt(a * a - square), x = p * s;
    if (x < 1) {
      const long double fade = std::exp(-a * s);
      c.B = fade * (x < 1e-4L ? s * (1 + x * x / 6) : std::sinh(x) / p);
      c.A = fade * std::cosh(x) + a * c.B;
    } else {
      const long double slow = std::exp(-square / (a + p) * s), fast = std::exp(-(a + p) * s);
      c.B = (slow - fast) / (2 * p);
      c.A = (slow + fast) / 2 + a * c.B;
    }
  }
  c.L = (1 - c.A) / square;
  c.R = (s - c.B - 2 * a * c.L) / square;
  c.Q = (s * s / 2 - c.L - 2 * a * c.R) / square;
  return c;
}

void Propagator::move(const ModalState& from, double s, ModalState& after) {
  move_oscillators(from, s, after);
  coupled_.at(s, after, false);
}

void Propagator::move_oscillators(const ModalState& from, double s, ModalState& after) const {
  const ExactModes& m = modes_;
  after.x.resize(m.padded);
  after.y.resize(m.padded);
  propagate_oscillators(m.padded, s, m.square.data(), m.decay.data(), m.damped.data(), from.x.data(), from.y.data(), from.f0.data(),
                        from.f1.data(), after.x.data(), after.y.data());
  for (const int k : m.special) {
    const long double w2 = m.square[k], a = m.decay[k];
    const StepCoefficients c = step_coefficients(w2, a, s);
    const long double x = from.x[k], y = from.y[k], p = from.f0[k], q = from.f1[k];
    after.x[k] = static_cast<double>(c.A * x + c.B * y + c.L * p + c.R * q);
    after.y[k] = static_cast<double>(-w2 * c.B * x + (c.A - 2 * a * c.B) * y + c.B * p + c.L * q);
  }
  after.f0 = from.f0 + s * from.f1;
  after.f1 = from.f1;
}

const Propagator::Step& Propagator::find(double s) {
  for (const Step& step : steps_) {
    if (step.length == s) return step;
  }
  if (steps_.size() < most_steps) steps_.emplace_back();
  Step& step = steps_[next_ % most_steps];
  next_ = (next_ + 1) % most_steps;
  step.length = s;
  for (VectorX& array : step.arrays) array = VectorX::Zero(modes_.padded);
  const auto split = [&step](std::size_t high, int k, long double value) {
    step.arrays[high][k] = static_cast<double>(value);
    step.arrays[high + 4][k] = static_cast<double>(value - static_cast<long double>(step.arrays[high][k]));
  };
  const TaylorPowers powers(s);
  for (int k = 0; k < modes_.padded; ++k) {
    const long double w2 = modes_.square[k], a = modes_.decay[k];
    const StepCoefficients c = step_coefficients(w2, a, powers);
    split(0, k, c.A);
    split(1, k, c.B);
    split(2, k, -w2 * c.B);
    split(3, k, c.A - 2 * a * c.B);
    step.arrays[8][k] = static_cast<double>(c.L);
    step.arrays[9][k] = static_cast<double>(c.R);
    step.arrays[10][k] = static_cast<double>(c.B);
    step.arrays[11][k] = static_cast<double>(c.L);
  }
  return step;
}

namespace {

StepArrays pointers(const std::array<VectorX, 12>& c) {
  return {c[0].data(), c[1].data(), c[2].data(), c[3].data(), c[4].data(),  c[5].data(),
          c[6].data(), c[7].data(), c[8].data(), c[9].data(), c[10].data(), c[11].data()};
}

}  // namespace

FlightArrays Propagator::arrays_of(const ModalState& from) const {
  const ExactModes& m = modes_;
  return {m.square.data(), m.decay.data(), m.flexibility.data(), from.x.data(), from.y.data(), from.f0.data(), from.f1.data(), nullptr, nullptr};
}

FlightSums Propagator::step_and_sum(const ModalState& from, double s, ModalState& after) {
  after.x.resize(modes_.padded);
  after.y.resize(modes_.padded);
  const FlightSums sums =
      nsframe::step_and_sum(modes_.padded, s, pointers(find(s).arrays), arrays_of(from), raised_.data(), after.x.data(), after.y.data());
  after.f0 = from.f0 + s * from.f1;
  after.f1 = from.f1;
  return sums;
}

void Propagator::step(const ModalState& from, double s, ModalState& after) {
  after.x.resize(modes_.padded);
  after.y.resize(modes_.padded);
  apply_step(modes_.padded, pointers(find(s).arrays), from.x.data(), from.y.data(), from.f0.data(), from.f1.data(), after.x.data(), after.y.data());
  coupled_.at(s, after, true);
  after.f0 = from.f0 + s * from.f1;
  after.f1 = from.f1;
}

VectorX Propagator::accelerations(const ModalState& state) const {
  VectorX modal = state.f0 - 2 * modes_.decay.cwiseProduct(state.y) - modes_.square.cwiseProduct(state.x);
  coupled_.accelerations(state, modal);
  return modal;
}

void Propagator::derivatives(const ModalState& state, Eigen::Matrix<double, Eigen::Dynamic, 7>& out) const {
  out.resize(modes_.padded, 7);
  out.col(0) = state.x;
  out.col(1) = state.y;
  for (int n = 2; n < 7; ++n) {
    out.col(n) = -2 * modes_.decay.cwiseProduct(out.col(n - 1)) - modes_.square.cwiseProduct(out.col(n - 2));
    if (n == 2) out.col(n) += state.f0;
    if (n == 3) out.col(n) += state.f1;
  }
  coupled_.derivatives(state, out);
}

ModalSize Propagator::size(const ModalState& state) const {
  return modal_size(modes_.padded, arrays_of(state), raised_.data());
}

void Propagator::bound_fourth(const ModalState& state, VectorX& pairs) {
  VectorX& bound = mode_bound_;
  // u = x - x_p decays: |u| <= amplitude, and four derivatives multiply the amplitude by w^4
  const auto w2 = modes_.square.array(), a = modes_.decay.array();
  const auto flexibility = modes_.flexibility.array();
  const Eigen::ArrayXd slope = state.f1.array() * flexibility;
  const Eigen::ArrayXd u = state.x.array() - (state.f0.array() - 2 * a * slope) * flexibility;
  const Eigen::ArrayXd v = state.y.array() - slope;
  bound = w2.square() * (u.square() + ((v + a * u) / modes_.damped.array()).square()).sqrt();
  for (const int k : modes_.special) {
    const double square = modes_.square[k], w = std::sqrt(square), two_a = 2 * modes_.decay[k];
    // sqrt(2 E) with E = 1/2 u'^2 + 1/2 w^2 u^2, which never grows, bounds |u'| and w |u|
    double most = 0;
    if (square > 0) {
      const double p = state.f1[k] / square;
      most = std::hypot(state.y[k] - p, w * (state.x[k] - (state.f0[k] - two_a * p) / square));
    } else if (two_a > 0) {
      const double p = state.f1[k] / two_a;
      most = std::abs(state.y[k] - (state.f0[k] - p) / two_a);
    }
    const double second = two_a + w, third = two_a * second + square;
    bound[k] = (two_a * third + square * second) * most;
  }
  for (const DampingCoupling& coupling : modes_.couplings) {
    for (const int k : coupling.places) bound[k] = 0;
  }
  pairs.noalias() = modes_.gap_size * bound;
  coupled_.add_fourth(pairs);
}

FlightEnergy Propagator::energy(const VectorX& f0, const VectorX& f1, const ModalState& from, const ModalState& to, double s) {
  const ExactModes& m = modes_;
  FlightArrays arrays = arrays_of(from);
  arrays.x_after = to.x.data();
  arrays.y_after = to.y.data();
  FlightEnergy energy = sum_energy(m.padded, s, arrays, f0.data(), f1.data());
  for (const int k : m.special) {  // without flexibility: int x dt by the response's own integrals; A = B' + 2 a B
    if (f1[k] == 0) continue;
    const StepCoefficients c = step_coefficients(m.square[k], m.decay[k], s);
    energy.work -= f1[k] * static_cast<double>((c.B + 2 * m.decay[k] * c.L) * from.x[k] + c.L * from.y[k] + c.R * from.f0[k] + c.Q * from.f1[k]);
  }
  if (!coupled_.empty() && !f1.isZero(0)) {
    integral_.resize(m.padded);
    coupled_.integrate(s, integral_);
    for (const DampingCoupling& coupling : m.couplings) {
      for (Eigen::Index i = 0; i < coupling.square.size(); ++i) {
        const int k = coupling.places[static_cast<std::size_t>(i)];
        energy.work -= f1[k] * integral_[k];
      }
    }
  }
  return energy;
}

}  // namespace nsframe
