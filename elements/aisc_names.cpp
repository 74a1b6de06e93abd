#include "elements/aisc_names.hpp"

#include <charconv>
#include <cmath>
#include <vector>

namespace nsframe {

namespace {

constexpr double inch = 0.0254;

// "3", "0.25", "1/4", "3-1/2": a positive number, or nothing.
std::optional<double> number(std::string_view text) {
  const auto decimal = [](std::string_view part) -> std::optional<double> {
    double value = 0;
    const auto [end, error] = std::from_chars(part.data(), part.data() + part.size(), value, std::chars_format::fixed);
    if (error != std::errc{} || end != part.data() + part.size() || !(value > 0) || !std::isfinite(value)) return {};
    return value;
  };
  if (const auto dash = text.find('-'); dash != std::string_view::npos) {
    const auto whole = decimal(text.substr(0, dash)), rest = number(text.substr(dash + 1));
    return whole && rest && text.find('/') != std::string_view::npos ? std::optional(*whole + *rest) : std::nullopt;
  }
  const auto slash = text.find('/');
  if (slash == std::string_view::npos) return decimal(text);
  const auto above = decimal(text.substr(0, slash)), below = decimal(text.substr(slash + 1));
  return above && below ? std::optional(*above / *below) : std::nullopt;
}

// The numbers between the X of a name that begins with `prefix`; empty when one is none.
std::vector<double> dimensions(std::string_view name, std::string_view prefix) {
  std::vector<double> out;
  if (!name.starts_with(prefix)) return out;
  name.remove_prefix(prefix.size());
  for (;;) {
    const auto cross = name.find('X');
    const auto value = number(name.substr(0, cross));
    if (!value) return {};
    out.push_back(*value * inch);
    if (cross == std::string_view::npos) return out;
    name.remove_prefix(cross + 1);
  }
}

}  // namespace

std::optional<HollowDimensions> hollow_dimensions(std::string_view name) {
  const std::vector<double> d = dimensions(name, "HSS");
  if (d.size() != 2 && d.size() != 3) return {};
  const double thousandths = std::floor(0.93 * d.back() / inch * 1000 + 0.5 + 1e-6);
  return HollowDimensions{d[0], d.size() == 3 ? d[1] : d[0], thousandths / 1000 * inch, d.size() == 2};
}

std::optional<AngleDimensions> angle_dimensions(std::string_view name) {
  const std::vector<double> d = dimensions(name, "L");
  if (d.size() != 3) return {};
  return AngleDimensions{d[0], d[1], d[2]};
}

}  // namespace nsframe
