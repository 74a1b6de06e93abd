// What a calibration is given: parameters with bounds, measured frequencies, and the model at any values of the parameters.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "models/model.hpp"

namespace nsframe {

// All positive: the fit works on the logarithms.
struct CalibrationParameter {
  std::string name;
  double start = 1, lower = 0, upper = 0;
  std::string unit;     // empty: a plain number
  std::string meaning;  // what it is in the scene, for reports
};

struct ShapeOrdinate {
  std::string node;  // within the structure
  int dof = 0;       // 0..5
  double value = 0;
};

struct CalibrationTarget {
  Location at;
  std::string structure;
  std::string mode;                  // L1, T2, ...; empty: by the shape alone
  double frequency = 0;              // [Hz]
  double weight = 1;
  std::vector<ShapeOrdinate> shape;  // measured; empty: by the name alone
};

struct CalibrationProblem {
  std::vector<CalibrationParameter> parameters;
  std::vector<CalibrationTarget> targets;
  double accuracy = 0.01;  // relative standard error of a frequency of weight 1
  int max_iterations = 50;
  // Throws InputError where the values make no model.
  std::function<ModelDescription(const VectorX& values)> model;
};

}  // namespace nsframe
