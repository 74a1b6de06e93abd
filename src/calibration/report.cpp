#include "calibration/report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <nlohmann/json.hpp>

namespace nsframe {

namespace {

const char* name_of(Bound bound) { return bound == Bound::lower ? "lower" : bound == Bound::upper ? "upper" : ""; }

// Root mean square of the relative differences of matched frequencies.
double root_mean_square(const Calibration& c, double FittedFrequency::*value) {
  double sum = 0;
  int count = 0;
  for (const FittedFrequency& f : c.frequencies) {
    if (!f.matched || !(f.*value > 0)) continue;
    sum += std::pow(f.*value / f.measured - 1, 2);
    ++count;
  }
  return count > 0 ? std::sqrt(sum / count) : 0;
}

std::string frequency_table(const Calibration& c) {
  std::string text = fmt::format("{:<12} {:<5} {:>12} {:>10} {:>10} {:>12} {:>8} {:>10}\n", "structure", "mode", "measured Hz", "start",
                                 "fitted", "difference %", "weight", "MAC");
  const FittedFrequency* worst = nullptr;
  for (const FittedFrequency& f : c.frequencies) {
    if (!f.matched) {
      text += fmt::format("{:<12} {:<5} {:>12.4f} {:>10} {:>10} {:>12} {:>8.3g} {:>10}\n", f.structure, f.mode.empty() ? "-" : f.mode,
                          f.measured, "-", "-", "unmatched", f.weight, "-");
      continue;
    }
    if (!worst || std::abs(f.difference()) > std::abs(worst->difference())) worst = &f;
    text += fmt::format("{:<12} {:<5} {:>12.4f} {:>10} {:>10.4f} {:>12.3f} {:>8.3g} {:>10.3f}\n", f.structure, f.mode, f.measured,
                        f.start > 0 ? fmt::format("{:.4f}", f.start) : "-", f.fitted, 100 * f.difference(), f.weight,
                        f.likeness.value_or(f.likeness_to_start));
  }
  text += "MAC: with the measured shape; where none is given, with the mode's shape at the start\n";
  if (worst) {
    text += fmt::format("largest difference {:.3f} % ({} of '{}'), root mean square {:.3f} % (at the start {:.3f} %)\n",
                        100 * std::abs(worst->difference()), worst->mode, worst->structure,
                        100 * root_mean_square(c, &FittedFrequency::fitted), 100 * root_mean_square(c, &FittedFrequency::start));
  }
  return text;
}

std::string parameter_table(const Calibration& c) {
  std::size_t width = 9;
  for (const FittedParameter& p : c.parameters) width = std::max(width, p.parameter.name.size());
  std::string text = fmt::format("{:<{}} {:>12} {:>12} {:<9} {:>7} {:>11} {:>11}  {}\n", "parameter", width, "start", "fitted", "unit",
                                 "error", "lower", "upper", "");
  for (const FittedParameter& p : c.parameters) {
    const std::string error = !std::isfinite(p.error) ? "-" : p.error < 1 ? fmt::format("{:.1f} %", 100 * p.error) : "> 100 %";
    text += fmt::format(
        "{:<{}} {:>12.6g} {:>12.6g} {:<9} {:>7} {:>11.4g} {:>11.4g}  {}\n", p.parameter.name, width, p.parameter.start, p.fitted,
        p.parameter.unit, error, p.parameter.lower, p.parameter.upper,
        p.bound == Bound::none ? p.parameter.meaning : fmt::format("{} (at its {} bound)", p.parameter.meaning, name_of(p.bound)));
  }
  return text + fmt::format("error: what standard errors of {:g} % of the frequencies mean; -: nothing can be said\n", 100 * c.accuracy);
}

// One block a structure, of the parameters that it depends on.
std::string sensitivity_table(const Calibration& c) {
  std::string text = "sensitivities d ln f / d ln p\n";
  std::vector<std::string> structures;
  for (const FittedFrequency& f : c.frequencies)
    if (std::find(structures.begin(), structures.end(), f.structure) == structures.end()) structures.push_back(f.structure);
  for (const std::string& structure : structures) {
    std::vector<std::size_t> columns;
    for (std::size_t j = 0; j < c.parameters.size(); ++j) {
      double largest = 0;
      for (std::size_t i = 0; i < c.frequencies.size(); ++i)
        if (c.frequencies[i].structure == structure)
          largest = std::max(largest, std::abs(c.sensitivity(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j))));
      if (largest > 1e-9) columns.push_back(j);
    }
    text += fmt::format("{:<12} {:<5}", structure, "mode");
    for (const std::size_t j : columns)
      text += fmt::format(" {:>{}}", c.parameters[j].parameter.name, std::max<std::size_t>(7, c.parameters[j].parameter.name.size()));
    text += "\n";
    for (std::size_t i = 0; i < c.frequencies.size(); ++i) {
      if (c.frequencies[i].structure != structure || !c.frequencies[i].matched) continue;
      text += fmt::format("{:<12} {:<5}", "", c.frequencies[i].mode);
      for (const std::size_t j : columns)
        text += fmt::format(" {:>{}.3f}", c.sensitivity(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) + 0.0,
                            std::max<std::size_t>(7, c.parameters[j].parameter.name.size()));
      text += "\n";
    }
  }
  text += "singular values of them, times roots of weights:";
  for (const double value : c.identifiability.singular_values) text += fmt::format(" {:.3g}", value);
  return text + "\n";
}

std::string verdict(const Calibration& c) {
  const std::string effort = fmt::format("{} iteration{}, {} step{} shortened", c.iterations, c.iterations == 1 ? "" : "s", c.rejected,
                                         c.rejected == 1 ? "" : "s");
  return c.converged ? fmt::format("converged: {}\n", effort) : fmt::format("not converged: {} ({})\n", c.reason, effort);
}

// Infinite and undefined numbers have no place in JSON.
nlohmann::json number(double value) { return std::isfinite(value) ? nlohmann::json(value) : nlohmann::json(nullptr); }

}  // namespace

