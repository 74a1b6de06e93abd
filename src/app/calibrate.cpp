// nsframe calibrate: parameters of a scene fitted to measured frequencies.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "app/commands.hpp"
#include "base/errors.hpp"
#include "calibration/report.hpp"
#include "output/files.hpp"
#include "scene/calibration.hpp"
#include "scene/tables.hpp"

namespace nsframe::app {

namespace {

CalibrationProblem problem_of(const Scene& scene, const std::vector<SceneParameter>& parameters) {
  const CalibrationTable& table = *scene.tables.calibration;
  CalibrationProblem problem;
  for (const SceneParameter& p : parameters) {
    problem.parameters.push_back({p.name, p.start, p.lower, p.upper, p.unit,
                                  fmt::format("{}{}", p.scales ? "factor of " : "", fmt::join(p.keys, ", "))});
  }
  for (const CalibrationTargetTable& t : table.targets) {
    CalibrationTarget& target = problem.targets.emplace_back();
    target.at = t.mode ? t.mode->at : t.at;
    target.structure = t.structure.name;
    target.mode = t.mode ? t.mode->name : "";
    target.frequency = t.frequency;
    target.weight = t.weight;
    for (const CalibrationShapeTable& s : t.shape) target.shape.push_back({s.node.name, static_cast<int>(s.dof), s.value});
  }
  problem.accuracy = table.accuracy;
  problem.max_iterations = table.max_iterations;
  problem.model = ParametricModel(scene, parameters);
  return problem;
}

// Not where `run` leaves its results.
std::filesystem::path folder_of(const SceneArguments& arguments) {
  if (!arguments.output.empty()) return arguments.output;
  std::filesystem::path folder = output_folder(arguments);
  folder += "_calibrated";
  return folder;
}

}  // namespace

int calibrate(const SceneArguments& arguments) {
  const LoadedScene loaded = load(arguments);
  if (!loaded.scene.tables.calibration)
    throw InputError(
        fmt::format("{}: error: the scene has no [calibration]: parameters and measured frequencies", arguments.scene.string()));
  Diagnostics diagnostics;
  const std::vector<SceneParameter> parameters = calibration_parameters(loaded.scene, diagnostics);
  diagnostics.throw_if_any();
  const Calibration result = nsframe::calibrate(problem_of(loaded.scene, parameters));
  Scene fitted = loaded.scene;
  set_parameters(parameters, result.values(), fitted.tables);
  fitted.tables.calibration.reset();
  const std::filesystem::path folder = folder_of(arguments);
  make_folder(folder);
  write_text_file(folder / "calibration.json", calibration_json(result));
  write_text_file(folder / "scene.toml", write_scene(fitted, folder));
  if (!arguments.quiet) {
    fmt::print("{}\n{}\ncalibration.json and the scene with the fitted values, scene.toml, are in {}\n", loaded.scene.title,
               calibration_text(result), folder.string());
  }
  if (result.converged) return done;
  fmt::print(stderr, "error: the calibration did not converge: {}\n", result.reason);
  return not_converged;
}

}  // namespace nsframe::app
