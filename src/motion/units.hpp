// Units of acceleration that records are written in.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace nsframe {

enum class AccelerationUnit { g, metres, centimetres, millimetres, inches, feet };

double in_si(AccelerationUnit unit);         // [m/s2] of one
const char* name_of(AccelerationUnit unit);  // "g", "m/s2", "cm/s2", ...
std::string known_acceleration_units();      // "g, m/s2, cm/s2, ..."

// What a text says, in any of the usual spellings ("cm/sec^2", "CM/S/S", "gal", "m/s**2"); nothing when it is no such
// unit.
std::optional<AccelerationUnit> parse_acceleration_unit(std::string_view text);

}  // namespace nsframe
