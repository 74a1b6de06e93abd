// The commands of the program. Each returns its exit code and throws typed errors that main() prints.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "integrators/reduced_simulation.hpp"
#include "scene/scene.hpp"

namespace nsframe::app {

struct SceneArguments {
  std::filesystem::path scene;
  std::vector<std::string> set;     // "key=value"
  std::filesystem::path output;     // empty: results/<name of the scene>
  int threads = 0;                  // 0: what the scene says
  bool quiet = false;
  bool resume = false;              // go on from the checkpoint in the output folder
  bool json = false;
};

// A run that a signal stopped returns 128 + its number: interrupted for SIGINT, 143 for SIGTERM.
enum ExitCode { done = 0, defect = 1, bad_input = 2, not_converged = 3, input_output = 4, interrupted = 130 };

int run(const SceneArguments& arguments);
int check(const SceneArguments& arguments);
int modes(const SceneArguments& arguments);
int calibrate(const SceneArguments& arguments);
int buckling(const SceneArguments& arguments);
int export_matrices(const SceneArguments& arguments);
int reference();
struct SectionArguments;  // section.hpp
int section(const SectionArguments& arguments);

// A scene read, validated and built; throws InputError with every error of the file and of the model.
struct LoadedScene {
  Scene scene;
  Model model;
};
LoadedScene load(const SceneArguments& arguments);
// The same with supports held that a motion moves relative to the base: for what happens at rest.
LoadedScene load_at_rest(const SceneArguments& arguments);

// Where results go without -o: results/<folder of scene.toml, or name of the file>.
std::filesystem::path output_folder(const SceneArguments& arguments);

// Creates the folder and its parents; throws IoError.
void make_folder(const std::filesystem::path& folder);
void write_text(const std::filesystem::path& file, const std::string& text);

}  // namespace nsframe::app
