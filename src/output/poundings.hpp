// From impacts, which a time-stepping scheme lists one a step, to poundings, which a test records.
#pragma once

#include <vector>

#include "models/results.hpp"

namespace nsframe {

inline constexpr double pounding_window = 0.020;  // [s]

// Merges impacts of one pair that follow each other by less than `window` [s]; sorted by the time of the first one.
// `impacts` are in the order of time.
std::vector<Pounding> merge_impacts(const std::vector<Impact>& impacts, double window = pounding_window);

}  // namespace nsframe
