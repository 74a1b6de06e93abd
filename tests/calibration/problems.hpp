// Calibration problems for tests: of the example, and of masses on springs.
#pragma once

#include <doctest/doctest.h>

#include <cmath>

#include "calibration/calibrate.hpp"
#include "scene/calibration.hpp"
#include "scene/tables.hpp"
#include "tests/support/small_models.hpp"

namespace nsframe::test {

inline Scene calibration_scene(const std::vector<std::string>& overrides = {}) {
  Diagnostics diagnostics;
  Scene scene = read_scene(std::string(NSFRAME_SOURCE_DIR) + "/examples/calibration/scene.toml", overrides, diagnostics);
  diagnostics.throw_if_any();
  return scene;
}

// The parameters and targets of one structure of the example.
inline CalibrationProblem example_problem(const Scene& scene, const std::string& structure) {
  Diagnostics diagnostics;
  std::vector<SceneParameter> parameters = calibration_parameters(scene, diagnostics);
  diagnostics.throw_if_any();
  const std::string suffix = structure == "left" ? "_l" : "_r";
  std::erase_if(parameters, [&](const SceneParameter& p) { return p.name.find(suffix) == std::string::npos; });
  CalibrationProblem problem;
  for (const SceneParameter& p : parameters) problem.parameters.push_back({p.name, p.start, p.lower, p.upper, p.unit, p.keys.front()});
  for (const CalibrationTargetTable& t : scene.tables.calibration->targets)
    if (t.structure.name == structure) problem.targets.push_back({t.at, structure, t.mode->name, t.frequency, t.weight, {}});
  problem.model = ParametricModel(scene, parameters);
  return problem;
}

inline VectorX starts(const CalibrationProblem& problem) {
  VectorX out(static_cast<Eigen::Index>(problem.parameters.size()));
  for (std::size_t i = 0; i < problem.parameters.size(); ++i) out[static_cast<Eigen::Index>(i)] = problem.parameters[i].start;
  return out;
}

// Frequencies of the targets by the names of modes, from a model built anew [Hz].
inline VectorX frequencies(const CalibrationProblem& problem, const VectorX& values) {
  const Identification found = identify(problem, resting_model(problem.model(values)));
  VectorX out(static_cast<Eigen::Index>(problem.targets.size()));
  for (std::size_t i = 0; i < problem.targets.size(); ++i)
    out[static_cast<Eigen::Index>(i)] = found.modes[found.targets[i].structure].circular_frequency[found.targets[i].mode] / (2 * pi);
  return out;
}

// Masses of 1000 kg at one place, free along x (and y): springs of `stiffness` to the ground along x (of `lateral` along y), springs
// `coupling` along x from each to the next [N/m].
inline ModelDescription masses_on_springs(const std::vector<double>& stiffness, double coupling = 0, double lateral = 0) {
  ModelDescription d;
  StructureDescription s;
  s.name = "a";
  s.at = at(1);
  for (std::size_t i = 0; i < stiffness.size(); ++i) {
    const std::string id = std::to_string(i + 1);
    s.nodes.push_back(node(id, 0, 0, 0));
    s.supports.push_back(fixed(id, {false, lateral == 0, true, true, true, true}));
    s.masses.push_back(mass(id, 1000));
    Vector6 k = Vector6::Zero();
    k[0] = stiffness[i];
    k[1] = lateral;
    s.springs.push_back(ground_spring("k" + id, id, k));
    if (i == 0) continue;
    k = Vector6::Zero();
    k[0] = coupling;
    s.springs.push_back(ground_spring("c" + id, std::to_string(i), k));
    s.springs.back().node_j = Reference{id, {}};
  }
  d.structures = {s};
  return d;
}

inline double frequency_of(double stiffness, double mass = 1000) { return std::sqrt(stiffness / mass) / (2 * pi); }
inline double stiffness_of(double frequency, double mass = 1000) { return mass * std::pow(2 * pi * frequency, 2); }

}  // namespace nsframe::test
