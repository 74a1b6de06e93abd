#include "motion/history.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "motion/units.hpp"

namespace nsframe {

namespace {

// Time at which the sum of the pieces reaches `share` of the whole; within a piece by its cubic.
double time_of_share(std::span<const double> a, double dt, double whole, double share) {
  double sum = 0;
  for (std::size_t i = 0; i + 1 < a.size(); ++i) {
    const double start = a[i], change = a[i + 1] - a[i];
    const auto part = [&](double s) {
      return dt * s * (start * start + s * (start * change + s * change * change / 3));
    };
    if (sum + part(1) < share * whole) {
      sum += part(1);
      continue;
    }
    double low = 0, high = 1;  // part() rises
    for (int k = 0; k < 50; ++k) {
      const double middle = 0.5 * (low + high);
      (sum + part(middle) < share * whole ? low : high) = middle;
    }
    return dt * (static_cast<double>(i) + high);
  }
  return a.empty() ? 0 : dt * static_cast<double>(a.size() - 1);
}

}  // namespace

GroundHistory integrate(std::span<const double> a, double dt) {
  GroundHistory out{std::vector<double>(a.size()), std::vector<double>(a.size())};
  for (std::size_t i = 1; i < a.size(); ++i) {
    out.velocity[i] = out.velocity[i - 1] + 0.5 * dt * (a[i - 1] + a[i]);
    out.displacement[i] = out.displacement[i - 1] + dt * out.velocity[i - 1] + dt * dt * (2 * a[i - 1] + a[i]) / 6;
  }
  return out;
}

MotionPeak peak_of(std::span<const double> values, double dt) {
  MotionPeak out;
  for (std::size_t i = 0; i < values.size(); ++i)
    if (std::abs(values[i]) > out.value) out = {std::abs(values[i]), dt * static_cast<double>(i)};
  return out;
}

MotionMeasures measure(std::span<const double> a, double dt) {
  MotionMeasures out;
  const GroundHistory history = integrate(a, dt);
  out.acceleration = peak_of(a, dt);
  out.velocity = peak_of(history.velocity, dt);
  out.displacement = peak_of(history.displacement, dt);
  if (!a.empty()) {
    out.final_velocity = history.velocity.back();
    out.final_displacement = history.displacement.back();
  }
  double squares = 0;
  for (std::size_t i = 0; i + 1 < a.size(); ++i)
    squares += dt * (a[i] * a[i] + a[i] * a[i + 1] + a[i + 1] * a[i + 1]) / 3;
  out.arias = std::numbers::pi / (2 * in_si(AccelerationUnit::g)) * squares;
  out.from_5 = time_of_share(a, dt, squares, 0.05);
  out.to_75 = time_of_share(a, dt, squares, 0.75);
  out.to_95 = time_of_share(a, dt, squares, 0.95);
  return out;
}

}  // namespace nsframe
