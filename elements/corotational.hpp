// Corotational transformations: deformations are measured from axes that move with the member's chord, so that
// displacements and rotations of the nodes may have any size while the member itself deforms little (Crisfield 1990;
// axes by Battini, Pacoste 2002; theory.md, section 9).
//
// The rotation of a node is a unit quaternion. Its three rotational DOFs are the integral of its angular velocity in
// global axes: over a step they grow by a rotation vector d, and the node turns by R = exp(d) R_committed. Integrators
// may therefore add h times the velocity, no angle is singular, and moments are those about the global axes.
#pragma once

#include "elements/member_geometry.hpp"

namespace nsframe {

class CorotationalBeam : public MemberGeometry {
 public:
  std::string_view suffix() const override { return "_corotational"; }
  bool finite() const override { return true; }
  // For each end: the rotational DOFs of the node (3), and the quaternion x, y, z, w of its rotation (4).
  int history_size() const override { return 14; }
  void initialize_history(double* history) const override;
  Vector6 deformation(const BeamFrame& frame, const Vector12& displacement, const double* committed,
                      double* trial) const override;
  double rounding(const Vector12& displacement) const override;
  void to_global(const BeamFrame& frame, const Vector12& displacement, const double* committed,
                 const Vector6& basic_force, const Matrix6& basic_tangent, Vector12& force,
                 Matrix12* tangent) const override;
  // A load in local axes turns with the member, the supports' forces act in its present axes.
  void add_load(const BeamFrame& frame, const MemberLoad& load, double part, const Vector12& displacement,
                const double* committed, Vector12& force, Matrix12* tangent) const override;
  Matrix3 axes(const BeamFrame& frame, const Vector12& displacement, const double* committed) const override;
  void add_dead_load(const BeamFrame& frame, const MemberLoad& load, double part, const DeadMoment& moment,
                     const Vector12& displacement, const double* committed, Vector12& force, Matrix12* tangent) const override;
  ElementPose pose(const BeamFrame& frame, const Vector12& displacement, const double* history) const override;
};

// Axial force along the present chord; the rotations of the nodes don't matter.
class CorotationalBar : public MemberGeometry {
 public:
  std::string_view suffix() const override { return "_corotational"; }
  bool finite() const override { return true; }
  bool symmetric() const override { return true; }
  Vector6 deformation(const BeamFrame& frame, const Vector12& displacement, const double* committed,
                      double* trial) const override;
  void to_global(const BeamFrame& frame, const Vector12& displacement, const double* committed,
                 const Vector6& basic_force, const Matrix6& basic_tangent, Vector12& force,
                 Matrix12* tangent) const override;
  ElementPose pose(const BeamFrame& frame, const Vector12& displacement, const double* history) const override;
};

}  // namespace nsframe
