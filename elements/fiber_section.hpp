// Fiber section: structure of arrays, fibers of one law in a block, evaluated by a SIMD kernel chosen at run time.
// strain(y, z) = e0 - y kz + z ky;  N = sum s A, Mz = -sum s A y, My = sum s A z  (theory.md, "Sections").
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "base/types.hpp"
#include "elements/fiber_results.hpp"
#include "materials/uniaxial.hpp"

namespace nsframe {

struct SectionResponse {
  Vector3 force = Vector3::Zero();    // N [N], Mz, My [N m]
  Matrix3 tangent = Matrix3::Zero();  // derivative by (e0, kz, ky), symmetric
};

// One fiber to build a section from.
struct Fiber {
  double y = 0, z = 0;   // [m]
  double area = 0;       // [m2]
  UniaxialLaw law;
  std::string material = {};  // its name, for the output
};

struct FiberBlock {
  UniaxialLaw law;
  int first = 0, count = 0;    // padded to a multiple of fiber_padding by fibers without area
  int fibers = 0;              // without the padding
  int history_begin = 0;       // component k of fiber i stands at history_begin + k * count + i
  double quiet_limit = 0;      // of the law, 0 when it can't be screened
};

// Laws beside the fibers, each on its own: shear force by shear strain along y [N], along z, and torsional moment [N m] by
// twist [rad/m].
using AddedLaws = std::array<std::optional<UniaxialLaw>, 3>;

inline constexpr int fiber_padding = 8;  // doubles in the widest SIMD register in use

struct FiberSection {
  std::vector<double> y, z, area;
  std::vector<std::string> material;  // names; empty ones at the padding
  std::vector<FiberBlock> blocks;
  double torsion_stiffness = 0;  // GJ, or the initial tangent of the law of torsion [N m2]
  AddedLaws added;               // their histories stand behind those of the blocks
  int added_begin = 0;
  int history_size = 0;          // doubles
  int fibers = 0;
  double largest_y = 0, largest_z = 0;  // |y| and |z| of the fibers [m]
  bool screened = false;         // starts quiet (screening.hpp)
  SectionResponse virgin;        // at no deformation

  FiberSection() = default;
  // Fibers with equal laws are gathered into blocks, in the order of their first appearance.
  // `added` of torsion replaces `torsion_stiffness`.
  // `screening`: relative error of stress up to which a virgin fiber counts as linear; 0: rounding only.
  FiberSection(const std::vector<Fiber>& fibers, double torsion_stiffness, AddedLaws added = {}, double screening = 0);
};

// Virgin; quiet (screening.hpp) when the section is screened.
void initialize_history(const FiberSection& section, double* history);

// Section forces and tangent at `deformation` = (e0, kz, ky) from the committed fiber histories (history_size
// doubles each); writes the histories at the trial strains. Without `with_tangent` there is no tangent.
SectionResponse respond(const FiberSection& section, const Vector3& deformation, const double* committed, double* trial,
                        bool with_tangent = true);

// Added law `which` (as in AddedLaws, which must have it) at its deformation, from the committed history of the section.
UniaxialPoint respond_added(const FiberSection& section, std::size_t which, double deformation, const double* committed,
                            double* trial);

// A block's share of it when its law is a wrapper: the law on arrays (wrapper.hpp), then the sums.
void add_wrapped_block(const FiberSection& section, const FiberBlock& block, const Vector3& deformation,
                       const double* committed, double* trial, SectionResponse& sum);

// The same fiber by fiber in plain doubles, no section quiet: the definition that the kernel is tested against.
SectionResponse respond_scalar(const FiberSection& section, const Vector3& deformation, const double* committed,
                               double* trial);

// Tangent of the virgin section: EA, EIz, EIy and couplings.
Matrix3 initial_tangent(const FiberSection& section);

// Largest |strain| of a fiber over its yield strain at `deformation` (0 if no fiber can yield).
double peak_strain_ratio(const FiberSection& section, const Vector3& deformation);

// The fibers of a section (without point and position), block by block, and their states in the same order. `committed`
// as for respond(). All output of single fibers comes from here.
std::vector<FiberPlace> fiber_places(const FiberSection& section);
std::vector<FiberState> fiber_states(const FiberSection& section, const Vector3& deformation, const double* committed);

// True when one of the fiber_states() has yielded.
bool has_yielded(const FiberSection& section, const Vector3& deformation, const double* committed);

}  // namespace nsframe
