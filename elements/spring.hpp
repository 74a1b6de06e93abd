// Springs and dashpots in six directions along local axes: of no length, between two nodes or a node and the ground, or
// links of some length, whose shear springs sit at a given place between the nodes.
#pragma once

#include <optional>

#include "elements/element_group.hpp"
#include "materials/uniaxial.hpp"

namespace nsframe {

struct SpringProperties {
  Matrix3 axes = Matrix3::Identity();             // rows: local axes in global axes
  Vector6 stiffness = Vector6::Zero();            // [N/m], [N m/rad]
  Vector6 damping = Vector6::Zero();              // [N s/m], [N m s/rad]
  double length = 0;                              // [m] from the first node to the second, along local x
  Vector2 shear_distance = Vector2::Zero();       // place of the springs along y and z, in [0, 1] of the length
  std::array<std::optional<UniaxialLaw>, 6> law;  // force [N, N m] by displacement [m, rad]; replaces the stiffness
};

class Springs : public ElementGroup {
 public:
  explicit Springs(bool linear) : linear_(linear) {}
  void add(const ElementNodes& nodes, std::string id, SpringProperties properties);

  std::string_view kind() const override { return "spring"; }
  bool linear() const override { return linear_; }
  int history_begin(int element) const override { return history_begin_[static_cast<std::size_t>(element)]; }
  void initialize_history(int element, double* history) const override;
  void respond(int element, const Vector12& displacement, const double* committed, double* trial, Vector12& force,
               Matrix12* tangent) const override;
  Matrix12 damping(int element) const override;
  ElementShape shape(int element) const override;

 private:
  struct Element {
    SpringProperties properties;
    Eigen::Matrix<double, 6, 12> deformation;  // local relative displacement of node 2 against node 1
  };
  bool linear_;
  std::vector<Element> elements_;
  std::vector<int> history_begin_{0};
};

}  // namespace nsframe
