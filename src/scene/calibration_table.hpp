// [calibration] of a scene: which of its numbers are fitted to which measured frequencies. calibration.hpp resolves it.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "base/diagnostics.hpp"

namespace nsframe {

enum class Dof;

// A number whose dimension is that of the scene key it is meant for: bare in SI, or a text with a unit.
struct KeyQuantity {
  double number = 0;
  std::string text;  // empty for a bare number
  Location at;
};

struct CalibrationParameterTable {
  Location at;
  Reference name;
  std::vector<Reference> sets, scales;  // keys of the scene; one of the two
  std::array<KeyQuantity, 2> bounds;
  std::optional<KeyQuantity> start;
};

struct CalibrationShapeTable {
  Reference node;  // of the target's structure
  Dof dof{};
  double value = 0;
};

struct CalibrationTargetTable {
  Location at;
  Reference structure;
  std::optional<Reference> mode;  // L1, T2, ...
  double frequency = 0;           // [Hz]
  double weight = 1;
  std::vector<CalibrationShapeTable> shape;
};

struct CalibrationTable {
  Location at;
  std::vector<CalibrationParameterTable> parameters;
  std::vector<CalibrationTargetTable> targets;
  double accuracy = 0.01;
  int max_iterations = 50;
};

}  // namespace nsframe
