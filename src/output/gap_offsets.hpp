// How far structures are moved apart where displacements are drawn larger than they are, so that gaps are drawn as much wider: then
// structures that touch are drawn touching.
#pragma once

#include <vector>

#include "base/types.hpp"

namespace nsframe {

// A gap between two structures, by their indices: `gap` is the vector across it when nothing has moved [m].
struct StructureGap {
  int from = 0, to = 0;
  Vector3 gap = Vector3::Zero();
};

// Of each structure, to be multiplied by the scale less one [m]: sums of the mean gaps along the rows of neighbours, zero for the first
// structure of each row.
std::vector<Vector3> gap_offsets(std::size_t structures, const std::vector<StructureGap>& gaps);

}  // namespace nsframe
