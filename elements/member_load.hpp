// Loads between the ends of a member, in its local axes: what they make in the basic system (simply supported, held
// along x at its first end) and in a member with clamped ends. Theory.md, "Loads on members".
#pragma once

#include <vector>

#include "elements/beam_frame.hpp"

namespace nsframe {

struct MemberLoad {
  struct Point {
    double position = 0;              // along the member, in [0, 1]
    Vector3 force = Vector3::Zero();  // [N]
  };
  Vector3 uniform = Vector3::Zero();  // [N/m] of the member's length
  std::vector<Point> points;

  bool empty() const { return uniform.isZero(0) && points.empty(); }
};

// N [N], Mz, My [N m] at x in [0, 1] of the basic system under the load.
Vector3 section_force(const MemberLoad& load, double x, double length);

// The same with the shear forces: Vy = -dMz/dx, Vz = dMy/dx, as the part beyond acts on the part before; at a point
// load the values before it.
struct LoadedSection {
  Vector3 force;   // N, Vy, Vz [N]
  Vector3 moment;  // T, My, Mz [N m]
};
LoadedSection section_forces(const MemberLoad& load, double x, double length);

// Forces that the supports of the basic system apply to the ends: N, Vy, Vz, T, My, Mz at both, local axes.
Vector12 support_forces(const MemberLoad& load, double length);

// Basic forces of a prismatic member without shear deformation whose ends are clamped; also the work-equivalent basic
// forces of linear axial and cubic transverse displacements.
Vector6 clamped_forces(const MemberLoad& load, double length);

// Basic deformations of the free basic system, of a prismatic member (shear deformation adds nothing to them).
Vector6 free_deformations(const MemberLoad& load, double length, double EA, double EIz, double EIy);

// Adds what `factor` times the load does to the end forces beyond the basic forces: the supports' forces and, with
// `p_delta`, its share of the mean axial force on the chord's shift.
void add_load(const MemberLoad& load, double factor, const BeamFrame& frame, bool p_delta, const Vector12& displacement,
              Vector12& force, Matrix12* tangent);

}  // namespace nsframe
