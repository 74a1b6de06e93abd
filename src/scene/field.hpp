// What the schema says about one key of a scene: see schema.hpp.
#pragma once

#include <span>
#include <string_view>

#include "base/range.hpp"
#include "scene/quantity.hpp"

namespace nsframe {

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