std::string calibration_text(const Calibration& c) {
  std::string text = verdict(c) + "\n" + frequency_table(c) + "\n" + parameter_table(c) + "\n" + sensitivity_table(c);
  const std::vector<std::string> remarks = calibration_remarks(c);
  if (!remarks.empty()) text += "\n";
  for (const std::string& remark : remarks) text += "* " + remark + "\n";
  return text;
}

std::string calibration_json(const Calibration& c) {
  nlohmann::ordered_json json;
  json["converged"] = c.converged;
  json["reason"] = c.reason;
  json["iterations"] = c.iterations;
  json["rejected_steps"] = c.rejected;
  json["identifications"] = c.identifications;
  json["accuracy"] = c.accuracy;
  double largest = 0;
  for (const FittedFrequency& f : c.frequencies)
    if (f.matched) largest = std::max(largest, std::abs(f.difference()));
  json["largest_difference"] = largest;
  json["root_mean_square"] = root_mean_square(c, &FittedFrequency::fitted);
  json["root_mean_square_at_start"] = root_mean_square(c, &FittedFrequency::start);
  json["frequencies"] = nlohmann::ordered_json::array();
  for (std::size_t i = 0; i < c.frequencies.size(); ++i) {
    const FittedFrequency& f = c.frequencies[i];
    nlohmann::ordered_json one{
        {"structure", f.structure}, {"mode", f.mode}, {"measured", f.measured}, {"weight", f.weight}, {"matched", f.matched}};
    if (f.matched) {
      one["start"] = f.start;
      one["fitted"] = f.fitted;
      one["difference"] = f.difference();
      one["name_at_fit"] = f.name;
      one["mac_with_start"] = f.likeness_to_start;
      one["sensitivity"] = nlohmann::ordered_json::object();
      for (std::size_t j = 0; j < c.parameters.size(); ++j)
        one["sensitivity"][c.parameters[j].parameter.name] = c.sensitivity(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j));
    }
    if (f.likeness) one["mac_with_measured"] = *f.likeness;
    json["frequencies"].push_back(std::move(one));
  }
  json["parameters"] = nlohmann::ordered_json::array();
  for (const FittedParameter& p : c.parameters) {
    json["parameters"].push_back({{"name", p.parameter.name},
                                  {"meaning", p.parameter.meaning},
                                  {"unit", p.parameter.unit},
                                  {"start", p.parameter.start},
                                  {"fitted", p.fitted},
                                  {"lower", p.parameter.lower},
                                  {"upper", p.parameter.upper},
                                  {"at_bound", p.bound == Bound::none ? nlohmann::json(nullptr) : nlohmann::json(name_of(p.bound))},
                                  {"relative_error", number(p.error)}});
  }
  json["singular_values"] = std::vector<double>(c.identifiability.singular_values.begin(), c.identifiability.singular_values.end());
  json["unmeasured_modes"] = nlohmann::ordered_json::array();
  for (const UnmeasuredMode& mode : c.unmeasured)
    json["unmeasured_modes"].push_back({{"structure", mode.structure}, {"mode", mode.mode}, {"frequency", mode.frequency}});
  json["remarks"] = calibration_remarks(c);
  return json.dump(2) + "\n";
}

}  // namespace nsframe
