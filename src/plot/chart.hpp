// Charts: curves on linear or logarithmic axes, drawn as SVG alone or one below the other. The page of a run draws the same data.
#pragma once

#include <limits>
#include <string>
#include <vector>

namespace nsframe {

struct Curve {
  std::string name;              // empty: not in the legend
  std::vector<double> x{}, y{};  // on a logarithmic axis only what is positive is drawn
  bool markers = false, dashed = false;
  int colour = -1;  // place in the palette; -1: the next
  double tint = 0;  // towards white, in [0, 1]
};

struct Chart {
  std::string title, x_label, y_label;
  bool log_x = false, log_y = false;
  std::vector<Curve> curves{};
  double height = 380;                   // of the frame, in pixels
  double factor = 1;                     // from the values of the curves to the unit of the label
  bool over_time = false;                // x is the time of a run
  bool stems = false;                    // from zero to each point
  bool from_zero = false;                // the vertical axis holds zero
  bool equal = false;                    // one scale along both axes
  int direction = -1;                    // 0, 1, 2: of x, y, z only
  std::vector<double> marks{};           // triangles on the horizontal axis, of which `mark_name` says what they are
  std::string mark_name{};
  double from = std::numeric_limits<double>::quiet_NaN();  // of the horizontal axis; NaN: as the curves
  double to = std::numeric_limits<double>::quiet_NaN();
};

// What is common to the charts of a picture.
struct Sheet {
  std::string heading;        // above all charts
  int width = 0, height = 0;  // of all, in pixels; 0: as large as the charts want to be
};

// Empty when no chart has a point to draw. Throws InputError when the sheet is too small for its charts.
std::string chart_svg(const std::vector<Chart>& charts, const Sheet& sheet = {});

}  // namespace nsframe
