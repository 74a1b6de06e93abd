#include "models/contact_point.hpp"

#include "base/rotation.hpp"
#include "elements/beam_shape_functions.hpp"

namespace nsframe {

ContactPoint node_point(int node, const Vector3& position, bool face) { return {position, {{node, Matrix6::Identity()}}, face}; }

ContactPoint edge_point(int first, int second, const Vector3& start, const Vector3& end, double along) {
  if (along == 0) return node_point(first, start, true);
  if (along == 1) return node_point(second, end, true);
  const double length = (end - start).norm();
  const Vector3 axis = (end - start) / length;
  ContactPoint point;
  point.position = start + along * (end - start);
  point.face = true;
  for (const int side : {-1, 1}) {
    const double weight = side < 0 ? 1 - along : along;
    Matrix6 share = Matrix6::Zero();
    share.topLeftCorner<3, 3>() = weight * Matrix3::Identity();
    share.bottomLeftCorner<3, 3>() = side / length * skew(axis);
    share.bottomRightCorner<3, 3>() = weight * axis * axis.transpose();
    point.shares.push_back({side < 0 ? first : second, share});
  }
  return point;
}

ContactPoint beam_point(const ElementNodes& nodes, const ElementShape& shape, const Vector3& first_node, double along) {
  const Eigen::Matrix<double, 6, 12> local = beam_shape_functions(along, shape.length);
  ContactPoint point;
  point.position = first_node + shape.offset[0] + along * shape.length * shape.axes.row(0).transpose();
  point.face = true;
  Eigen::Matrix<double, 6, 12> of_ends;  // in global axes
  for (int row = 0; row < 6; row += 3) {
    for (int column = 0; column < 12; column += 3) {
      of_ends.block<3, 3>(row, column) = shape.axes.transpose() * local.block<3, 3>(row, column) * shape.axes;
    }
  }
  const Eigen::Matrix<double, 6, 12> of_nodes = of_ends * shape.ends;
  for (const int end : {0, 1}) point.shares.push_back({nodes[static_cast<std::size_t>(end)], of_nodes.middleCols<6>(6 * end)});
  return point;
}

std::array<Vector3, 2> tangents(const Vector3& normal) {
  const Vector3 level = Vector3::UnitZ().cross(normal);
  const Vector3 first = level.norm() > 1e-6 ? Vector3(level.normalized()) : Vector3(normal.unitOrthogonal());
  return {first, normal.cross(first)};
}

void add_row(const ContactPoint& point, const Vector6& w, int row, std::vector<Eigen::Triplet<double>>& entries) {
  for (const PointShare& share : point.shares) {
    const Vector6 of_dofs = share.of_node.transpose() * w;
    for (int k = 0; k < 6; ++k) {
      if (of_dofs[k] != 0) entries.emplace_back(row, 6 * share.node + k, of_dofs[k]);
    }
  }
}

}  // namespace nsframe
