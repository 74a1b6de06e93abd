#include "elements/member_geometry.hpp"

#include <limits>

#include "elements/corotational.hpp"
#include "elements/member_load.hpp"

namespace nsframe {

namespace {

class LinearGeometry : public MemberGeometry {
 public:
  std::string_view suffix() const override { return ""; }
  bool linear() const override { return true; }
  bool symmetric() const override { return true; }
  Vector6 deformation(const BeamFrame& frame, const Vector12& displacement, const double*, double*) const override {
    return frame.compatibility * displacement;
  }
  void to_global(const BeamFrame& frame, const Vector12&, const double*, const Vector6& basic_force,
                 const Matrix6& basic_tangent, Vector12& force, Matrix12* tangent) const override {
    const Matrix6x12& A = frame.compatibility;
    force.noalias() = A.transpose() * basic_force;
    if (!tangent) return;
    const Matrix6x12 stiff = basic_tangent * A;
    tangent->noalias() = A.transpose() * stiff;
  }
};

// The axial force acts on the chord's shift, N/L * shift at the ends, as in OpenSees' PDelta transformation; its tangent
// is exact and not symmetric, because that theory has no work-conjugate elongation.
class PDeltaGeometry : public LinearGeometry {
 public:
  std::string_view suffix() const override { return "_p_delta"; }
  bool linear() const override { return false; }
  bool symmetric() const override { return false; }
  void to_global(const BeamFrame& frame, const Vector12& displacement, const double* committed,
                 const Vector6& basic_force, const Matrix6& basic_tangent, Vector12& force,
                 Matrix12* tangent) const override {
    LinearGeometry::to_global(frame, displacement, committed, basic_force, basic_tangent, force, tangent);
    const Vector12 direction = frame.chord_shift.transpose() * (frame.chord_shift * displacement) / frame.length;
    force += basic_force[0] * direction;
    if (!tangent) return;
    *tangent += basic_force[0] / frame.length * (frame.chord_shift.transpose() * frame.chord_shift);
    *tangent += direction * (basic_tangent.row(0) * frame.compatibility);
  }
  void add_load(const BeamFrame& frame, const MemberLoad& load, double part, const Vector12& displacement, const double*,
                Vector12& force, Matrix12* tangent) const override {
    nsframe::add_load(load, part, frame, true, displacement, force, tangent);
  }
};

}  // namespace

double MemberGeometry::rounding(const Vector12& displacement) const {
  return std::numeric_limits<double>::epsilon() * displacement.cwiseAbs().maxCoeff();
}

void MemberGeometry::add_load(const BeamFrame& frame, const MemberLoad& load, double part, const Vector12& displacement,
                              const double*, Vector12& force, Matrix12* tangent) const {
  nsframe::add_load(load, part, frame, false, displacement, force, tangent);
}

ElementPose MemberGeometry::pose(const BeamFrame& frame, const Vector12&, const double*) const {
  ElementPose pose;
  pose.axes = frame.axes;
  pose.arm = frame.offset;
  return pose;
}

const MemberGeometry& beam_geometry(Geometry kind) {
  static const LinearGeometry linear;
  static const PDeltaGeometry p_delta;
  static const CorotationalBeam corotational;
  switch (kind) {
    case Geometry::p_delta: return p_delta;
    case Geometry::corotational: return corotational;
    case Geometry::linear: break;
  }
  return linear;
}

const MemberGeometry& bar_geometry(Geometry kind) {
  static const CorotationalBar corotational;
  return kind == Geometry::corotational ? corotational : beam_geometry(kind);
}

}  // namespace nsframe
