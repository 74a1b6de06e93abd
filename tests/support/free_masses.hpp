// Reference motions of two masses under a contact force, by Dormand and Prince's formulas (1980) with their own control of the
// step; nothing of the program is used. A contact begins and ends at located times, so that no step spans a jump.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <vector>

namespace nsframe::test {

// y' = f(y), n unknowns: one step with its error estimate relative to `scale`.
template <std::size_t n>
class DormandPrince {
 public:
  using Vector = std::array<double, n>;
  using Slope = std::function<Vector(const Vector&)>;
  explicit DormandPrince(Slope slope) : slope_(std::move(slope)) {}

  // y after h, and the largest error over `scale`.
  std::pair<Vector, double> step(const Vector& y, double h, const Vector& scale) const {
    static constexpr double a[7][6] = {{},
                                       {1.0 / 5},
                                       {3.0 / 40, 9.0 / 40},
                                       {44.0 / 45, -56.0 / 15, 32.0 / 9},
                                       {19372.0 / 6561, -25360.0 / 2187, 64448.0 / 6561, -212.0 / 729},
                                       {9017.0 / 3168, -355.0 / 33, 46732.0 / 5247, 49.0 / 176, -5103.0 / 18656},
                                       {35.0 / 384, 0, 500.0 / 1113, 125.0 / 192, -2187.0 / 6784, 11.0 / 84}};
    static constexpr double difference[7] = {71.0 / 57600, 0, -71.0 / 16695, 71.0 / 1920, -17253.0 / 339200, 22.0 / 525, -1.0 / 40};
    std::array<Vector, 7> k;
    Vector at = y;
    for (int s = 0; s < 7; ++s) {
      at = y;
      for (int j = 0; j < s; ++j)
        for (std::size_t i = 0; i < n; ++i) at[i] += h * a[s][j] * k[static_cast<std::size_t>(j)][i];
      k[static_cast<std::size_t>(s)] = slope_(at);
    }
    double error = 0;
    for (std::size_t i = 0; i < n; ++i) {
      double e = 0;
      for (std::size_t s = 0; s < 7; ++s) e += h * difference[s] * k[s][i];
      error = std::max(error, std::abs(e) / scale[i]);
    }
    return {at, error};  // the seventh stage is at the solution
  }

 private:
  Slope slope_;
};

struct FreeCollision {
  double restitution = 0, duration = 0, penetration = 0;
};

// Two free masses of reduced mass m that meet with `speed`, until their penetration is zero again (or falls below 1e-12 of its
// largest); force(d, d').
inline FreeCollision collide_free_masses(double m, double speed, const std::function<double(double, double)>& force) {
  // in units of the first second's way the singular start of d^0.25 is passed in tiny steps
  const DormandPrince<2> formula([&](const std::array<double, 2>& y) { return std::array{y[1], -force(std::max(y[0], 0.0), y[1]) / m}; });
  std::array<double, 2> y{0, speed};
  FreeCollision out;
  double h = 1e-12, largest = 1e-12 * speed;
  while (out.duration < 100) {
    const auto [next, error] = formula.step(y, h, {1e-11 * std::max(largest, 1e-9 * speed), 1e-11 * speed});
    if (error > 1) {
      h *= std::max(0.2, 0.9 * std::pow(error, -0.2));
      continue;
    }
    if (next[0] <= 1e-12 * largest && next[1] < 0) {  // the end: located by halving
      if (h < 1e-13 * out.duration) break;
      h *= 0.5;
      continue;
    }
    y = next;
    out.duration += h;
    largest = std::max(largest, y[0]);
    h *= std::min(2.0, 0.9 * std::pow(std::max(error, 1e-6), -0.2));
  }
  out.penetration = largest;
  out.restitution = -y[1] / speed;
  return out;
}

// Two masses on damped springs, pushed by constant forces: x of the first towards the second; gap = open + x2 - x1. An infinite
// second mass is a wall.
struct PenaltyPair {
  std::array<double, 2> mass{1, 1}, stiffness{0, 0}, damping{0, 0}, load{0, 0};
  double open = 0;
  std::function<double(double d, double rate, double approach)> force;
  std::array<double, 4> start{0, 0, 0, 0};  // x1, x2, v1, v2
};

struct PenaltyMotion {
  std::vector<std::array<double, 4>> samples;                     // at 0, dt, 2 dt, ...
  std::vector<std::array<double, 4>> contacts;                    // begin, end, rate before, rate after
  double penetration = 0;
};

// Samples every dt up to `end`; contact begins and ends located to 1e-14 s.
inline PenaltyMotion integrate(const PenaltyPair& pair, double dt, double end, double tolerance = 1e-12) {
  using Vector = std::array<double, 4>;
  bool touching = false;
  double approach = 0;
  const auto gap = [&](const Vector& y) { return pair.open + y[1] - y[0]; };
  const DormandPrince<4> formula([&](const Vector& y) {
    const double f = touching ? pair.force(std::max(-gap(y), 0.0), y[2] - y[3], approach) : 0;
    Vector slope{y[2], y[3], 0, 0};
    slope[2] = (pair.load[0] - pair.stiffness[0] * y[0] - pair.damping[0] * y[2] - f) / pair.mass[0];
    slope[3] = std::isinf(pair.mass[1]) ? 0 : (pair.load[1] - pair.stiffness[1] * y[1] - pair.damping[1] * y[3] + f) / pair.mass[1];
    return slope;
  });
  PenaltyMotion out;
  Vector y = pair.start;
  out.samples.push_back(y);
  double t = 0, h = 0.1 * dt;
  long sample = 1;
  while (static_cast<double>(sample) * dt < end + 0.5 * dt) {
    const double left = static_cast<double>(sample) * dt - t;
    const bool whole = h >= left;
    const double length = whole ? left : h;
    const auto [next, error] = formula.step(y, length, {tolerance, tolerance, 100 * tolerance, 100 * tolerance});
    if (error > 1 && length > 1e-13) {
      h = length * std::max(0.2, 0.9 * std::pow(error, -0.2));
      continue;
    }
    const bool crosses = touching ? gap(next) > 0 : gap(next) < 0;
    if (crosses && length > 1e-14) {
      h = 0.5 * length;
      continue;
    }
    y = next;
    t += length;
    out.penetration = std::max(out.penetration, -gap(y));
    if (crosses) {
      touching = !touching;
      if (touching) approach = y[2] - y[3];
      if (touching) {
        out.contacts.push_back({t, 0, y[3] - y[2], 0});
      } else {
        out.contacts.back()[1] = t;
        out.contacts.back()[3] = y[3] - y[2];
      }
      h = 1e-9;
      continue;
    }
    if (whole) {
      out.samples.push_back(y);
      ++sample;
      t = static_cast<double>(sample - 1) * dt;
    }
    h = std::max(h, length) * std::min(2.0, 0.9 * std::pow(std::max(error, 1e-6), -0.2));
  }
  return out;
}

}  // namespace nsframe::test
