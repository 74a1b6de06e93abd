// Small-displacement kinematics of two-node members: local axes, and the basic system without rigid-body motion.
// Basic deformations (OpenSees' order): v = [elongation, rz_i, rz_j, ry_i, ry_j, twist], rotations from the chord.
#pragma once

#include <array>
#include <optional>

#include "base/types.hpp"

namespace nsframe {

using Matrix6x12 = Eigen::Matrix<double, 6, 12>;

// Rows: local x, y, z in global axes. `orientation` is a vector in the local x-z plane (OpenSees' vecxz). Without it,
// a vertical member has y along global X, any other has y upwards.
// Throws std::invalid_argument when the ends coincide or `orientation` is parallel to the member.
Matrix3 beam_axes(const Vector3& end_i, const Vector3& end_j, const std::optional<Vector3>& orientation);

struct BeamFrame {
  double length = 0;            // between the member's ends [m]
  Matrix3 axes = Matrix3::Zero();
  std::array<Vector3, 2> offset{Vector3::Zero(), Vector3::Zero()};  // rigid arms from the nodes to the ends, global axes [m]
  Matrix6x12 compatibility = Matrix6x12::Zero();        // v = compatibility * u, u of the nodes in global axes
  Eigen::Matrix<double, 2, 12> chord_shift = Eigen::Matrix<double, 2, 12>::Zero();  // relative local y, z translation of j

  // `end_i`, `end_j`: of the member, at the far side of the arms.
  BeamFrame(const Vector3& end_i, const Vector3& end_j, const Matrix3& axes,
            const std::array<Vector3, 2>& offset = {Vector3::Zero(), Vector3::Zero()});

  bool has_offsets() const { return !offset[0].isZero(0) || !offset[1].isZero(0); }
};

}  // namespace nsframe
