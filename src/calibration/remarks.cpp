#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "calibration/report.hpp"

namespace nsframe {

namespace {

constexpr double unidentified = 1, poor = 0.3;  // standard errors of ln p: a factor of e, 30 %
constexpr double inseparable = 0.95;            // correlation
constexpr double changed = 0.8;                 // MAC of a mode with itself at the start

std::string quoted(const FittedParameter& p) { return fmt::format("'{}'", p.parameter.name); }

// "30 %", or "a factor of 4" where that is more than 100 %.
std::string spread(double error) {
  return error < unidentified ? fmt::format("{:.0f} %", 100 * error) : fmt::format("a factor of {:.3g}", std::exp(std::min(error, 700.0)));
}

void add_bounds(const Calibration& c, std::vector<std::string>& out) {
  for (const FittedParameter& p : c.parameters) {
    if (p.bound == Bound::none) continue;
    const bool low = p.bound == Bound::lower;
    out.push_back(fmt::format("{} stopped at its {} bound, {:g}{}: the frequencies ask for {}", quoted(p), low ? "lower" : "upper",
                              p.fitted, p.parameter.unit.empty() ? "" : " " + p.parameter.unit, low ? "less" : "more"));
  }
}

void add_unseen(const Calibration& c, std::vector<std::string>& out) {
  const std::size_t measured =
      static_cast<std::size_t>(std::count_if(c.frequencies.begin(), c.frequencies.end(), [](const auto& f) { return f.matched; }));
  if (measured < c.parameters.size())
    out.push_back(fmt::format("{} parameters cannot all follow from {} measured frequenc{}", c.parameters.size(), measured,
                              measured == 1 ? "y" : "ies"));
  for (VectorX direction : c.identifiability.unseen) {
    Eigen::Index largest = 0;
    direction.cwiseAbs().maxCoeff(&largest);
    if (direction.cwiseAbs().sum() == 1) {
      out.push_back(fmt::format("{} cannot be identified: no measured frequency depends on it, it stays at its start",
                                quoted(c.parameters[static_cast<std::size_t>(largest)])));
      continue;
    }
    direction *= 10 / direction[largest];
    std::vector<std::string> parts;
    for (Eigen::Index j = 0; j < direction.size(); ++j)
      if (std::abs(direction[j]) >= 0.5)
        parts.push_back(fmt::format("{} {:+.1f} %", quoted(c.parameters[static_cast<std::size_t>(j)]), direction[j]));
    out.push_back(
        fmt::format("cannot be identified one by one: to first order {} together change no measured frequency; other values may fit as "
                    "well",
                    fmt::join(parts, ", ")));
  }
}

void add_weak(const Calibration& c, std::vector<std::string>& out) {
  for (const FittedParameter& p : c.parameters) {
    if (!std::isfinite(p.error) || p.error < poor) continue;
    out.push_back(fmt::format("{} {}: errors of {:g} % in the frequencies mean {} in it", quoted(p),
                              p.error < unidentified ? "is poorly identified" : "cannot be identified", 100 * c.accuracy, spread(p.error)));
  }
  for (std::size_t i = 0; i < c.parameters.size(); ++i) {
    for (std::size_t j = i + 1; j < c.parameters.size(); ++j) {
      const double correlation = c.identifiability.correlation(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j));
      if (std::abs(correlation) >= inseparable)
        out.push_back(fmt::format("{} and {} can hardly be told apart: the correlation of their errors is {:.3f}", quoted(c.parameters[i]),
                                  quoted(c.parameters[j]), correlation));
    }
  }
}

void add_frequencies(const Calibration& c, std::vector<std::string>& out) {
  for (const FittedFrequency& f : c.frequencies) {
    const std::string name = fmt::format("{} of '{}'", f.mode, f.structure);
    if (!f.matched) {
      out.push_back(fmt::format(
          "unmatched: no mode of '{}' has a shape like the one measured at {:g} Hz; {}", f.structure, f.measured,
          f.name.empty() ? "none is free" : fmt::format("the nearest is {} with a MAC of {:.2f}", f.name, f.likeness.value_or(0))));
      continue;
    }
    if (std::abs(std::log(f.fitted / f.measured)) * std::sqrt(f.weight) > c.accuracy)
      out.push_back(
          fmt::format("{} stays {:+.2f} % off, more than its accuracy of {:.3g} %: these parameters cannot reach all frequencies at once, "
                      "or another start finds a better fit",
                      name, 100 * f.difference(), 100 * c.accuracy / std::sqrt(f.weight)));
    if (f.name != f.mode) out.push_back(fmt::format("the mode followed as {} is called {} at the fit", name, f.name));
    if (f.likeness_to_start < changed)
      out.push_back(fmt::format("the shape of {} changed on the way: its MAC with that at the start is {:.2f}", name, f.likeness_to_start));
    if (f.likeness && *f.likeness < changed)
      out.push_back(fmt::format("the shape of {} has a MAC of {:.2f} with the measured one", name, *f.likeness));
  }
  std::map<std::string, std::vector<std::string>> unmeasured;
  for (const UnmeasuredMode& mode : c.unmeasured)
    unmeasured[mode.structure].push_back(fmt::format("{} ({:.4g} Hz)", mode.mode, mode.frequency));
  for (const auto& [structure, modes] : unmeasured)
    out.push_back(
        fmt::format("'{}' has modes below its highest measured one without a measurement: {}", structure, fmt::join(modes, ", ")));
}

}  // namespace

std::vector<std::string> calibration_remarks(const Calibration& calibration) {
  std::vector<std::string> out;
  add_frequencies(calibration, out);
  add_bounds(calibration, out);
  add_unseen(calibration, out);
  add_weak(calibration, out);
  return out;
}

}  // namespace nsframe
