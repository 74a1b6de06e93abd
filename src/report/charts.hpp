// The charts of a report: histories of floors, contacts, ground and energy with their peaks, floor spectra, static stages.
#pragma once

#include <string>
#include <vector>

#include "report/run_folder.hpp"

namespace nsframe {

struct ChartSeries {
  std::string name;
  int structure = -1;            // whose colour it has; -1: the next of the palette
  double tint = 0;               // towards white, in [0, 1]
  std::vector<double> x{}, y{};  // SI
};

struct ReportChart {
  std::string title, unit, x_label;
  double factor = 1;  // from SI to `unit`
  bool over_time = false, log_x = false, stems = false, from_zero = false;
  std::vector<ChartSeries> series{};
};

struct ChartGroup {
  std::string id, title, note;
  std::vector<ReportChart> charts;
};

// Groups without charts are left out. Long histories are thinned: report/thinning.hpp.
std::vector<ChartGroup> report_charts(const RunFolder& run);

// What could not be drawn, as sentences that say which key of the scene asks for it.
std::vector<std::string> missing_histories(const RunFolder& run);

}  // namespace nsframe
