// The paper's two-story pair from its example scene.
#pragma once

#include "models/model.hpp"
#include "scene/scene.hpp"

namespace nsframe::test {

inline Scene example_scene(const std::string& name, const std::vector<std::string>& overrides = {}) {
  Diagnostics diagnostics;
  Scene scene = read_scene(std::string(NSFRAME_SOURCE_DIR) + "/examples/" + name + "/scene.toml", overrides, diagnostics);
  diagnostics.throw_if_any();
  return scene;
}

inline Model model_of(const Scene& scene) {
  Diagnostics diagnostics;
  return build_model(scene.model, diagnostics);
}

}  // namespace nsframe::test
