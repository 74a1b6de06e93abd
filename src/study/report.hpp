// The results of a study as table, CSV, JSON and a diagram of error against time (SVG).
#pragma once

#include <string>
#include <vector>

#include "study/axes.hpp"
#include "study/compare.hpp"

namespace nsframe {

struct StudyReference {
  std::vector<std::string> physics;  // key=value of the physical keys it is for
  std::string scheme;
  double dt = 0;                     // [s]
  double own_error = 0;              // difference to the run of twice the step [m]
  double peak = 0;                   // largest displacement [m]
  int impacts = 0, poundings = 0;
};

struct StudyRow {
  Combination settings;
  std::string scheme;
  std::string failure;               // why there are no numbers; else empty
  int reference = 0;                 // index
  double error = 0;                  // largest of the displacements [m]
  double seconds = 0;                // of the step loop, least of the repetitions
  int steps = 0, impacts = 0;
  Matches poundings;
  double added_damping = 0;          // largest of the modes that matter [-]
};

struct Study {
  std::string title;
  std::vector<StudyReference> references;
  std::vector<StudyRow> rows;
};

std::string study_text(const Study& study);
std::string study_csv(const Study& study);
std::string study_json(const Study& study);
std::string study_svg(const Study& study);  // empty when fewer than one row can be drawn on logarithmic axes

}  // namespace nsframe
