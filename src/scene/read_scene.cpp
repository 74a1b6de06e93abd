#include <fmt/format.h>

#include <fstream>
#include <set>
#include <sstream>

#include "base/errors.hpp"
#include "scene/describe.hpp"
#include "scene/overrides.hpp"
#include "scene/reader.hpp"
#include "scene/scene.hpp"

namespace nsframe {

namespace {

std::string read_text(const std::filesystem::path& file, Diagnostics& diagnostics) {
  std::error_code ignored;
  std::ifstream stream(file, std::ios::binary);
  if (!stream || std::filesystem::is_directory(file, ignored)) {
    diagnostics.error({file.string(), 0, 0}, "cannot open the scene");
    diagnostics.throw_if_any();
  }
  std::ostringstream text;
  text << stream.rdbuf();
  return text.str();
}

toml::table parse_toml(std::string_view text, const std::string& name, Diagnostics& diagnostics) {
  try {
    return toml::parse(text, name);
  } catch (const toml::parse_error& fault) {
    diagnostics.error(location(fault.source()), std::string(fault.description()));
    diagnostics.throw_if_any();
    throw;
  }
}

void note_places(const toml::table& root, Scene& scene) {
  for (const char* key : {"analysis", "output"}) {
    const toml::table* table = root[key].as_table();
    if (!table) continue;
    for (const auto& [name, value] : *table)
      scene.places[fmt::format("{}.{}", key, name.str())] = location(value.source());
  }
}

}  // namespace

Scene parse_scene(std::string_view text, const std::string& name, const std::filesystem::path& directory,
                  const std::vector<std::string>& overrides, Diagnostics& diagnostics) {
  toml::table root = parse_toml(text, name, diagnostics);
  apply_overrides(root, overrides, diagnostics);
  Scene scene;
  scene.directory = directory;
  Reader reader(diagnostics);
  reader.read({{&root}, std::nullopt, {name, 0, 0}}, Field{.key = "scene", .text = ""}, scene);
  note_places(root, scene);
  describe_model(scene, diagnostics);
  return scene;
}

Scene read_scene(const std::filesystem::path& file, const std::vector<std::string>& overrides,
                 Diagnostics& diagnostics) {
  return parse_scene(read_text(file, diagnostics), file.string(), file.parent_path(), overrides, diagnostics);
}

}  // namespace nsframe
