#include "spectra/oscillators.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "base/types.hpp"

namespace nsframe {
namespace {

using Matrix2 = Eigen::Matrix2d;

// w h of a piece up to which a cubic through both ends finds a peak between them: its error is (w h)^4 / 384 of it.
constexpr double longest_piece = 0.5;

// With x = (u, u') and x' = A x + B a:  x+ = E0 x + (E1 - E2) B a0 + E2 B a1  (theory.md, 121)
struct Exponentials {
  Matrix2 E0;  // exp(A h)
  Matrix2 E1;  // integral of exp(A s) over [0, h]
  Matrix2 E2;  // integral of exp(A (h - s)) s / h
};

// Power series, without cancellation where w h is small.
Exponentials by_series(const Matrix2& A, double h) {
  Exponentials e{Matrix2::Identity(), Matrix2::Identity(), 0.5 * Matrix2::Identity()};
  Matrix2 power = Matrix2::Identity();  // (A h)^k / k!
  for (int k = 1; k <= 24; ++k) {
    power = (power * A * (h / k)).eval();
    e.E0 += power;
    e.E1 += power / (k + 1);
    e.E2 += power / ((k + 1) * (k + 2));
  }
  e.E1 *= h;
  e.E2 *= h;
  return e;
}

Exponentials closed_form(const Matrix2& A, double w, double xi, double h) {
  const double root = std::sqrt(1 - xi * xi), wd = w * root, decay = std::exp(-xi * w * h);
  const double c = decay * std::cos(wd * h), s = decay * std::sin(wd * h);
  Exponentials e;
  e.E0 << c + xi / root * s, s / wd, -w / root * s, c - xi / root * s;
  const Matrix2 inverse = A.inverse();
  e.E1 = inverse * (e.E0 - Matrix2::Identity());
  e.E2 = inverse * (e.E1 / h - Matrix2::Identity());
  return e;
}

}  // namespace

double turning_point(double u0, double d0, double u1, double d1) {
  const double cubic = d0 + d1 - 2 * (u1 - u0), square = 3 * (u1 - u0) - 2 * d0 - d1;
  // p' = d0 + 2 square s + 3 cubic s^2 has one root between
  const double q = -(square + std::copysign(std::sqrt(std::max(square * square - 3 * cubic * d0, 0.0)), square));
  const double first = q / (3 * cubic), second = d0 / q;
  const double s = second >= 0 && second <= 1 ? second : first;
  if (!(s >= 0 && s <= 1)) return std::max(std::abs(u0), std::abs(u1));
  return std::abs(u0 + s * (d0 + s * (square + s * cubic)));
}

std::vector<double> logarithmic_periods(double shortest, double longest, int count) {
  std::vector<double> periods;
  for (int i = 0; i < count; ++i) periods.push_back(shortest * std::pow(longest / shortest, i / (count - 1.0)));
  periods.back() = longest;
  return periods;
}

OscillatorStep::OscillatorStep(const std::vector<double>& periods, double damping_ratio, double step) {
  if (!(damping_ratio >= 0 && damping_ratio < 1)) throw std::invalid_argument("the damping ratio of oscillators must lie in [0, 1)");
  if (!(step > 0)) throw std::invalid_argument("the step of oscillators must be positive");
  double shortest = std::numeric_limits<double>::infinity();
  for (const double period : periods) {
    if (!(period > 0)) throw std::invalid_argument("the periods of oscillators must be positive");
    shortest = std::min(shortest, period);
  }
  pieces_ = std::max(1, static_cast<int>(std::ceil(2 * pi / shortest * step / longest_piece)));
  h_ = step / pieces_;
  for (const double period : periods) {
    const double w = 2 * pi / period;
    Matrix2 A;
    A << 0, 1, -w * w, -2 * damping_ratio * w;
    const Exponentials e = w * h_ < 1 ? by_series(A, h_) : closed_form(A, w, damping_ratio, h_);
    uu_.push_back(e.E0(0, 0));
    uv_.push_back(e.E0(0, 1));
    vu_.push_back(e.E0(1, 0));
    vv_.push_back(e.E0(1, 1));
    ua_.push_back(e.E2(0, 1) - e.E1(0, 1));
    va_.push_back(e.E2(1, 1) - e.E1(1, 1));
    ub_.push_back(-e.E2(0, 1));
    vb_.push_back(-e.E2(1, 1));
  }
}

void Oscillators::advance(const OscillatorStep& step, double a0, double a1) {
  for (int i = 0; i < step.pieces_; ++i) {
    const double from = double(i) / step.pieces_, to = double(i + 1) / step.pieces_;
    advance_piece(step, a0 + from * (a1 - a0), a0 + to * (a1 - a0));
  }
}

void Oscillators::advance_piece(const OscillatorStep& step, double a0, double a1) {
  const std::size_t n = u_.size();
  before_u_.swap(u_);
  before_v_.swap(v_);
  for (std::size_t i = 0; i < n; ++i) {
    u_[i] = step.uu_[i] * before_u_[i] + step.uv_[i] * before_v_[i] + step.ua_[i] * a0 + step.ub_[i] * a1;
    v_[i] = step.vu_[i] * before_u_[i] + step.vv_[i] * before_v_[i] + step.va_[i] * a0 + step.vb_[i] * a1;
    peak_[i] = std::max(peak_[i], std::abs(u_[i]));
  }
  const double h = step.h_;
  for (std::size_t i = 0; i < n; ++i) {
    // a turning point between: nowhere further from both ends than the velocities reach
    if (before_v_[i] * v_[i] >= 0) continue;
    const double ends = std::max(std::abs(before_u_[i]), std::abs(u_[i]));
    if (ends + h * std::max(std::abs(before_v_[i]), std::abs(v_[i])) <= peak_[i]) continue;
    peak_[i] = std::max(peak_[i], turning_point(before_u_[i], h * before_v_[i], u_[i], h * v_[i]));
  }
}

void Oscillators::restore(std::vector<double> displacement, std::vector<double> velocity, std::vector<double> peak) {
  u_ = std::move(displacement);
  v_ = std::move(velocity);
  peak_ = std::move(peak);
}

std::vector<double> pseudo_velocity(const std::vector<double>& periods, const std::vector<double>& peak) {
  std::vector<double> values(peak);
  for (std::size_t i = 0; i < values.size(); ++i) values[i] *= 2 * pi / periods[i];
  return values;
}

std::vector<double> pseudo_acceleration(const std::vector<double>& periods, const std::vector<double>& peak) {
  std::vector<double> values = pseudo_velocity(periods, peak);
  for (std::size_t i = 0; i < values.size(); ++i) values[i] *= 2 * pi / periods[i];
  return values;
}

}  // namespace nsframe
