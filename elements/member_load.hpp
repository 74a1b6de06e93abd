// Loads between the ends of a member: what those in its local axes make in the basic system (simply supported, held along x
// at its first end) and in a member with clamped ends. Theory.md, "Loads on members".
#pragma once

#include <vector>

#include "elements/beam_frame.hpp"

namespace nsframe {

struct MemberLoad {
  struct Point {
    double position = 0;              // along the member, in [0, 1]
    Vector3 force = Vector3::Zero();  // [N]
  };
  Vector3 uniform = Vector3::Zero();  // local axes, [N/m] of the member's length
  std::vector<Point> points = {};     // local axes
  // Dead loads keep their direction: in global axes.
  Vector3 dead_uniform = Vector3::Zero();
  std::vector<Point> dead_points = {};

  bool empty() const { return uniform.isZero(0) && points.empty() && !dead(); }
  bool dead() const { return !dead_uniform.isZero(0) || !dead_points.empty(); }
  // All of it in local axes, of which `axes` has the rows.
  MemberLoad in(const Matrix3& axes) const;
};

// The part of a member's load that acts, as it stands in the present local axes (no dead part; null for none).
struct ActingLoad {
  double part = 0;
  const MemberLoad* load = nullptr;
};

// The functions below are of the load in local axes, without the dead part.

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
