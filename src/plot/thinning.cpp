#include "plot/thinning.hpp"

#include <algorithm>
#include <cmath>

namespace nsframe {

Thinner::Thinner(std::size_t rows, std::size_t parts)
    : total_(std::max<std::size_t>(rows, 1)), parts_(std::clamp<std::size_t>(parts, 1, total_)) {}

void Thinner::keep(const Point& point) {
  if (!rows_.empty() && rows_.back() >= point.row) return;
  rows_.push_back(point.row);
  values_.push_back(point.value);
}

void Thinner::end_part() {
  if (empty_) return;
  keep(least_.row < largest_.row ? least_ : largest_);
  keep(least_.row < largest_.row ? largest_ : least_);
  empty_ = true;
}

void Thinner::add(double value) {
  const Point point{row_++, value};
  const std::size_t part = point.row * parts_ / total_;
  if (part != part_) {
    end_part();
    part_ = part;
  }
  if (!std::isfinite(value)) return;
  if (!any_) keep(point);
  any_ = true;
  if (empty_) least_ = largest_ = point;
  if (value < least_.value) least_ = point;
  if (value > largest_.value) largest_ = point;
  empty_ = false;
  last_ = point;
}

const std::vector<std::size_t>& Thinner::rows() {
  end_part();
  if (any_) keep(last_);
  return rows_;
}

const std::vector<double>& Thinner::values() {
  rows();
  return values_;
}

}  // namespace nsframe
