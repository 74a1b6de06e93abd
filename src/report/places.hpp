// Where histories of a run are drawn: its floors, each the mean of its nodes, or single nodes.
#pragma once

#include <string>
#include <vector>

#include "report/run_folder.hpp"

namespace nsframe {

struct Place {
  std::string name;
  int structure = 0;
  double level = 0;                    // [m]
  std::vector<std::size_t> columns{};  // of its nodes in the histories
  int below = -1;                      // the floor below, an index into all places
  bool drawn = false;
  int colour = -1;  // as Curve has it
  double tint = 0;
};

// The nodes or the floors named ("left.2": above story 2 of left); of both lists empty, the roof of every structure and floors at even
// distances below it, or some nodes where no floor has all its nodes' histories. Floors that aren't drawn are there too. Throws
// InputError for names without histories.
std::vector<Place> places_of(const RunFolder& run, const std::vector<std::string>& nodes, const std::vector<std::string>& floors);

}  // namespace nsframe
