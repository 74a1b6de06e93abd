// The charts of a run: histories of floors or nodes, contacts, ground and energy with their peaks, floor spectra, static stages.
#pragma once

#include <string>
#include <vector>

#include "plot/chart.hpp"
#include "report/run_folder.hpp"

namespace nsframe {

// A chart of the page says its unit beside the axis; the label of a figure names the quantity too.
struct RunChart : Chart {
  std::string unit{};
};

struct ChartGroup {
  std::string id, title, note;
  std::vector<RunChart> charts{};
};

// What is drawn, and how finely.
struct ChartChoice {
  std::vector<std::string> nodes;   // "left.25"; empty: floors
  std::vector<std::string> floors;  // "left.2": the floor above story 2; empty: the roof and others below it
  int direction = -1;               // 0, 1, 2: x, y, z only, however small; -1: those that are not negligible
  std::size_t parts = 700;          // of a history: its least and largest value of each is drawn
  bool zeros = false;               // a chart also where nothing moves
};

RunChart chart_over_time(std::string title, const std::string& quantity, const std::string& unit, double factor);
void set_unit(RunChart& chart, const std::string& quantity, const std::string& unit, double factor);

// Each is empty where the run kept nothing for it. Throws InputError for names that the run doesn't have.
std::vector<RunChart> contact_charts(const RunFolder& run, const ChartChoice& choice);  // impulses, then gaps
std::vector<RunChart> energy_charts(const RunFolder& run, const ChartChoice& choice);
std::vector<RunChart> ground_charts(const RunFolder& run, const ChartChoice& choice);
std::vector<RunChart> spectrum_charts(const RunFolder& run, const ChartChoice& choice);
std::vector<RunChart> stage_charts(const RunFolder& run);

// All groups of the page; those without charts are left out. Long histories are thinned: plot/thinning.hpp.
std::vector<ChartGroup> report_charts(const RunFolder& run);

// What could not be drawn, as sentences that say which key of the scene asks for it.
std::vector<std::string> missing_histories(const RunFolder& run);

}  // namespace nsframe
