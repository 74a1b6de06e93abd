// Where the cross-sections of an elastic beam are between its ends.
#pragma once

#include "base/types.hpp"

namespace nsframe {

// Motion of the cross-section at `along` in [0, 1] by that of the ends, local axes, ux uy uz rx ry rz: linear along x and
// in torsion, cubic Hermite functions across, and the section stays normal to the curve.
Eigen::Matrix<double, 6, 12> beam_shape_functions(double along, double length);

}  // namespace nsframe
