#include "elements/beam_frame.hpp"

#include <stdexcept>

#include "base/rotation.hpp"

namespace nsframe {

Matrix3 beam_axes(const Vector3& end_i, const Vector3& end_j, const std::optional<Vector3>& orientation) {
  const Vector3 chord = end_j - end_i;
  const double length = chord.norm();
  if (!(length > 1e-9 * (1 + end_i.norm()))) throw std::invalid_argument("zero length");
  const Vector3 x = chord / length;
  Vector3 in_plane;
  if (orientation) {
    in_plane = *orientation;
  } else {
    const bool vertical = std::abs(x.z()) > 1 - 1e-6;
    in_plane = vertical ? Vector3::UnitY() : Vector3(x.cross(Vector3::UnitZ()));
  }
  Vector3 y = in_plane.cross(x);
  if (!(y.norm() > 1e-6 * in_plane.norm())) throw std::invalid_argument("orientation vector parallel to the member");
  y.normalize();
  Matrix3 axes;
  axes.row(0) = x;
  axes.row(1) = y;
  axes.row(2) = x.cross(y);
  return axes;
}

BeamFrame::BeamFrame(const Vector3& end_i, const Vector3& end_j, const Matrix3& local_axes,
                     const std::array<Vector3, 2>& arms)
    : length((end_j - end_i).norm()), axes(local_axes), offset(arms) {
  const auto x = axes.row(0), y = axes.row(1), z = axes.row(2);
  chord_shift.block<1, 3>(0, 0) = -y;
  chord_shift.block<1, 3>(0, 6) = y;
  chord_shift.block<1, 3>(1, 0) = -z;
  chord_shift.block<1, 3>(1, 6) = z;
  compatibility.block<1, 3>(0, 0) = -x;
  compatibility.block<1, 3>(0, 6) = x;
  for (const int end : {0, 1}) {
    compatibility.row(1 + end) = -chord_shift.row(0) / length;  // rz minus the chord's rotation dy/L
    compatibility.row(3 + end) = chord_shift.row(1) / length;   // ry minus the chord's rotation -dz/L
    compatibility.block<1, 3>(1 + end, 3 + 6 * end) += z;
    compatibility.block<1, 3>(3 + end, 3 + 6 * end) += y;
  }
  compatibility.block<1, 3>(5, 3) = -x;
  compatibility.block<1, 3>(5, 9) = x;
  for (const int end : {0, 1}) {  // an end moves with u + r x arm
    const Matrix3 by_rotation = -skew(offset[static_cast<std::size_t>(end)]);
    compatibility.middleCols<3>(3 + 6 * end) += compatibility.middleCols<3>(6 * end) * by_rotation;
    chord_shift.middleCols<3>(3 + 6 * end) += chord_shift.middleCols<3>(6 * end) * by_rotation;
  }
}

}  // namespace nsframe
