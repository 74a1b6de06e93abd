#include "scene/quantity.hpp"

#include <fmt/format.h>

#include <array>
#include <charconv>
#include <cmath>
#include <vector>

#include "base/diagnostics.hpp"
#include "base/types.hpp"

namespace nsframe {

namespace {

struct Unit {
  std::string_view name;
  double factor, divisor;  // to SI: value * factor / divisor, so that "5.5 cm" has the bits of 0.055
  Dimension dimension;
};

constexpr std::array units{
    Unit{"m", 1, 1, dimension::length},
    Unit{"cm", 1, 100, dimension::length},
    Unit{"mm", 1, 1000, dimension::length},
    Unit{"km", 1e3, 1, dimension::length},
    Unit{"in", 0.0254, 1, dimension::length},
    Unit{"ft", 0.3048, 1, dimension::length},
    Unit{"kg", 1, 1, dimension::mass},
    Unit{"t", 1e3, 1, dimension::mass},
    Unit{"s", 1, 1, dimension::time},
    Unit{"ms", 1, 1000, dimension::time},
    Unit{"us", 1, 1e6, dimension::time},
    Unit{"min", 60, 1, dimension::time},
    Unit{"Hz", 1, 1, dimension::frequency},
    Unit{"kHz", 1e3, 1, dimension::frequency},
    Unit{"rad", 1, 1, dimension::angle},
    Unit{"deg", pi, 180, dimension::angle},
    Unit{"g", 9.80665, 1, dimension::acceleration},  // standard gravity, ISO 80000-3
    Unit{"Gal", 1, 100, dimension::acceleration},
    Unit{"N", 1, 1, dimension::force},
    Unit{"kN", 1e3, 1, dimension::force},
    Unit{"MN", 1e6, 1, dimension::force},
    Unit{"kip", 4448.2216152605, 1, dimension::force},
    Unit{"Pa", 1, 1, dimension::stress},
    Unit{"kPa", 1e3, 1, dimension::stress},
    Unit{"MPa", 1e6, 1, dimension::stress},
    Unit{"GPa", 1e9, 1, dimension::stress},
    Unit{"ksi", 6894757.2931684, 1, dimension::stress},
    Unit{"%", 1, 100, dimension::none},
};

struct NamedDimension {
  Dimension dimension;
  std::string_view name, unit;
};

constexpr std::array named_dimensions{
    NamedDimension{dimension::none, "a plain number", ""},
    NamedDimension{dimension::length, "a length", "m"},
    NamedDimension{dimension::area, "an area", "m2"},
    NamedDimension{dimension::fourth_power_of_length, "a second moment of area", "m4"},
    NamedDimension{dimension::mass, "a mass", "kg"},
    NamedDimension{dimension::mass_per_length, "a mass per length", "kg/m"},
    NamedDimension{dimension::density, "a density", "kg/m3"},
    NamedDimension{dimension::inertia, "a rotational inertia", "kg m2"},
    NamedDimension{dimension::time, "a time", "s"},
    NamedDimension{dimension::frequency, "a frequency", "Hz"},
    NamedDimension{dimension::angle, "an angle", "rad"},
    NamedDimension{dimension::velocity, "a velocity", "m/s"},
    NamedDimension{dimension::angular_velocity, "an angular velocity", "rad/s"},
    NamedDimension{dimension::acceleration, "an acceleration", "m/s2"},
    NamedDimension{dimension::force, "a force", "N"},
    NamedDimension{dimension::stress, "a stress", "Pa"},
    NamedDimension{dimension::stiffness, "a stiffness", "N/m"},
    NamedDimension{dimension::rotational_stiffness, "a rotational stiffness", "N m/rad"},
    NamedDimension{dimension::dashpot, "a dashpot constant", "N s/m"},
    NamedDimension{dimension::rotational_dashpot, "a rotational dashpot constant", "N m s/rad"},
    NamedDimension{dimension::bending_stiffness, "a torsional or bending stiffness of a section", "N m2"},
    NamedDimension{{2, 1, -2, 0}, "a moment", "N m"},
};

Dimension times_power(Dimension a, const Dimension& b, int power) {
  a.length += power * b.length;
  a.mass += power * b.mass;
  a.time += power * b.time;
  a.angle += power * b.angle;
  return a;
}

const Unit& find_unit(std::string_view name) {
  std::vector<std::string> names;
  for (const Unit& unit : units) {
    if (unit.name == name) return unit;
    names.emplace_back(unit.name);
  }
  throw QuantityError(fmt::format(": unknown unit '{}'{}", name, did_you_mean(name, names)));
}

bool is_blank(char c) { return c == ' ' || c == '\t' || c == '*'; }
bool is_power_character(char c) { return (c >= '0' && c <= '9') || c == '-' || c == '^'; }

struct UnitProduct {
  double factor = 1, divisor = 1;
  Dimension dimension;
};

// Reads one factor ("m2", "s^-1") from the front of `text` and multiplies it into `product`.
void take_factor(std::string_view& text, int sign, UnitProduct& product) {
  std::size_t name_end = 0;
  while (name_end < text.size() && !is_blank(text[name_end]) && text[name_end] != '/' &&
         !is_power_character(text[name_end]))
    ++name_end;
  std::size_t end = name_end;
  while (end < text.size() && is_power_character(text[end])) ++end;
  const Unit& unit = find_unit(text.substr(0, name_end));
  std::string_view digits = text.substr(name_end, end - name_end);
  if (!digits.empty() && digits.front() == '^') digits.remove_prefix(1);
  int power = 1;
  if (end > name_end) {
    const auto [stop, code] = std::from_chars(digits.data(), digits.data() + digits.size(), power);
    if (code != std::errc{} || stop != digits.data() + digits.size() || std::abs(power) > 12)
      throw QuantityError(fmt::format(": '{}' is not a power of a unit", text.substr(0, end)));
  }
  power *= sign;
  const double factor = std::pow(unit.factor, std::abs(power)), divisor = std::pow(unit.divisor, std::abs(power));
  product.factor *= power > 0 ? factor : divisor;
  product.divisor *= power > 0 ? divisor : factor;
  product.dimension = times_power(product.dimension, unit.dimension, power);
  text.remove_prefix(end);
}

std::string_view trim(std::string_view text) {
  while (!text.empty() && is_blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && is_blank(text.back())) text.remove_suffix(1);
  return text;
}

bool is_angle_omitted(const Dimension& given, const Dimension& wanted) {
  return given.angle == 0 && Dimension{given.length, given.mass, given.time, wanted.angle} == wanted;
}

}  // namespace

Quantity parse_quantity(std::string_view text) {
  text = trim(text);
  if (!text.empty() && text.front() == '+') text.remove_prefix(1);
  Quantity result;
  const auto [end, code] = std::from_chars(text.data(), text.data() + text.size(), result.value);
  if (code == std::errc::result_out_of_range) throw QuantityError(": the number is too large or too small");
  if (code != std::errc{}) throw QuantityError(": not a number with a unit");
  if (!std::isfinite(result.value)) throw QuantityError(", must be a finite number");
  text.remove_prefix(static_cast<std::size_t>(end - text.data()));
  if (!text.empty() && text.front() == ',')
    throw QuantityError(": not a number with a unit (write decimals with a point)");
  UnitProduct unit;
  int sign = 1;
  for (text = trim(text); !text.empty(); text = trim(text)) {
    if (text.front() == '/') {
      if (sign < 0) throw QuantityError(": two '/' in a row");
      sign = -1;
      text.remove_prefix(1);
      continue;
    }
    take_factor(text, sign, unit);
    sign = 1;
  }
  if (sign < 0) throw QuantityError(": the unit ends with '/'");
  result.value = result.value * unit.factor / unit.divisor;
  result.dimension = unit.dimension;
  if (!std::isfinite(result.value)) throw QuantityError(", must be a finite number");
  return result;
}

double parse_quantity(std::string_view text, const Dimension& wanted) {
  const Quantity quantity = parse_quantity(text);
  if (quantity.dimension == wanted || is_angle_omitted(quantity.dimension, wanted)) return quantity.value;
  if (quantity.dimension == dimension::none)
    throw QuantityError(
        fmt::format(" has no unit; write {} in {}, or a bare number", dimension_name(wanted), si_unit(wanted)));
  const std::string unit = si_unit(wanted);
  throw QuantityError(fmt::format(" is {}, must be {}{}", dimension_name(quantity.dimension), dimension_name(wanted),
                                  unit.empty() ? "" : " (" + unit + ")"));
}

std::string si_unit(const Dimension& dimension) {
  for (const NamedDimension& named : named_dimensions)
    if (named.dimension == dimension) return std::string(named.unit);
  std::string text;
  const auto append = [&text](std::string_view symbol, int power) {
    if (power == 0) return;
    text += text.empty() ? "" : " ";
    text += symbol;
    if (power != 1) text += std::to_string(power);
  };
  append("m", dimension.length);
  append("kg", dimension.mass);
  append("s", dimension.time);
  append("rad", dimension.angle);
  return text;
}

std::string dimension_name(const Dimension& dimension) {
  for (const NamedDimension& named : named_dimensions)
    if (named.dimension == dimension) return std::string(named.name);
  return "in " + si_unit(dimension);
}

}  // namespace nsframe
