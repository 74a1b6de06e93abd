// The registry of section kinds: a new one is its header here and its line in SectionKind.
#pragma once

#include <string>
#include <variant>

#include "scene/sections/angle.hpp"
#include "scene/sections/concrete_circle.hpp"
#include "scene/sections/concrete_rectangle.hpp"
#include "scene/sections/constants.hpp"
#include "scene/sections/fibers.hpp"
#include "scene/sections/pipe.hpp"
#include "scene/sections/rolled_shape.hpp"
#include "scene/sections/tube.hpp"

namespace nsframe {

using SectionKind = 
    std::variant<ShapeSection, TubeSection, PipeSection, AngleSection, ConcreteRectangle, ConcreteCircle, PatchSection,
                 ConstantsSection>;

// "`shape` (a rolled shape), ...": what tells the kinds apart.
inline std::string section_choices() {
  return []<class... Kinds>(const std::variant<Kinds...>*) {
    std::string out;
    ((out += fmt::format("{}{} ({})", out.empty() ? "" : ", ", fmt::join(Kinds::chosen_by, " or "), Kinds::title)), ...);
    return out;
  }(static_cast<const SectionKind*>(nullptr));
}

}  // namespace nsframe
