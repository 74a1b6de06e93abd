// "key=value" texts of the command line (--set), applied to the TOML tree before the scene is read. Values that are
// not TOML are taken as text, so that motion.pga=0.25 g works. A key below a list of tables ([[contact]]) reaches all
// of them. Values read from an override have "--set KEY" as their file.
#pragma once

#include <toml++/toml.h>

#include <string>
#include <vector>

#include "base/diagnostics.hpp"

namespace nsframe {

void apply_overrides(toml::table& scene, const std::vector<std::string>& overrides, Diagnostics& diagnostics);

}  // namespace nsframe
