#include "output/beam_shapes.hpp"

#include "base/rotation.hpp"

namespace nsframe {

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
