// What the schema says about one key of a scene: see schema.hpp.
#pragma once

#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "scene/quantity.hpp"

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
inline constexpr Range unit{0, 1, false, false};
inline constexpr Range below_one{-infinity, 1, false, true};
inline constexpr Range at_least_one{1, infinity, false, false};
}  // namespace range

enum class Presence { optional, required };

struct Field {
  std::string_view key;
  std::string_view text;  // one line for the reference
  Dimension dimension = {};
  Range range = {};
  Presence presence = Presence::optional;
  std::string_view default_text = {};  // said in the reference instead of the struct's own value
};

// A field without dimension and range that must be there.
constexpr Field required(std::string_view key, std::string_view text, Dimension dimension = {}, Range range = {}) {
  return {key, text, dimension, range, Presence::required, {}};
}

// The keys that the values of a row stand for, in order; schema.hpp says more.
using RowKeys = std::span<const std::string_view>;

}  // namespace nsframe
