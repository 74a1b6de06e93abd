// A calibration as text and as JSON, and what it says in plain sentences.
#pragma once

#include <string>
#include <vector>

#include "calibration/calibrate.hpp"

namespace nsframe {

// Bounds that were reached, parameters and combinations that cannot be identified, frequencies that are not reached, modes that
// changed or are without measurement.
std::vector<std::string> calibration_remarks(const Calibration& calibration);

std::string calibration_text(const Calibration& calibration);
std::string calibration_json(const Calibration& calibration);

}  // namespace nsframe
