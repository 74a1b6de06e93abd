// Scenes from texts, for tests.
#pragma once

#include <string>
#include <vector>

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

}  // namespace nsframe::test
