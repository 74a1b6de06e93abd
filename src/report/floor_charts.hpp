// Charts of floors and nodes: displacement, velocity, story drift, twist, acceleration, orbit.
#pragma once

#include "report/charts.hpp"

namespace nsframe {

// One group for each of `quantities` ("displacement", "velocity", "drift", "twist", "acceleration", "orbit"), in this order; without charts
// where nodes have no histories or nothing moves. Throws InputError for nodes and floors without histories.
std::vector<ChartGroup> floor_charts(const RunFolder& run, const std::vector<std::string>& quantities, const ChartChoice& choice);

// Floors that are drawn, and of how many: for the number of histories in a page.
std::size_t drawn_floors(const RunFolder& run);

}  // namespace nsframe
