// Closed-form solutions that runs are compared with; none of the program's own code is used here.
#pragma once

#include <array>
#include <cmath>
#include <vector>

namespace nsframe::test {

// Free motion of a damped oscillator from (x, v) after time s.
struct FreeOscillator {
  double w, xi;
  std::array<double, 2> at(double x, double v, double s) const {
    const double a = xi * w, wd = w * std::sqrt(1 - xi * xi), e = std::exp(-a * s);
    const double c = std::cos(wd * s), sn = std::sin(wd * s);
    return {e * (x * c + (v + a * x) / wd * sn), e * (v * c - (w * w * x + a * v) / wd * sn)};
  }
};

// Height of the bouncing ball: dropped from 1 m under 2 m/s2, e = 0.5; impacts at 1, 2, 2.5, ... s, at rest from 3 s.
inline double bouncing_ball_height(double t) {
  double start = 1, speed = 1, flight = 1;  // the first impact is at 1 s; the ball leaves with 1 m/s
  if (t < start) return 1 - t * t;
  while (t < 3 && t >= start + flight) {
    start += flight;
    speed *= 0.5;
    flight *= 0.5;
    if (speed < 1e-12) return 0;
  }
  return t >= 3 ? 0 : speed * (t - start) - (t - start) * (t - start);
}

struct ExactImpact {
  double time, rate;
  std::array<double, 2> x, v;  // both masses just after
};

// Two undriven oscillators with masses m, stiffness k, damping ratio xi; gap g0; the first released from x0 at rest.
// Every impact up to `end`: scanned at 1e-5 s, located by bisection to rounding.
inline std::vector<ExactImpact> two_oscillator_impacts(std::array<double, 2> m, std::array<double, 2> k, double xi, double g0,
                                                       double x0, double e, double end) {
  const std::array<FreeOscillator, 2> o{FreeOscillator{std::sqrt(k[0] / m[0]), xi}, FreeOscillator{std::sqrt(k[1] / m[1]), xi}};
  std::vector<ExactImpact> impacts;
  double t0 = 0;
  std::array<double, 2> x{x0, 0}, v{0, 0};
  const auto gap = [&](double s) { return g0 + o[1].at(x[1], v[1], s)[0] - o[0].at(x[0], v[0], s)[0]; };
  const double scan = 1e-5;
  for (double s = scan; t0 + s < end; s += scan) {
    if (gap(s) > 0) continue;
    double low = s - scan, high = s;
    for (int i = 0; i < 200 && high - low > 1e-17; ++i) {
      const double middle = 0.5 * (low + high);
      (gap(middle) > 0 ? low : high) = middle;
    }
    const auto a = o[0].at(x[0], v[0], high), b = o[1].at(x[1], v[1], high);
    const double rate = b[1] - a[1], p = -(1 + e) * rate / (1 / m[0] + 1 / m[1]);
    x = {a[0], b[0]};
    v = {a[1] - p / m[0], b[1] + p / m[1]};
    t0 += high;
    s = 0;
    impacts.push_back({t0, rate, x, v});
  }
  return impacts;
}

inline const std::vector<ExactImpact>& pull_back_impacts() {
  static const auto impacts = two_oscillator_impacts({4600, 3500}, {2.11e6, 5.31e6}, 0.005, 0.02, -0.024, 0.6, 2.0);
  return impacts;
}

inline std::array<double, 2> pull_back_exact(double t) {
  const std::array<FreeOscillator, 2> o{FreeOscillator{std::sqrt(2.11e6 / 4600), 0.005}, FreeOscillator{std::sqrt(5.31e6 / 3500), 0.005}};
  double t0 = 0;
  std::array<double, 2> x{-0.024, 0}, v{0, 0};
  for (const ExactImpact& impact : pull_back_impacts()) {
    if (impact.time > t) break;
    t0 = impact.time;
    x = impact.x;
    v = impact.v;
  }
  return {o[0].at(x[0], v[0], t - t0)[0], o[1].at(x[1], v[1], t - t0)[0]};
}

}  // namespace nsframe::test
