// /model of results.h5: what stands where, so that a program can draw the histories without the scene.
#pragma once

#include "models/model.hpp"
#include "output/hdf5_file.hpp"

namespace nsframe {

// Groups below /model; indices count from 0 in the order of nodes/id:
//   structures: the names
//   nodes/id (m), position (m, 3) [m], structure (m)
//   members/id (k), kind (k), nodes (k, 2), ends (k, 2, 3) [m], without the rigid arms; curved (k), 1 where a beam bends
//   slabs/id (s), corner (c, nodes), first (s + 1): corners of slab i are [first[i], first[i + 1]) of `corner`
//   floors/structure (f), level (f) [m], node, first (f + 1): floors as story drifts take them, their nodes as above
//   pairs/position (p, 3) [m], normal (p, 3), structures (p, 2), -1 for a wall: contact pairs in their order
// Springs, and members to the ground, have no place of their own and are left out.
void write_model_tables(Hdf5File& file, const Model& model);

}  // namespace nsframe
