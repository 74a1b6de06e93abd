// The moving drawing of a report: what stands where, and frames of the nodes' motion in 16 bits.
#pragma once

#include <nlohmann/json.hpp>

#include "report/run_folder.hpp"

namespace nsframe {

// For view.js: position, structure, members, slabs, points (nodes of structures without members), recorded, times, frames
// (base64 of little-endian 16-bit integers, six a recorded node: displacement and rotation), unit (of one [m], [rad]), scale
// (of displacements), pairs, offsets (of structures, by output/gap_offsets.hpp), walls, note. Null where nothing has a place.
nlohmann::json drawing(const RunFolder& run);

}  // namespace nsframe
