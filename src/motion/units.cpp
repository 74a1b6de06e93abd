#include "motion/units.hpp"

#include <algorithm>
#include <cctype>

namespace nsframe {

namespace {

struct Entry {
  AccelerationUnit unit;
  const char* name;
  double si;  // [m/s2]
};

constexpr Entry entries[]{{AccelerationUnit::g, "g", 9.80665},
                          {AccelerationUnit::metres, "m/s2", 1},
                          {AccelerationUnit::centimetres, "cm/s2", 1e-2},
                          {AccelerationUnit::millimetres, "mm/s2", 1e-3},
                          {AccelerationUnit::inches, "in/s2", 0.0254},
                          {AccelerationUnit::feet, "ft/s2", 0.3048}};

const Entry& entry(AccelerationUnit unit) {
  return *std::find_if(std::begin(entries), std::end(entries), [&](const Entry& e) { return e.unit == unit; });
}

void replace(std::string& text, std::string_view from, std::string_view to) {
  for (std::size_t at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size()))
    text.replace(at, from.size(), to);
}

}  // namespace

double in_si(AccelerationUnit unit) { return entry(unit).si; }
const char* name_of(AccelerationUnit unit) { return entry(unit).name; }

std::string known_acceleration_units() {
  std::string out;
  for (const Entry& e : entries) out += (out.empty() ? "" : ", ") + std::string(e.name);
  return out;
}

std::optional<AccelerationUnit> parse_acceleration_unit(std::string_view text) {
  std::string plain;
  for (const char c : text)
    if (!std::isspace(static_cast<unsigned char>(c)) && c != '^' && c != '*' && c != '.')
      plain += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  replace(plain, "sec", "s");
  replace(plain, "/s/s", "/s2");
  if (plain == "gal" || plain == "gals") return AccelerationUnit::centimetres;
  if (plain == "inch/s2") return AccelerationUnit::inches;
  for (const Entry& e : entries)
    if (plain == e.name) return e.unit;
  return std::nullopt;
}

}  // namespace nsframe
