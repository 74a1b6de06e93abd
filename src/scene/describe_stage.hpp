// Static stages: from the tables of a scene to the model's description.
#pragma once

#include <filesystem>
#include <optional>

#include "scene/scene.hpp"
#include "scene/tables.hpp"

namespace nsframe {

// `number` names a stage that has no name. A file of targets that can't be read is reported, and nothing returned.
std::optional<StageDescription> describe(const StageTable& stage, std::size_t number,
                                         const std::filesystem::path& directory, Diagnostics& diagnostics);

}  // namespace nsframe
