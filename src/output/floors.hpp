// The floors of a structure, for story drifts and for whoever draws them.
//
// Floors of a connected structure are the levels of its slabs (centre node, or the mean of the corners); without slabs,
// the levels of nodes that carry horizontal mass (their mean). The base is the lowest level of its nodes.
#pragma once

#include <vector>

#include "models/model.hpp"

namespace nsframe {

struct Floor {
  double level = 0;  // z [m]
  std::vector<int> nodes;
};

// From the lowest, the base included where there is one; none for a structure without mass.
std::vector<Floor> floors_of(const Model& model, int structure);

}  // namespace nsframe
