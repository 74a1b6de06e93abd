// Parameters of a model fitted to measured frequencies by least squares of their logarithms.
#pragma once

#include "calibration/identifiability.hpp"
#include "calibration/mode_tracking.hpp"

namespace nsframe {

struct FittedFrequency {
  std::string structure, mode;  // its name at the start
  double measured = 0, start = 0, fitted = 0, weight = 1;  // [Hz]
  bool matched = false;                  // a mode of the model belongs to it
  double likeness_to_start = 0;          // MAC of the shapes at the start and at the fit
  std::optional<double> likeness;        // MAC with the measured shape, at the fit
  std::string name;                      // of the mode at the fit
  double difference() const { return fitted / measured - 1; }
};

enum class Bound { none, lower, upper };

struct FittedParameter {
  CalibrationParameter parameter;
  double fitted = 0;
  Bound bound = Bound::none;  // where it stopped
  double error = 0;           // standard error of its logarithm, by the accuracy of the frequencies
};

struct UnmeasuredMode {
  std::string structure, mode;
  double frequency = 0;  // [Hz]
};

struct Calibration {
  std::vector<FittedParameter> parameters;
  std::vector<FittedFrequency> frequencies;
  MatrixX sensitivity;                // d ln f / d ln p at the fit, matched frequencies by parameters; rows of others are 0
  Identifiability identifiability;    // of the matched frequencies
  std::vector<UnmeasuredMode> unmeasured;  // below the highest measured one, at the fit
  double accuracy = 0;
  int iterations = 0, rejected = 0, identifications = 0;
  bool converged = false;
  std::string reason;                 // why not, when not
  VectorX values() const;             // fitted
};

// Fits. Modes are named at the start, followed by their shapes, and named again at the end; where that changes which mode belongs to a
// frequency, the fit goes on with the new ones. Throws InputError (a start that makes no model, an unknown mode) or ConvergenceError
// (no rest under gravity at the start).
Calibration calibrate(const CalibrationProblem& problem);

// d ln f / d ln p of modes already identified, rows of targets without mode 0.
MatrixX frequency_sensitivity(const CalibrationProblem& problem, const VectorX& values, const Identification& modes);

}  // namespace nsframe
