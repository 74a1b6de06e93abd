// Motions of a model: of the whole base, or of supports, all together or one after the other as a wave reaches them.
#pragma once

#include <vector>

#include "models/model.hpp"

namespace nsframe {

// Supports that move at one time, and by how much when the motion is 1 m.
struct MovedSupports {
  std::size_t motion = 0;                     // index into ModelDescription::motions
  double delay = 0;                           // [s]
  std::vector<std::pair<int, double>> dofs;   // full DOFs [m/m]
};

// One entry for each motion of the base (without DOFs), and one for each delay of the others. `fixed`: full DOFs held by supports.
std::vector<MovedSupports> find_moved_supports(const std::vector<MotionDescription>& motions, const Nodes& nodes,
                                               const std::vector<bool>& fixed, Diagnostics& diagnostics);

// Fills motions, motion_load and driven of a model whose DOFs are numbered and whose mass is assembled.
void add_motions(Model& model, const std::vector<MotionDescription>& motions, const std::vector<MovedSupports>& moved,
                 Diagnostics& diagnostics);

// Whether a motion prescribes a DOF, by its number among the full ones.
bool prescribed(const Model& model, int full_dof);

}  // namespace nsframe
