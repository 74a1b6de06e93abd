// Charts of floors: displacement, story drift, twist, acceleration.
#pragma once

#include "report/charts.hpp"

namespace nsframe {

// `parts` of each history, as Thinner takes them. Nothing where nodes have no histories.
std::vector<ChartGroup> floor_charts(const RunFolder& run, std::size_t parts);

// Floors that are drawn, and of how many: for the number of histories in a page.
std::size_t drawn_floors(const RunFolder& run);

}  // namespace nsframe
