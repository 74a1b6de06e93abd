#include <fmt/format.h>

#include <fstream>
#include <set>
#include <sstream>

#include "base/errors.hpp"
#include "scene/calibration.hpp"
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

// Options that only Moreau-Jean has, given without a scheme, ask for it.
void find_scheme(Scene& scene) {
  const auto named = scene.places.find("analysis.scheme");
  if (named != scene.places.end()) {
    scene.analysis.scheme_at = named->second;
    if (scene.analysis.scheme == "event-split" && !scene.places.contains("analysis.theta")) scene.analysis.theta = 0.5;
    return;
  }
  for (const char* key : {"integrator", "rho_infinity"}) {
    if (!scene.places.contains(fmt::format("analysis.{}", key))) continue;
    scene.analysis.scheme = "event-split";
    scene.analysis.scheme_reason = fmt::format("analysis.{} is an option of this scheme alone", key);
    if (!scene.places.contains("analysis.theta")) scene.analysis.theta = 0.5;
    return;
  }
  for (const char* key : {"theta", "gamma", "newton_tolerance", "max_newton", "max_halvings", "contact_solver", "projection"}) {
    if (!scene.places.contains(fmt::format("analysis.{}", key))) continue;
    scene.analysis.scheme = "moreau-jean";
    scene.analysis.scheme_reason = fmt::format("analysis.{} is an option of this scheme alone", key);
    return;
  }
}

// A record named on the command line may also be relative to the current directory.
void find_overridden_records(Scene& scene) {
  std::error_code ignored;
  for (MotionTable& motion : scene.tables.motions) {
    if (!motion.file.at.file.starts_with("--set ")) continue;
    const std::filesystem::path file = motion.file.name;
    if (std::filesystem::exists(scene.directory / file, ignored) || !std::filesystem::exists(file, ignored)) continue;
    motion.file.name = std::filesystem::absolute(file).string();
  }
}

// build_model() doesn't see what is to be kept.
void check_output_nodes(const Scene& scene, Diagnostics& diagnostics) {
  std::vector<std::string> known;
  for (const StructureDescription& structure : scene.model.structures)
    for (const NodeDescription& node : structure.nodes) known.push_back(structure.name + "." + node.id);
  const std::set<std::string> found(known.begin(), known.end());
  const auto check = [&](const std::vector<std::string>& nodes, const char* key) {
    for (const std::string& node : nodes)
      if (!found.contains(node))
        diagnostics.error(scene.places.at(key), fmt::format("there is no node '{}'{}", node, did_you_mean(node, known)));
  };
  check(scene.output.nodes, "output.nodes");
  if (!scene.output.floor_spectra) return;
  std::vector<std::string> nodes = scene.output.floor_spectra->nodes;
  std::erase(nodes, "floors");
  check(nodes, "output.floor_spectra");
}

// So that --set output.floor_spectra=none can switch them off.
void drop_floor_spectra(toml::table& root) {
  toml::table* const output = root["output"].as_table();
  if (output && (*output)["floor_spectra"].value<std::string_view>() == "none") output->erase("floor_spectra");
}

}  // namespace

Scene parse_scene(std::string_view text, const std::string& name, const std::filesystem::path& directory,
                  const std::vector<std::string>& overrides, Diagnostics& diagnostics) {
  toml::table root = parse_toml(text, name, diagnostics);
  apply_overrides(root, overrides, diagnostics);
  drop_floor_spectra(root);
  Scene scene;
  scene.directory = directory;
  Reader reader(diagnostics);
  reader.read({{&root}, std::nullopt, {name, 0, 0}}, Field{.key = "scene", .text = ""}, scene);
  note_places(root, scene);
  find_scheme(scene);
  find_overridden_records(scene);
  describe_model(scene, diagnostics);
  scene.model.screening = scene.analysis.screening;
  if (diagnostics.empty()) check_output_nodes(scene, diagnostics);
  if (diagnostics.empty()) check_calibration(scene, diagnostics);
  return scene;
}

Scene read_scene(const std::filesystem::path& file, const std::vector<std::string>& overrides,
                 Diagnostics& diagnostics) {
  return parse_scene(read_text(file, diagnostics), file.string(), file.parent_path(), overrides, diagnostics);
}

}  // namespace nsframe
