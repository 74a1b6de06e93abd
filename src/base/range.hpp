// Intervals that numbers of the input must lie in, with the words that say so.
#pragma once

#include <limits>
#include <string>

namespace nsframe {

struct Range {
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
  bool low_open = false, high_open = false;

  bool contains(double value) const {
    return (low_open ? value > low : value >= low) && (high_open ? value < high : value <= high);
  }
  bool is_everything() const;
  std::string rule() const;      // "must lie in [0, 1]", "must be positive"
  std::string interval() const;  // "[0, 1]", "> 0"; empty for everything
};

namespace range {
inline constexpr double infinity = std::numeric_limits<double>::infinity();
inline constexpr Range any{};
inline constexpr Range positive{0, infinity, true, false};
inline constexpr Range non_negative{0, infinity, false, false};
inline constexpr Range non_positive{-infinity, 0, false, false};
inline constexpr Range unit{0, 1, false, false};
inline constexpr Range below_one{-infinity, 1, false, true};
inline constexpr Range at_least_one{1, infinity, false, false};
}  // namespace range

enum class Presence { optional, required };

}  // namespace nsframe
