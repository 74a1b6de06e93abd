#include "output/beam_shapes.hpp"

#include "base/rotation.hpp"

namespace nsframe {

Eigen::Matrix<double, 6, 12> beam_shape_functions(double along, double length) {
  const double s = along, L = length;
  const double deflection[4] = {1 - 3 * s * s + 2 * s * s * s, L * s * (1 - s) * (1 - s), s * s * (3 - 2 * s),
                                L * s * s * (s - 1)};
  const double slope[4] = {6 * s * (s - 1) / L, (1 - s) * (1 - 3 * s), 6 * s * (1 - s) / L, s * (3 * s - 2)};
  Eigen::Matrix<double, 6, 12> local = Eigen::Matrix<double, 6, 12>::Zero();
  for (Eigen::Index end = 0; end < 2; ++end) {
    const Eigen::Index first = 6 * end;
    const double share = end == 0 ? 1 - s : s;
    local(0, first) = share;                    // ux
    local(1, first + 1) = deflection[2 * end];  // uy from uy, rz
    local(1, first + 5) = deflection[2 * end + 1];
    local(2, first + 2) = deflection[2 * end];  // uz from uz, ry (uz' = -ry)
    local(2, first + 4) = -deflection[2 * end + 1];
    local(3, first + 3) = share;            // rx
    local(4, first + 2) = -slope[2 * end];  // ry = -uz'
    local(4, first + 4) = slope[2 * end + 1];
    local(5, first + 1) = slope[2 * end];  // rz = uy'
    local(5, first + 5) = slope[2 * end + 1];
  }
  return local;
}

SectionPlace finite_place(const ElementShape& shape, const ElementPose& pose, const Vector12& rate, double along) {
  Vector12 from_chord = Vector12::Zero(), end_rate;
  for (const int end : {0, 1}) {
    const auto k = static_cast<std::size_t>(end);
    from_chord.segment<3>(6 * end + 3) = pose.rotation[k];
    const Vector3 spin = rate.segment<3>(6 * end + 3);
    end_rate.segment<3>(6 * end) = pose.axes * (rate.segment<3>(6 * end) + spin.cross(pose.arm[k]));
    end_rate.segment<3>(6 * end + 3) = pose.axes * spin;
  }
  const Eigen::Matrix<double, 6, 12> functions = beam_shape_functions(along, pose.length);
  const Vector6 local = functions * from_chord, local_rate = functions * end_rate;
  const Vector3 centre = local.head<3>() + along * pose.length * Vector3::UnitX();
  SectionPlace place;
  place.displacement = pose.end[0] + pose.axes.transpose() * centre - along * shape.length * shape.axes.row(0).transpose();
  place.turn = pose.axes.transpose() * rotation_exponential(local.tail<3>()).toRotationMatrix() * shape.axes;
  place.spin = pose.axes.transpose() * local_rate.tail<3>();
  // the functions give the velocity on the chord; the section stands beside it
  const Vector3 beside = pose.axes.transpose() * local.head<3>();
  place.velocity = pose.axes.transpose() * local_rate.head<3>() + place.spin.cross(beside);
  return place;
}

}  // namespace nsframe
