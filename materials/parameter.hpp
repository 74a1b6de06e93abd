// What a uniaxial law says about each of its parameters: name, text, kind of quantity, range. The checks follow from
// it here, the keys of scene files in scene/schema.hpp.
#pragma once

#include <cmath>
#include <concepts>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "base/range.hpp"

namespace nsframe {

// Kinds of quantities. A law in a spring gives force [N] or [N m] by displacement [m] or [rad]: there "stress" is the
// force and "strain" the displacement.
enum class Measure { number, strain, stress };

struct Parameter {
  std::string_view name;
  std::string_view text;  // one line for the reference
  Measure measure = Measure::number;
  Range range = {};
  Presence presence = Presence::optional;
  std::string_view default_text = {};  // said in the reference instead of the law's own value
};

namespace parameter {
constexpr Parameter number(std::string_view name, std::string_view text, Range range = {}) {
  return {name, text, Measure::number, range};
}
constexpr Parameter strain(std::string_view name, std::string_view text, Range range = {}) {
  return {name, text, Measure::strain, range};
}
constexpr Parameter stress(std::string_view name, std::string_view text, Range range = {}) {
  return {name, text, Measure::stress, range};
}
constexpr Parameter required(Parameter p) {
  p.presence = Presence::required;
  return p;
}
constexpr Parameter with_default(Parameter p, std::string_view text) {
  p.default_text = text;
  return p;
}
}  // namespace parameter

template <class Law>
concept HasParameters = requires(Law law) {
  Law::visit_parameters([](const Parameter&, auto&) {}, law);
};

inline void require(bool valid, const std::string& rule) {
  if (!valid) throw std::invalid_argument(rule);
}

// Throws std::invalid_argument when the value is not finite or outside the parameter's range; the message begins with
// the parameter's name.
inline void require_in_range(const Parameter& p, double value) {
  require(p.range.contains(value) || (p.range.is_everything() && !std::isfinite(value)),
          std::string(p.name) + " " + p.range.rule());
  require(std::isfinite(value), std::string(p.name) + " must be finite");
}
template <class Value>
void require_in_range(const Parameter& p, const std::optional<Value>& value) {
  if (value) require_in_range(p, *value);
}
template <class Value>
void require_in_range(const Parameter& p, const std::vector<Value>& values) {
  for (const Value& value : values) require_in_range(p, value);
}
inline void require_in_range(const Parameter&, bool) {}

// The ranges of all parameters, then the law's own rules across parameters, if it has a check().
template <HasParameters Law>
void check_parameters_of(const Law& law) {
  Law::visit_parameters([](const Parameter& p, const auto& value) { require_in_range(p, value); }, law);
  if constexpr (requires { law.check(); }) law.check();
}

}  // namespace nsframe
