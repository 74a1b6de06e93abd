// Curves on linear or logarithmic axes as SVG, alone or one below the other.
#pragma once

#include <string>
#include <vector>

namespace nsframe {

struct Curve {
  std::string name;          // empty: not in the legend
  std::vector<double> x, y;  // on a logarithmic axis only what is positive is drawn
  bool markers = false, dashed = false;
};

struct Chart {
  std::string title, x_label, y_label;
  bool log_x = false, log_y = false;
  std::vector<Curve> curves;
  double height = 380;  // of the frame, in pixels
};

// Empty when no chart has a point to draw.
std::string chart_svg(const std::vector<Chart>& charts);

}  // namespace nsframe
