// An axis of a chart: the range it shows, the places of its ticks, their labels.
#pragma once

#include <string>
#include <vector>

namespace nsframe {

struct Tick {
  double value;
  bool labelled;
};

class Axis {
 public:
  // A linear axis ends at ticks, or where the data do if `tight`; a logarithmic one, of positive data, at decades.
  Axis(bool logarithmic, bool tight, double least, double most);

  double place(double value) const;  // from 0 at the begin to 1 at the end
  std::vector<Tick> ticks() const;
  std::string label(double value) const;  // as text of SVG

 private:
  bool log_;
  double first_ = 0, last_ = 1, step_ = 1, tick_ = 0;  // decades, or values; tick_: the first of a linear axis
};

}  // namespace nsframe
