#include "elements/torsion.hpp"

#include <algorithm>
#include <cmath>

#include "base/types.hpp"

namespace nsframe {

double rectangle_torsion(double a, double b) {
  const double length = std::max(a, b), t = std::min(a, b);
  double series = 0;
  for (int n = 1; n < 200; n += 2) series += std::tanh(n * pi * length / (2 * t)) / std::pow(n, 5);
  return length * t * t * t * (1.0 / 3 - 64 * t / (std::pow(pi, 5) * length) * series);
}

double tube_torsion(double depth, double width, double thickness, double mean_radius) {
  const double corners = mean_radius * mean_radius * (4 - pi);
  const double length = 2 * (depth + width - 2 * thickness) - 2 * mean_radius * (4 - pi);
  const double area = (depth - thickness) * (width - thickness) - corners;
  return thickness * thickness * thickness * length / 3 + 4 * area * area * thickness / length;
}

double angle_torsion(double depth, double width, double thickness, double root_radius) {
  const double t = thickness, r = root_radius;
  const auto leg = [t](double length) {
    return length * t * t * t / 3 * (1 - 0.315 * t / length * (1 - std::pow(t / length, 4) / 12));
  };
  const double diameter = 2 * (3 * r + 2 * t - std::sqrt(2.0) * (2 * r + t));
  return leg(depth) + leg(width - t) + (0.07 + 0.076 * r / t) * std::pow(diameter, 4);
}

}  // namespace nsframe
