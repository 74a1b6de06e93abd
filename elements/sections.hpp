// Cross-sections: elastic constants, or fibers of uniaxial laws. Local axes as in OpenSees: x along the member,
// strain(y, z) = e0 - y kz + z ky; N = sum s A, Mz = -sum s A y, My = sum s A z.
// A catalogue shape has its depth along y, so Iz is its strong axis.
#pragma once

#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "base/diagnostics.hpp"
#include "base/types.hpp"

namespace nsframe {

struct ElasticSection {
  double E = 0;   // [Pa]
  double G = 0;   // [Pa]
  double A = 0;   // [m2]
  double Iz = 0;  // [m4] bending in the local x-y plane
  double Iy = 0;  // [m4] bending in the local x-z plane
  double J = 0;   // [m4] Saint-Venant torsion constant
  double Ay = 0;  // [m2] shear area for forces along local y; 0: rigid in shear
  double Az = 0;  // [m2] the same along local z
};

struct FiberDescription {
  double y = 0, z = 0;  // [m]
  double area = 0;      // [m2]
  Reference material;
  bool displaced = false;  // taken out: another fiber stands in its place
};

struct FiberSectionDescription {
  std::vector<FiberDescription> fibers;
  double torsion_stiffness = 0;  // GJ [N m2], uncoupled
  // Laws beside the fibers, uncoupled: torsional moment [N m] by twist [rad/m] in place of GJ, and shear forces along
  // local y and z [N] by shear strain; without these the section is rigid in shear.
  std::optional<Reference> torsion, shear_y, shear_z;
};

// Outline of the cross-section in (y, z), for drawing the extruded member; open polygon, in order; may be empty.
using SectionOutline = std::vector<Vector2>;

struct SectionDescription {
  std::string name;
  Location at;
  std::variant<ElasticSection, FiberSectionDescription> kind;
  SectionOutline outline;
  bool faulty = false;  // an error in it, or in one of its materials, was reported already
};

}  // namespace nsframe
