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
  // Of a link: shares of the moments N delta that the ends take, about y at i and j, about z at i and j (OpenSees'
  // -pDelta); shear forces over the length balance the rest. None: no P-Delta.
  std::optional<std::array<double, 4>> p_delta;
  std::array<std::optional<UniaxialLaw>, 6> law;  // force [N, N m] by displacement [m, rad]; replaces the stiffness
};

class Springs : public ElementGroup {
 public:
  // Of a group: `linear`, all its laws are and there is no P-Delta; `rates`, some law depends on the rate of deformation.
  struct Kind {
    bool linear = true, rates = false, p_delta = false;
  };
  explicit Springs(Kind kind) : kind_(kind) {}
  void add(const ElementNodes& nodes, std::string id, SpringProperties properties);

  std::string_view kind() const override { return "spring"; }
  bool linear() const override { return kind_.linear; }
  bool symmetric() const override { return !kind_.p_delta; }
  int history_begin(int element) const override { return history_begin_[static_cast<std::size_t>(element)]; }
  void initialize_history(int element, double* history) const override;
  void respond(int element, const Vector12& displacement, const double* committed, double* trial, Vector12& force,
               Matrix12* tangent) const override;
  bool rate_dependent() const override { return kind_.rates; }
  RateEnergy respond_rate(int element, const Vector12& displacement, const double* committed, double* trial,
                          const StepSpan& step, Vector12& force, Matrix12& tangent) const override;
  Vector12 rate_force(int element, const Vector12& displacement, const double* history) const override;
  Matrix12 damping(int element) const override;
  ElementShape shape(int element) const override;

 private:
  struct Element {
    SpringProperties properties;
    Eigen::Matrix<double, 6, 12> deformation;  // local relative displacement of node 2 against node 1, or of the one node against the ground
    Matrix12 shift;                            // P-Delta forces of a unit axial force, by the displacement [1/m]
  };
  Kind kind_;
  std::vector<Element> elements_;
  std::vector<int> history_begin_{0};
};

}  // namespace nsframe
