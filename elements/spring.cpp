#include "elements/spring.hpp"

#include <tuple>

namespace nsframe {

namespace {

// Theory.md, 134: forces at the nodes (12) of the axial force 1, as a matrix on the nodes' displacements.
Matrix12 p_delta_forces(const SpringProperties& link) {
  const auto& [y_i, y_j, z_i, z_j] = *link.p_delta;
  const auto y = link.axes.row(1), z = link.axes.row(2);
  using Row = Eigen::Matrix<double, 1, 12>;
  Row along_y = Row::Zero(), along_z = Row::Zero();  // of node j against node i
  along_y.head<3>() = -y;
  along_y.segment<3>(6) = y;
  along_z.head<3>() = -z;
  along_z.segment<3>(6) = z;
  Matrix12 shift = (1 - z_i - z_j) / link.length * along_y.transpose() * along_y +
                   (1 - y_i - y_j) / link.length * along_z.transpose() * along_z;
  for (const auto& [row, about_y, about_z] : {std::tuple{3, y_i, z_i}, {9, y_j, z_j}}) {
    shift.middleRows<3>(row) += z.transpose() * (about_z * along_y) - y.transpose() * (about_y * along_z);
  }
  return shift;
}

}  // namespace

void Springs::add(const ElementNodes& nodes, std::string id, SpringProperties properties) {
  ElementGroup::add(nodes, std::move(id));
  int size = 0;
  for (const auto& law : properties.law) size += law ? history_size(*law) : 0;
  history_begin_.push_back(history_begin_.back() + size);
  Element element{std::move(properties), Eigen::Matrix<double, 6, 12>::Zero(), Matrix12::Zero()};
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
  if (nodes[1] < 0) element.deformation *= -1;  // of the node against the ground
  if (element.properties.p_delta) element.shift = p_delta_forces(element.properties);
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
  if (!e.properties.p_delta) return;
  const Vector12 of_unit_force = e.shift * displacement;
  force += s[0] * of_unit_force;
  if (tangent) *tangent += s[0] * e.shift + of_unit_force * (k[0] * e.deformation.row(0));
}

RateEnergy Springs::respond_rate(int element, const Vector12& displacement, const double* committed, double* trial,
                                 const StepSpan& step, Vector12& force, Matrix12& tangent) const {
  const Element& e = elements_[static_cast<std::size_t>(element)];
  const Vector6 d = e.deformation * displacement;
  Vector6 s = Vector6::Zero(), k = Vector6::Zero();
  RateEnergy energy;
  for (int i = 0; i < 6; ++i) {
    const auto& law = e.properties.law[static_cast<std::size_t>(i)];
    if (!law) continue;
    const RatePoint point = nsframe::respond_rate(*law, d[i], committed, trial, step);
    s[i] = point.stress;
    k[i] = point.tangent;
    energy.dissipated += point.energy.dissipated;
    energy.stored += point.energy.stored;
    committed += history_size(*law);
    trial += history_size(*law);
  }
  force.noalias() = e.deformation.transpose() * s;
  tangent = e.deformation.transpose() * k.asDiagonal() * e.deformation;
  return energy;
}

Vector12 Springs::rate_force(int element, const Vector12&, const double* history) const {
  const Element& e = elements_[static_cast<std::size_t>(element)];
  Vector6 s = Vector6::Zero();
  for (int i = 0; i < 6; ++i) {
    const auto& law = e.properties.law[static_cast<std::size_t>(i)];
    if (!law) continue;
    s[i] = rate_stress(*law, history);
    history += history_size(*law);
  }
  return e.deformation.transpose() * s;
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
