// Scenes from texts, for tests.
#pragma once

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "scene/scene.hpp"

namespace nsframe::test {

// A directory of its own, removed at the end.
class TemporaryDirectory {
 public:
  TemporaryDirectory() {
    std::string name = (std::filesystem::temp_directory_path() / "nsframe-XXXXXX").string();
    path_ = mkdtemp(name.data());
  }
  ~TemporaryDirectory() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  std::filesystem::path write(const std::string& name, std::string_view text) const {
    std::ofstream(path_ / name, std::ios::binary) << text;
    return path_ / name;
  }
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

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
