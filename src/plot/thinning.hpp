// Histories with fewer points whose peaks all remain: of each of many equal parts the least and the largest value are kept.
#pragma once

#include <cstddef>
#include <vector>

namespace nsframe {

// Takes the values of `rows` rows one by one and keeps the first, the last, and the extremes of `parts` parts.
class Thinner {
 public:
  Thinner(std::size_t rows, std::size_t parts);
  // A value that isn't finite is left out.
  void add(double value);

  // What was kept, in the order of rows; at most 2 `parts` + 2.
  const std::vector<std::size_t>& rows();
  const std::vector<double>& values();

 private:
  struct Point {
    std::size_t row = 0;
    double value = 0;
  };
  void keep(const Point& point);
  void end_part();

  std::size_t total_, parts_, row_ = 0, part_ = 0;
  bool empty_ = true;  // no value in this part yet
  Point least_, largest_, last_;
  bool any_ = false;
  std::vector<std::size_t> rows_;
  std::vector<double> values_;
};

}  // namespace nsframe
