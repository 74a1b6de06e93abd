// Mode shapes as ParaView frames.
#pragma once

#include <filesystem>
#include <vector>

#include "models/model.hpp"
#include "models/state.hpp"

namespace nsframe::app {

// One frame a shape (free DOFs) at the "time" of its number, frame 0 undeformed. Throws InputError without VTK.
void write_shape_frames(const Model& model, State state, const std::vector<VectorX>& shapes, const std::filesystem::path& folder);

}  // namespace nsframe::app
