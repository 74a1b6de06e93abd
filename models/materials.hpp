// Uniaxial laws by name, wrappers with the laws inside them found.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "models/description.hpp"

namespace nsframe {

using Materials = std::map<std::string, UniaxialLaw>;

// Errors: names used twice, inner laws that are not defined, laws made of themselves, parameters outside their range.
// A law with an error inside stands as a placeholder, so that its name stays known.
Materials resolve_materials(const std::vector<MaterialDescription>& materials, Diagnostics& diagnostics);

// The same in the descriptions themselves; laws with an error are marked, and not reported again.
void resolve_in_place(std::vector<MaterialDescription>& materials, Diagnostics& diagnostics);

}  // namespace nsframe
