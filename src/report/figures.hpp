// The figures of `nsframe plot`: chosen quantities of a run, one chart below the other, or those of two runs in one.
#pragma once

#include <string>
#include <vector>

#include "report/charts.hpp"

namespace nsframe {

struct FigureChoice {
  std::vector<std::string> quantities;  // of figure_quantities(); empty: what the run has most to say about
  std::vector<std::string> sections;    // of hysteresis: "left.1", or "left.1:3" for its third integration point
  ChartChoice charts;
};

std::vector<std::string> figure_quantities();

// With the poundings as marks on time axes. Throws InputError for unknown quantities and names, and, with the key of the scene that
// keeps it, for what the run did not record.
std::vector<Chart> figure(const RunFolder& run, const FigureChoice& choice);

// Draws each of `others` with dashes into the chart of the same title. Throws InputError when a title is in one list only.
void lay_over(std::vector<Chart>& charts, const std::vector<Chart>& others, const std::string& label, const std::string& other_label);

// Force over deformation of integration points: moment and curvature about the local axis z or y, or axial force and strain. Of a name
// without a point the one with the largest range of the deformation; without names the one of the whole run. `direction`: as ChartChoice,
// the local axis; -1: the bending with the larger moments.
RunChart hysteresis_chart(const RunFolder& run, const std::vector<std::string>& sections, int direction);

}  // namespace nsframe
