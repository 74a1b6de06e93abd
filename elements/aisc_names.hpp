// Dimensions that the names of AISC's hollow sections and angles say: HSS6X6X1/4 (rectangular), HSS5.000X0.250 (round),
// L4X4X1/2. Inches as whole numbers, decimals, fractions or both (3-1/2).
#pragma once

#include <optional>
#include <string_view>

namespace nsframe {

struct HollowDimensions {
  double depth = 0, width = 0;  // [m] outer; of a round one both are the diameter
  double thickness = 0;         // [m] design wall thickness: 0.93 of the nominal one, to a thousandth of an inch (ASTM A500)
  bool round = false;
};

struct AngleDimensions {
  double depth = 0, width = 0, thickness = 0;  // [m]
};

// Of a name in capitals without blanks; nothing when it is none.
std::optional<HollowDimensions> hollow_dimensions(std::string_view name);
std::optional<AngleDimensions> angle_dimensions(std::string_view name);

}  // namespace nsframe
