// A scene: a TOML file that says what to model, compute and keep. Reading gives the model's description in SI units;
// writing gives the complete scene with every default. The keys are listed in docs/scene-reference.md.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "base/diagnostics.hpp"
#include "models/analysis.hpp"
#include "models/description.hpp"
#include "scene/calibration_table.hpp"
#include "scene/gravity_table.hpp"

namespace nsframe {

// The tables of scene/tables.hpp.
struct MaterialTable;
struct SectionTable;
struct ExplicitStructure;
struct StoryFrameTable;
using StructureTable = std::variant<ExplicitStructure, StoryFrameTable>;
struct ContactTable;
struct StageTable;
struct MotionTable;

// What the file says, before parametric structures are expanded and records are read.
struct SceneTables {
  SceneTables();
  SceneTables(const SceneTables&);
  SceneTables(SceneTables&&) noexcept;
  SceneTables& operator=(const SceneTables&);
  SceneTables& operator=(SceneTables&&) noexcept;
  ~SceneTables();

  std::vector<MaterialTable> materials;
  std::vector<SectionTable> sections;
  std::vector<StructureTable> structures;
  std::vector<ContactTable> contacts;
  std::optional<GravityTable> gravity;
  std::vector<StageTable> stages;
  std::vector<MotionTable> motions;
  std::optional<CalibrationTable> calibration;
};

struct Scene {
  std::string title;
  ModelDescription model;
  AnalysisOptions analysis;
  OutputOptions output;
  SceneTables tables;
  std::filesystem::path directory;         // file names in the scene are relative to it
  std::map<std::string, Location> places;  // of the keys of [analysis] and [output] that are there, as "analysis.dt"

  Scene();
  Scene(const Scene&);
  Scene(Scene&&) noexcept;
  Scene& operator=(const Scene&);
  Scene& operator=(Scene&&) noexcept;
  ~Scene();
};

// Reads a scene; `overrides` are "key=value" texts that replace or add values before (--set).
// Throws InputError when the file can't be opened, is not TOML, or an override has no key. All other errors are only
// collected, and the scene holds what could be read, so that build_model() can add its own errors to them; the caller
// then calls diagnostics.throw_if_any().
Scene read_scene(const std::filesystem::path& file, const std::vector<std::string>& overrides,
                 Diagnostics& diagnostics);

// The same from a text; `name` stands in the places of errors, files are relative to `directory`.
Scene parse_scene(std::string_view text, const std::string& name, const std::filesystem::path& directory,
                  const std::vector<std::string>& overrides, Diagnostics& diagnostics);

// The complete scene as TOML, defaults included; parse_scene() of it gives the same scene. Names of files are written
// relative to `directory`, where the text is meant to be kept; by default that of the scene.
std::string write_scene(const Scene& scene, const std::filesystem::path& directory = {});

// The same with every parametric structure expanded to explicit nodes and elements.
std::string write_expanded_scene(const Scene& scene, const std::filesystem::path& directory = {});

// docs/scene-reference.md.
std::string scene_reference();

}  // namespace nsframe
