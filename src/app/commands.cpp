#include "app/commands.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>

#include "base/errors.hpp"
#include "integrators/algorithms.hpp"
#include "integrators/flight_method.hpp"
#include "models/fiber_selection.hpp"

namespace nsframe::app {

LoadedScene load(const SceneArguments& arguments) {
  Diagnostics diagnostics;
  LoadedScene loaded;
  loaded.scene = read_scene(arguments.scene, arguments.set, diagnostics);
  const auto place_of = [&](const char* key) {
    const auto place = loaded.scene.places.find(key);
    return place == loaded.scene.places.end() ? Location{} : place->second;
  };
  const std::vector<std::string> schemes = scheme_names();
  const std::string& scheme = loaded.scene.analysis.scheme;
  if (std::find(schemes.begin(), schemes.end(), scheme) == schemes.end()) {
    diagnostics.error(place_of("analysis.scheme"),
                      fmt::format("scheme '{}' is not known{}", scheme, did_you_mean(scheme, schemes)));
  }
  const AnalysisOptions& analysis = loaded.scene.analysis;
  const std::vector<std::string> integrators = flight_method_names();
  if (std::find(integrators.begin(), integrators.end(), analysis.integrator) == integrators.end()) {
    diagnostics.error(place_of("analysis.integrator"),
                      fmt::format("integrator '{}' is not known{}", analysis.integrator, did_you_mean(analysis.integrator, integrators)));
  }
  if (analysis.integrator == "alpha-os" && analysis.rho_infinity < least_rho_of_alpha_os) {
    diagnostics.error(place_of("analysis.rho_infinity"), fmt::format("rho_infinity = {:g}, must lie in [{:g}, 1] for integrator \"alpha-os\"",
                                                                     analysis.rho_infinity, least_rho_of_alpha_os));
  }
  const std::vector<std::string> algorithms = algorithm_choices();
  for (const std::string& algorithm : loaded.scene.analysis.algorithm) {
    const Location at = place_of("analysis.algorithm");
    if (std::find(algorithms.begin(), algorithms.end(), algorithm) == algorithms.end()) {
      diagnostics.error(at, fmt::format("algorithm '{}' is not known{}", algorithm, did_you_mean(algorithm, algorithms)));
    } else if (algorithm == "auto" && loaded.scene.analysis.algorithm.size() > 1) {
      diagnostics.error(at, "algorithm \"auto\" stands alone");
    }
  }
  if (arguments.threads > 0) loaded.scene.analysis.threads = arguments.threads;
  loaded.model = build_model(loaded.scene.model, diagnostics);
  std::vector<std::string> faults;
  choose_fibers(loaded.model, loaded.scene.output.fibers, faults);
  for (const std::string& fault : faults) diagnostics.error(loaded.scene.places.at("output.fibers"), fault);
  diagnostics.throw_if_any();
  return loaded;
}

LoadedScene load_at_rest(const SceneArguments& arguments) {
  LoadedScene loaded = load(arguments);
  loaded.model = held_supports(std::move(loaded.model));
  return loaded;
}

std::filesystem::path output_folder(const SceneArguments& arguments) {
  if (!arguments.output.empty()) return arguments.output;
  const std::filesystem::path file = std::filesystem::absolute(arguments.scene);
  const bool in_its_folder = file.filename() == "scene.toml";
  return std::filesystem::path("results") / (in_its_folder ? file.parent_path().filename() : file.stem());
}

void make_folder(const std::filesystem::path& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) throw IoError(fmt::format("error: cannot create folder '{}': {}", folder.string(), error.message()));
}

void write_text(const std::filesystem::path& file, const std::string& text) {
  std::ofstream stream(file, std::ios::binary);
  stream << text;
  stream.close();
  if (!stream) throw IoError(fmt::format("error: cannot write '{}'", file.string()));
}

}  // namespace nsframe::app
