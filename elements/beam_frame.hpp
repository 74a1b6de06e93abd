// Kinematics shared by all two-node members: local axes, the basic system without rigid-body motion, and P-Delta.
// Basic deformations (OpenSees' order): v = [elongation, rz_i, rz_j, ry_i, ry_j, twist], rotations from the chord.
#pragma once

#include <optional>

#include "base/types.hpp"

namespace nsframe {

using Matrix6x12 = Eigen::Matrix<double, 6, 12>;

// Rows: local x, y, z in global axes. `orientation` is a vector in the local x-z plane (OpenSees' vecxz). Without it,
// a vertical member has y along global X, any other has y upwards.
// Throws std::invalid_argument when the ends coincide or `orientation` is parallel to the member.
Matrix3 beam_axes(const Vector3& end_i, const Vector3& end_j, const std::optional<Vector3>& orientation);

struct BeamFrame {
  double length = 0;            // [m]
  Matrix3 axes = Matrix3::Zero();
  Matrix6x12 compatibility = Matrix6x12::Zero();        // v = compatibility * u, u in global axes
  Eigen::Matrix<double, 2, 12> chord_shift = Eigen::Matrix<double, 2, 12>::Zero();  // relative local y, z translation of j

  BeamFrame(const Vector3& end_i, const Vector3& end_j, const Matrix3& axes);
};

// Internal force and tangent in global axes from basic forces q(v) and their tangent dq/dv. With `p_delta` the axial
// force acts on the chord's shift, N/L * shift at the ends, as in OpenSees' PDelta transformation; its tangent is
// exact and not symmetric, because that theory has no work-conjugate elongation.
void to_global(const BeamFrame& frame, bool p_delta, const Vector12& displacement, const Vector6& basic_force,
               const Matrix6& basic_tangent, Vector12& force, Matrix12* tangent);

}  // namespace nsframe
