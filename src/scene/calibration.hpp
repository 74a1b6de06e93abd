// [calibration] with its keys resolved: parameters as numbers in SI, and scenes at other values of them.
#pragma once

#include "base/types.hpp"
#include "scene/scene.hpp"

namespace nsframe {

struct SceneParameter {
  std::string name;
  std::vector<std::string> keys;
  bool scales = false;
  double start = 0, lower = 0, upper = 0;  // in `unit`, of SI
  std::string unit;                        // empty: a plain number
};

// Reports keys that don't exist, bounds and starts that don't fit them, keys given twice, and targets whose structure or nodes
// don't exist. The scene's model must be described.
std::vector<SceneParameter> calibration_parameters(const Scene& scene, Diagnostics& diagnostics);
void check_calibration(const Scene& scene, Diagnostics& diagnostics);

// Sets the scene's numbers to `values` of its parameters; parameters that scale do so from the numbers of `scene`. The model
// is not described anew.
void set_parameters(const std::vector<SceneParameter>& parameters, const VectorX& values, SceneTables& tables);

// The model alone at values of the parameters: no motions, contacts, stages.
class ParametricModel {
 public:
  explicit ParametricModel(const Scene& scene, std::vector<SceneParameter> parameters);
  // Throws InputError where a section or law is not possible with these values.
  ModelDescription operator()(const VectorX& values) const;

 private:
  Scene scene_;
  std::vector<SceneParameter> parameters_;
};

}  // namespace nsframe
