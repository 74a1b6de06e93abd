// Dead loads between the ends of corotational members. Such a load keeps its direction, so that in the member's axes it
// turns with every motion: l = A l_0 with the member's present axes as rows of A and the load l_0 in global axes. The
// nine entries of A are therefore deformations of the basic system beside the six v, and the potential
// Pi(v, A) = strain energy - load * displacement there gives the basic forces by v, the load's moment by A's rotation
// and all second derivatives (theory.md, 377 to 383).
#pragma once

#include <array>

#include "elements/member_load.hpp"

namespace nsframe {

using Vector9 = Eigen::Matrix<double, 9, 1>;
using Matrix9 = Eigen::Matrix<double, 9, 9>;
using Matrix6x9 = Eigen::Matrix<double, 6, 9>;
using Matrix6x3 = Eigen::Matrix<double, 6, 3>;

// Entries in the order of Vector9: those of local x, y, z after each other.
Vector9 entries(const Matrix3& axes);

// The load of one global direction laid along all three local axes at once: with the k-th of them, entry (a, k) of A
// times what pattern k makes along local axis a is what the load makes there.
std::array<MemberLoad, 3> dead_patterns(const MemberLoad& load);

// A linear answer (6, basic directions) to the patterns as one to the entries of A: axial force by local x, bending about z
// by y, bending about y by z.
Matrix6x9 by_entries(const std::array<Vector6, 3>& of_patterns);

// Section forces that a unit of each entry makes at x in [0, 1] of the basic system: N, Mz, My, dMz/dx, dMy/dx.
Eigen::Matrix<double, 5, 9> sections_by_entries(const std::array<MemberLoad, 3>& patterns, double x, double length);

// Of the basic system of a prismatic member: displacements conjugate to the entries by the load in local axes, and by the
// entries themselves [m N]. Flexibilities of N, Mz, My, Vy, Vz.
struct PrismaticDisplacements {
  Vector9 by_local = Vector9::Zero();
  Matrix9 by_entries = Matrix9::Zero();
};
PrismaticDisplacements prismatic_displacements(const MemberLoad& load, double length, const Eigen::Matrix<double, 5, 1>& flexibility);

// What a member knows of its dead load at a deformation.
struct DeadResponse {
  Vector9 displacement = Vector9::Zero();    // minus dPi/dA for a unit of the acting part [N m]
  Matrix6x9 force = Matrix6x9::Zero();       // basic forces by A for such a unit; also minus the displacement's derivative by v
  Matrix9 displacement_by_load = Matrix9::Zero();  // the displacement's derivative by A, likewise
};

// First and second derivatives of Pi by the rotation of the member's axes (spin in these axes).
struct DeadMoment {
  Vector3 moment;             // dPi [N m]
  Matrix6x3 force_by_spin;    // of the basic forces
  Matrix3 by_spin;            // of the moment
};
DeadMoment dead_moment(const DeadResponse& response, double part, const Matrix3& axes);

}  // namespace nsframe
