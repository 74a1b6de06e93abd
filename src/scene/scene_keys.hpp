// Numbers of a scene by their dotted keys: "section.beam.Iz", "structure.left.braces.area[2]",
// "structure.a.springs.k1.stiffness.ry". The schema says what there is, so keys that the file leaves to their default count too.
#pragma once

#include <stdexcept>
#include <string>
#include <vector>

#include "base/range.hpp"
#include "scene/quantity.hpp"
#include "scene/scene.hpp"

namespace nsframe {

struct SceneNumbers {
  std::vector<double*> values;  // one; or all of a list without [n]
  Dimension dimension;
  Range range;
};

// Not a key of a number; what() says why.
struct SceneKeyError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

// The numbers of `tables` below material, section, structure and gravity that `key` means. Valid until `tables` changes otherwise.
SceneNumbers find_numbers(SceneTables& tables, const std::string& key);

}  // namespace nsframe
