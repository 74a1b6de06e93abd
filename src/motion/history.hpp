// Velocity and displacement of a record, and what is told of it in a line (theory.md, 312-313). Accelerations are
// linear between samples; integrals of them and of their squares are exact.
#pragma once

#include <span>
#include <vector>

namespace nsframe {

struct GroundHistory {
  std::vector<double> velocity, displacement;  // at the samples [m/s], [m]; at rest before
};
GroundHistory integrate(std::span<const double> acceleration, double dt);

struct MotionPeak {
  double value = 0, time = 0;  // largest absolute value, first time of it [s]
};
MotionPeak peak_of(std::span<const double> values, double dt);

struct MotionMeasures {
  MotionPeak acceleration, velocity, displacement;  // [m/s2], [m/s], [m]: PGA, PGV, PGD
  double final_velocity = 0, final_displacement = 0;
  double arias = 0;                         // pi / 2g times the integral of a^2 [m/s]
  double from_5 = 0, to_75 = 0, to_95 = 0;  // times at which 5, 75 and 95 % of it are reached [s]
  double significant_75() const { return to_75 - from_5; }
  double significant_95() const { return to_95 - from_5; }
};
MotionMeasures measure(std::span<const double> acceleration, double dt);

}  // namespace nsframe
