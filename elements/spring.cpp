#include "elements/spring.hpp"

namespace nsframe {

void Springs::add(const ElementNodes& nodes, std::string id, SpringProperties properties) {
  ElementGroup::add(nodes, std::move(id));
  int size = 0;
  for (const auto& law : properties.law) size += law ? history_size(*law) : 0;
  history_begin_.push_back(history_begin_.back() + size);
  Element element{std::move(properties), Eigen::Matrix<double, 6, 12>::Zero()};
  const Matrix3& axes = element.properties.axes;
  for (const int block : {0, 3}) {
    element.deformation.block<3, 3>(block, block) = -axes;
    element.deformation.block<3, 3>(block, block + 6) = axes;
  }
  // the shear springs join the ends of rigid arms: u_y + arm rz, u_z - arm ry
  const Vector2 arm_i = element.properties.length * element.properties.shear_distance;
  const Vector2 arm_j = arm_i - Vector2::Constant(element.properties.length);
  element.deformation.row(1).segment<3>(3) -= arm_i[0] * axes.row(2);
  element.deformation.row(1).segment<3>(9) += arm_j[0] * axes.row(2);
  element.deformation.row(2).segment<3>(3) += arm_i[1] * axes.row(1);
  element.deformation.row(2).segment<3>(9) -= arm_j[1] * axes.row(1);
  elements_.push_back(std::move(element));
}

void Springs::initialize_history(int element, double* history) const {
  for (const auto& law : elements_[static_cast<std::size_t>(element)].properties.law) {
    if (!law) continue;
    nsframe::initialize_history(*law, history);
    history += history_size(*law);
  }
}

void Springs::respond(int element, const Vector12& displacement, const double* committed, double* trial,
                      Vector12& force, Matrix12* tangent) const {
  const Element& e = elements_[static_cast<std::size_t>(element)];
  const Vector6 d = e.deformation * displacement;
  Vector6 s = e.properties.stiffness.cwiseProduct(d), k = e.properties.stiffness;
  for (int i = 0; i < 6; ++i) {
    const auto& law = e.properties.law[static_cast<std::size_t>(i)];
    if (!law) continue;
    const UniaxialPoint point = nsframe::respond(*law, d[i], committed, trial);
    s[i] = point.stress;
    k[i] = point.tangent;
    committed += history_size(*law);
    trial += history_size(*law);
  }
  force.noalias() = e.deformation.transpose() * s;
  if (tangent) *tangent = e.deformation.transpose() * k.asDiagonal() * e.deformation;
}

Matrix12 Springs::damping(int element) const {
  const Element& e = elements_[static_cast<std::size_t>(element)];
  return e.deformation.transpose() * e.properties.damping.asDiagonal() * e.deformation;
}

ElementShape Springs::shape(int element) const {
  ElementShape shape;
  shape.axes = elements_[static_cast<std::size_t>(element)].properties.axes;
  return shape;
}

}  // namespace nsframe
