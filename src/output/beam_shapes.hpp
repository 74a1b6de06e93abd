// Where the cross-sections of a beam are between its ends, for drawing.
#pragma once

#include "elements/element_group.hpp"

namespace nsframe {

// Motion of the cross-section at `along` in [0, 1] by that of the ends, local axes, ux uy uz rx ry rz: linear along x and
// in torsion, cubic Hermite functions across, and the section stays normal to the curve.
Eigen::Matrix<double, 6, 12> beam_shape_functions(double along, double length);

// A cross-section of a beam that turns by any amount.
struct SectionPlace {
  Vector3 displacement;  // of its centre [m]
  Matrix3 turn;          // its rotation from the start
  Vector3 velocity, spin;
};
// `rate`: velocities of the nodes, spins in global axes.
SectionPlace finite_place(const ElementShape& shape, const ElementPose& pose, const Vector12& rate, double along);

}  // namespace nsframe
