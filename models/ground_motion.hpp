// Acceleration of the base, or of some supports, in one direction: piecewise linear between equally spaced samples, zero before
// the first and after the last.
#pragma once

#include <string>
#include <vector>

#include "base/types.hpp"

namespace nsframe {

struct GroundMotion {
  std::string source;
  Vector3 direction = Vector3::UnitX();
  double dt = 0;                         // [s]
  std::vector<double> acceleration;      // [m/s2]
  std::vector<double> velocity;          // its exact integral at the samples [m/s], from prepare()

  double start = 0;                      // of the first sample [s]
  bool of_supports = false;              // relative to the base; else of the base
  std::vector<double> displacement;      // the exact integral of the velocity [m], from prepare()

  void prepare();                                   // fills `velocity` and `displacement`
  double duration() const;                          // to the last sample [s]
  double acceleration_at(double time) const;        // [m/s2]
  double velocity_at(double time) const;            // exact integral of the acceleration from 0 [m/s]
  double displacement_at(double time) const;        // and of that [m]
  // The sample before `time`, the time since [s] and the slope [m/s3]; of motions that have begun and not ended.
  struct Piece {
    std::size_t sample;
    double since, slope;
  };
  Piece piece_at(double time) const;
};

}  // namespace nsframe
