// What a run's scheme did to its motion at this step, as sentences: of the summary alone, without the model.
#pragma once

#include <string>
#include <vector>

#include "models/results.hpp"

namespace nsframe {

inline constexpr double undamped = 1e-9;  // damping ratios below are rounding

// Modes whose damping the scene sets, or with more than 5 % of the mass in one direction below 30 Hz; all when there
// are none.
std::vector<ModeNumerics> modes_that_matter(const Summary& summary);

// Sentences about the errors of the scheme itself at this step: modes that it damps or shifts beyond what was asked
// for, an energy balance or a contact solution that does not close.
std::vector<std::string> numerical_warnings(const Summary& summary);

}  // namespace nsframe
