#include "base/range.hpp"

#include <fmt/format.h>

#include <cmath>

namespace nsframe {

bool Range::is_everything() const { return std::isinf(low) && std::isinf(high); }

std::string Range::rule() const {
  if (std::isfinite(low) && std::isfinite(high)) return "must lie in " + interval();
  if (std::isfinite(low)) {
    if (low == 0) return low_open ? "must be positive" : "must not be negative";
    return fmt::format("must be {} {}", low_open ? "above" : "at least", low);
  }
  return fmt::format("must be {} {}", high_open ? "below" : "at most", high);
}

std::string Range::interval() const {
  if (is_everything()) return "";
  if (std::isfinite(low) && std::isfinite(high))
    return fmt::format("{}{}, {}{}", low_open ? '(' : '[', low, high, high_open ? ')' : ']');
  if (std::isfinite(low)) return fmt::format("{} {}", low_open ? ">" : "≥", low);
  return fmt::format("{} {}", high_open ? "<" : "≤", high);
}

}  // namespace nsframe
