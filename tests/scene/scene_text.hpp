// Scenes from texts, for tests.
#pragma once

#include <doctest/doctest.h>

#include <string>
#include <vector>

#include "integrators/simulation.hpp"
#include "scene/scene.hpp"
#include "tests/support/files.hpp"

namespace nsframe::test {

inline Scene scene(std::string_view text, const std::vector<std::string>& overrides = {}) {
  Diagnostics diagnostics;
  Scene out = parse_scene(text, "s.toml", {}, overrides, diagnostics);
  diagnostics.throw_if_any();
  return out;
}

inline std::vector<std::string> errors(std::string_view text, const std::vector<std::string>& overrides = {}) {
  Diagnostics diagnostics;
  parse_scene(text, "s.toml", {}, overrides, diagnostics);
  return diagnostics.messages();
}

// The only error of a scene.
inline std::string error(std::string_view text, const std::vector<std::string>& overrides = {}) {
  const auto all = errors(text, overrides);
  std::string out = all.empty() ? "no error" : all.front();
  for (std::size_t i = 1; i < all.size(); ++i) out += "\n" + all[i];
  return out;
}

// Displacements of all nodes after the static stages of a scene, full DOFs [m], [rad].
inline VectorX displaced(std::string_view text) {
  const Scene s = scene(text);
  Diagnostics diagnostics;
  const Model model = build_model(s.model, diagnostics);
  Simulation simulation(model, s.analysis);
  std::vector<StageResult> results;
  REQUIRE(simulation.run_stages(1, {s.analysis.algorithm, {}, {}}, results));
  return model.dofs.expand(simulation.state().displacement);
}

}  // namespace nsframe::test
