// [gravity] of a scene, and directions as scenes write them.
#pragma once

#include "base/types.hpp"

namespace nsframe {

// A unit vector: "x", "-y" or three numbers of any length.
struct Direction {
  Vector3 vector = Vector3::UnitX();
};

struct GravityTable {
  double acceleration = 9.81;  // [m/s2]
  Direction direction{-Vector3::UnitZ()};
  bool statically_first = true;
};

}  // namespace nsframe
