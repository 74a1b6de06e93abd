#include "study/axes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "base/diagnostics.hpp"
#include "base/errors.hpp"

namespace nsframe {

namespace {

const std::map<std::string, std::string>& short_names() {
  static const std::map<std::string, std::string> names{
      {"dt", "analysis.dt"},       {"scheme", "analysis.scheme"},           {"theta", "analysis.theta"},
      {"gamma", "analysis.gamma"}, {"restitution", "contact.restitution"}, {"pga", "motion.pga"},
      {"duration", "analysis.duration"}};
  return names;
}

// Commas between brackets or quotes belong to a value.
std::vector<std::string> parts(const std::string& text) {
  std::vector<std::string> out(1);
  int depth = 0;
  bool quoted = false;
  for (const char c : text) {
    if (c == '"') quoted = !quoted;
    if (!quoted) depth += c == '[' || c == '{' ? 1 : c == ']' || c == '}' ? -1 : 0;
    if (c == ',' && depth == 0 && !quoted)
      out.emplace_back();
    else
      out.back() += c;
  }
  return out;
}

std::string whole_key(const std::string& name) {
  if (name.find('.') != std::string::npos) return name;
  const auto found = short_names().find(name);
  if (found != short_names().end()) return found->second;
  std::vector<std::string> known;
  for (const auto& entry : short_names()) known.push_back(entry.first);
  throw InputError(fmt::format("error: --vary: '{}' is not a key{}; other keys are written whole, as contact.gap", name,
                               did_you_mean(name, known)));
}

}  // namespace

bool StudyAxis::physical() const { return !key.starts_with("analysis.") || key == "analysis.duration"; }

std::vector<StudyAxis> parse_axes(const std::vector<std::string>& texts) {
  std::vector<StudyAxis> axes;
  for (const std::string& text : texts) {
    bool first = true;
    for (const std::string& part : parts(text)) {
      // a value may hold '=' only inside an inline table or quotes
      const std::size_t equals = part.find('=');
      const bool begins = equals != std::string::npos && equals > 0 && part.find_first_of("\"{[") > equals;
      if (first && !begins) throw InputError(fmt::format("error: --vary {}: must be written as key=value,value,...", text));
      if (begins) {
        const std::string key = whole_key(part.substr(0, equals));
        if (std::any_of(axes.begin(), axes.end(), [&](const StudyAxis& axis) { return axis.key == key; }))
          throw InputError(fmt::format("error: --vary: {} is given twice", key));
        axes.push_back({key, {part.substr(equals + 1)}});
      } else {
        axes.back().values.push_back(part);
      }
      first = false;
      if (axes.back().values.back().empty())
        throw InputError(fmt::format("error: --vary: {} has an empty value", axes.back().key));
    }
  }
  return axes;
}

std::vector<Combination> combinations(const std::vector<StudyAxis>& axes) {
  std::vector<Combination> out(1);
  for (const StudyAxis& axis : axes) {
    std::vector<Combination> longer;
    for (const Combination& start : out) {
      for (const std::string& value : axis.values) {
        longer.push_back(start);
        longer.back().push_back(axis.key + "=" + value);
      }
    }
    out = std::move(longer);
  }
  return out;
}

}  // namespace nsframe
