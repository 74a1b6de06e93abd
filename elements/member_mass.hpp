// Mass of a prismatic member: lumped at its ends, or consistent with the displacements of the unloaded static member
// (Przemieniecki 1968; with shear deformation Friedman and Kosmatka 1993). Theory.md, "Mass of members".
#pragma once

#include "base/types.hpp"
#include "elements/beam_frame.hpp"
#include "elements/releases.hpp"

namespace nsframe {

struct MemberMass {
  double per_length = 0;        // [kg/m]
  double density = 0;           // [kg/m3], times the section's area; in place of per_length
  bool consistent = false;      // else lumped: half at each end
  bool rotary_inertia = false;  // of the cross-sections about their own axes

  bool operator==(const MemberMass&) const = default;
  bool any() const { return per_length > 0 || density > 0; }
};

// Of a cross-section, what its mass needs.
struct MassSection {
  double A = 0, Iz = 0, Iy = 0;                 // [m2], [m4]
  double shear_ratio_y = 0, shear_ratio_z = 0;  // 12 EI / (G A_s L^2) of the two planes of bending
};

double mass_per_length(const MemberMass& mass, const MassSection& section);  // [kg/m]

// Mass matrix in local axes, ux uy uz rx ry rz at both ends [kg, kg m, kg m2].
Matrix12 member_mass_matrix(const MemberMass& mass, const MassSection& section, double length);

// From the displacements of the nodes to those of a member's ends (global axes), at the far side of rigid arms; where
// moments are released, the ends turn so that none is left there. `stiffness`: basic, with all ends tied.
Matrix12 member_ends(const Releases& releases, const Matrix6& stiffness, const BeamFrame& frame);

}  // namespace nsframe
