// Base acceleration in one direction, piecewise linear between equally spaced samples, zero after the last.
#pragma once

#include <string>
#include <vector>

#include "base/types.hpp"

namespace nsframe {

struct GroundMotion {
  std::string source;
  Vector3 direction = Vector3::UnitX();
  double dt = 0;                         // [s]; the first sample is at t = 0
  std::vector<double> acceleration;      // [m/s2]
  std::vector<double> velocity;          // its exact integral at the samples [m/s], from prepare()

  void prepare();                                   // fills `velocity`
  double duration() const;                          // [s]
  double acceleration_at(double time) const;        // [m/s2]
  double velocity_at(double time) const;            // exact integral of the acceleration from 0 [m/s]
};

}  // namespace nsframe
