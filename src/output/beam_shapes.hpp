// Where the cross-sections of a beam are between its ends, for drawing.
#pragma once

#include "elements/beam_shape_functions.hpp"
#include "elements/element_group.hpp"

namespace nsframe {

// A cross-section of a beam that turns by any amount.
struct SectionPlace {
  Vector3 displacement;  // of its centre [m]
  Matrix3 turn;          // its rotation from the start
  Vector3 velocity, spin;
};
// `rate`: velocities of the nodes, spins in global axes.
SectionPlace finite_place(const ElementShape& shape, const ElementPose& pose, const Vector12& rate, double along);

}  // namespace nsframe
