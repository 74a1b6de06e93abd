// Modes of every connected structure, and the damping that the scene asks for.
#pragma once

#include "assembly/system.hpp"
#include "modal/modes.hpp"

namespace nsframe {

struct StructureModes {
  Modes modes;                            // in the structure's free DOFs
  std::vector<std::string> names;         // L1, T1, ...
  std::vector<Vector3> participation;     // effective mass over total mass in x, y, z
  VectorX damping_ratio;                  // phi' C phi / (2 w), filled by assemble_damping()
};

// Modes of every structure from the tangent `stiffness`: at least `count`, and all that the scene's named damping
// ratios mention.
std::vector<StructureModes> structure_modes(const Model& model, const SparseMatrix& stiffness, int count);

// Fills system.damping as the structures ask, and the ratios that result into `modes`. Throws InputError for a
// named mode that a structure does not have.
void assemble_damping(System& system, const SparseMatrix& stiffness, std::vector<StructureModes>& modes);

}  // namespace nsframe
