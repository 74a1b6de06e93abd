#include "report/charts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <string_view>

#include "base/diagnostics.hpp"
#include "base/errors.hpp"
#include "plot/thinning.hpp"
#include "report/floor_charts.hpp"

namespace nsframe {
namespace {

constexpr std::size_t most_pairs = 6, most_spectra = 8, other_series = 15;
constexpr double all_parts = 42000;  // of all histories of a page: two points of about 20 bytes each
constexpr std::array<const char*, 3> axis{"x", "y", "z"};

// Every `stride`-th number of the rows of a history, from `first` of a row, thinned.
Curve thinned(const std::string& name, const RunFolder& run, const std::vector<double>& values, std::size_t first, std::size_t stride,
              std::size_t parts) {
  const std::size_t rows = run.time.size();
  Thinner thinner(rows, parts);
  for (std::size_t row = 0; row < rows && row * stride + first < values.size(); ++row) thinner.add(values[row * stride + first]);
  Curve curve{name, {}, thinner.values()};
  for (const std::size_t row : thinner.rows()) curve.x.push_back(run.time[row]);
  return curve;
}

std::vector<double> history(const RunFolder& run, const std::string& name) {
  std::vector<double> values;
  run.read_rows(name, 0, run.time.size(), values);
  return values;
}

double largest(const Curve& curve) {
  double value = 0;
  for (const double y : curve.y) value = std::max(value, std::abs(y));
  return value;
}

// Pairs by their names, the strongest poundings first.
std::vector<std::size_t> strongest_pairs(const RunFolder& run) {
  const auto names = run.summary.at("pairs").get<std::vector<std::string>>();
  std::map<std::string, double> impulse;
  for (const auto& pounding : run.summary.at("poundings"))
    impulse[pounding.at("pair").get<std::string>()] += pounding.at("impulse").get<double>();
  std::vector<std::size_t> order(names.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return impulse[names[a]] > impulse[names[b]]; });
  order.resize(std::min(order.size(), most_pairs));
  std::sort(order.begin(), order.end());
  return order;
}

RunChart gap_chart(const RunFolder& run, const std::vector<std::string>& names, const std::vector<std::size_t>& order, std::size_t parts) {
  RunChart gaps = chart_over_time("Gap", "gap", "mm", 1e3);
  gaps.from_zero = true;
  const std::size_t rows = run.time.size(), width = names.size(), block = std::max<std::size_t>(1, (1U << 19U) / width);
  std::vector<Thinner> thinners(order.size(), Thinner(rows, parts));
  std::vector<double> values;
  for (std::size_t first = 0; first < rows; first += block) {
    const std::size_t count = std::min(block, rows - first);
    run.read_rows("/contacts/gap", first, count, values);
    for (std::size_t i = 0; i < count; ++i) {
      for (std::size_t k = 0; k < order.size(); ++k) thinners[k].add(values[i * width + order[k]]);
    }
  }
  for (std::size_t k = 0; k < order.size(); ++k) {
    Curve curve{names[order[k]], {}, thinners[k].values()};
    for (const std::size_t row : thinners[k].rows()) curve.x.push_back(run.time[row]);
    gaps.curves.push_back(std::move(curve));
  }
  return gaps;
}

}  // namespace

RunChart chart_over_time(std::string title, const std::string& quantity, const std::string& unit, double factor) {
  RunChart chart;
  chart.title = std::move(title);
  chart.x_label = "time, s";
  chart.over_time = true;
  set_unit(chart, quantity, unit, factor);
  return chart;
}

void set_unit(RunChart& chart, const std::string& quantity, const std::string& unit, double factor) {
  chart.y_label = quantity + ", " + unit;
  chart.unit = unit;
  chart.factor = factor;
}

std::vector<RunChart> contact_charts(const RunFolder& run, const ChartChoice& choice) {
  const auto names = run.summary.at("pairs").get<std::vector<std::string>>();
  const std::vector<std::size_t> order = strongest_pairs(run);
  std::vector<RunChart> charts;
  RunChart stems = chart_over_time("Impulses of the poundings", "impulse", "N s", 1);
  stems.stems = stems.from_zero = true;
  for (const std::size_t pair : order) {
    Curve curve{names[pair]};
    for (const auto& pounding : run.summary.at("poundings")) {
      if (pounding.at("pair") != names[pair]) continue;
      curve.x.push_back(pounding.at("t"));
      curve.y.push_back(pounding.at("impulse"));
    }
    stems.curves.push_back(std::move(curve));
  }
  if (!run.summary.at("poundings").empty()) charts.push_back(std::move(stems));
  if (run.results.has("/contacts/gap") && !names.empty()) charts.push_back(gap_chart(run, names, order, choice.parts));
  return charts;
}

std::vector<RunChart> energy_charts(const RunFolder& run, const ChartChoice& choice) {
  if (!run.results.has("/energy/input")) return {};
  RunChart chart = chart_over_time("Energy and where it went", "energy", "J", 1);
  chart.from_zero = true;
  double most = 0;
  for (const char* name : {"input", "kinetic", "strain", "damping", "contact", "friction", "numerical"}) {
    const std::string data = std::string("/energy/") + name;
    if (!run.results.has(data)) continue;
    Curve curve = thinned(name, run, history(run, data), 0, 1, choice.parts);
    const double reached = largest(curve);
    if (std::string_view(name) == "friction" && !(reached > 0)) continue;
    most = std::max(most, reached);
    chart.curves.push_back(std::move(curve));
  }
  if (most > 1e4) set_unit(chart, "energy", "kJ", 1e-3);
  RunChart error = chart_over_time("Error of the energy balance", "energy", "J", 1);
  error.curves.push_back(thinned("input less all others", run, history(run, "/energy/balance_error"), 0, 1, choice.parts));
  return {std::move(chart), std::move(error)};
}

std::vector<RunChart> ground_charts(const RunFolder& run, const ChartChoice& choice) {
  std::vector<RunChart> charts;
  for (const auto& [name, title, quantity, unit] : {std::array{"/ground/acceleration", "Acceleration of the base", "acceleration", "m/s²"},
                                                    std::array{"/ground/velocity", "Velocity of the base", "velocity", "m/s"}}) {
    if (!run.results.has(name)) continue;
    const std::vector<double> values = history(run, name);
    RunChart chart = chart_over_time(title, quantity, unit, 1);
    for (std::size_t k = 0; k < 3; ++k) {
      if (choice.direction >= 0 && static_cast<int>(k) != choice.direction) continue;
      Curve curve = thinned(std::string("along ") + axis[k], run, values, k, 3, choice.parts);
      if (largest(curve) > 0) chart.curves.push_back(std::move(curve));
    }
    if (!chart.curves.empty()) charts.push_back(std::move(chart));
  }
  return charts;
}

std::vector<RunChart> spectrum_charts(const RunFolder& run, const ChartChoice& choice) {
  if (!run.results.has("/floor_spectra/pseudo_acceleration")) return {};
  const std::vector<std::string> nodes = run.results.texts("/floor_spectra/node");
  const std::vector<double> periods = run.results.numbers("/floor_spectra/period"),
                            values = run.results.numbers("/floor_spectra/pseudo_acceleration");
  std::vector<std::size_t> order;
  for (const std::string& name : choice.nodes) {
    const auto found = std::find(nodes.begin(), nodes.end(), name);
    if (found == nodes.end()) throw InputError(fmt::format("error: no floor spectrum of node '{}'{}", name, did_you_mean(name, nodes)));
    order.push_back(static_cast<std::size_t>(found - nodes.begin()));
  }
  for (std::size_t i = 0; choice.nodes.empty() && i < std::min(nodes.size(), most_spectra); ++i) order.push_back(i);
  std::map<std::string, std::size_t> place;
  for (std::size_t i = 0; i < run.model.size(); ++i) place[run.model.nodes[i]] = i;
  double most = 0;
  for (const double value : values) most = std::max(most, value);
  std::map<int, std::pair<double, double>> levels;  // lowest and highest of each structure
  for (const std::size_t i : order) {
    const double z = run.model.position[3 * place.at(nodes[i]) + 2];
    auto& [low, high] = levels.try_emplace(run.model.structure[place.at(nodes[i])], z, z).first->second;
    low = std::min(low, z), high = std::max(high, z);
  }
  std::vector<RunChart> charts;
  for (std::size_t k = 0; k < 3; ++k) {
    RunChart chart;
    chart.title = fmt::format("Pseudo-acceleration along {}", axis[k]);
    chart.x_label = "period, s";
    set_unit(chart, "pseudo-acceleration", "m/s²", 1);
    chart.log_x = chart.from_zero = true;
    chart.direction = static_cast<int>(k);
    double reached = 0;
    for (const std::size_t i : order) {
      const auto first = values.begin() + static_cast<std::ptrdiff_t>((3 * i + k) * periods.size());
      const std::size_t node = place.at(nodes[i]);
      const auto& [low, high] = levels.at(run.model.structure[node]);
      const double z = run.model.position[3 * node + 2];
      Curve curve{fmt::format("{}, z = {:g} m", nodes[i], z), periods, {first, first + static_cast<std::ptrdiff_t>(periods.size())}};
      curve.colour = run.model.structure[node];
      curve.tint = high > low ? 0.62 * (high - z) / (high - low) : 0;
      reached = std::max(reached, largest(curve));
      chart.curves.push_back(std::move(curve));
    }
    if (choice.direction < 0 ? reached > 1e-3 * most : choice.direction == chart.direction) charts.push_back(std::move(chart));
  }
  return charts;
}

std::vector<RunChart> stage_charts(const RunFolder& run) {
  std::vector<RunChart> charts;
  for (const auto& stage : run.summary.at("stages")) {
    const std::string name = stage.at("stage"), folder = "/static/" + name;
    if (!run.results.has(folder + "/load_factor")) continue;
    const std::string at = stage.value("at", "");
    RunChart chart;
    chart.title = "Stage " + name;
    chart.unit = chart.y_label = "load factor";
    chart.x_label = at.empty() ? "point" : "displacement of " + at + (at.find(" r") == std::string::npos ? ", m" : ", rad");
    Curve curve{"load factor", run.results.numbers(folder + "/control_displacement"), run.results.numbers(folder + "/load_factor")};
    if (at.empty()) {
      for (std::size_t i = 0; i < curve.x.size(); ++i) curve.x[i] = static_cast<double>(i);
    }
    chart.curves.push_back(std::move(curve));
    charts.push_back(std::move(chart));
  }
  return charts;
}

std::vector<ChartGroup> report_charts(const RunFolder& run) {
  const auto series = static_cast<double>(9 * drawn_floors(run) + other_series);
  ChartChoice choice;
  choice.parts = static_cast<std::size_t>(std::clamp(all_parts / series, 100.0, 700.0));
  std::vector<ChartGroup> groups{{"static", "Static stages", "", stage_charts(run)}};
  std::vector<ChartGroup> floors = floor_charts(run, {"displacement", "drift", "twist", "acceleration"}, choice);
  if (floors.size() == 4 && floors[2].charts.size() == 1 && !floors[1].charts.empty()) {  // the twist beside the drifts
    floors[1].title = "Story drift and twist";
    floors[1].charts.push_back(std::move(floors[2].charts[0]));
    floors[2].charts.clear();
  }
  for (ChartGroup& group : floors) groups.push_back(std::move(group));
  const std::size_t pairs = run.summary.at("pairs").size(), shown = std::min(pairs, most_pairs);
  groups.push_back({"contact", "Contact", pairs > shown ? fmt::format("{} of {} pairs, those with the largest impulses.", shown, pairs) : "",
                    contact_charts(run, choice)});
  groups.push_back({"spectra", "Floor spectra", "", spectrum_charts(run, choice)});
  for (const auto& peak : run.summary.at("floor_spectra")) {
    groups.back().note = fmt::format("Oscillators with {:g} % damping on the floors; an impact is a jump of the floor's velocity.",
                                     100 * peak.at("damping").get<double>());
    break;
  }
  if (run.results.has("/floor_spectra/node")) {
    const std::size_t nodes = run.results.shape("/floor_spectra/node").at(0);
    if (nodes > most_spectra) groups.back().note += fmt::format(" {} of {} nodes are drawn.", most_spectra, nodes);
  }
  groups.push_back({"energy", "Energy", "", energy_charts(run, choice)});
  groups.push_back({"ground", "Ground motion", "", ground_charts(run, choice)});
  std::erase_if(groups, [](const ChartGroup& group) { return group.charts.empty(); });
  return groups;
}

std::vector<std::string> missing_histories(const RunFolder& run) {
  std::vector<std::string> notes;
  if (run.summary.at("steps").get<long>() == 0) return notes;
  const auto add = [&](const char* data, const char* what, const char* name) {
    if (!run.results.has(data))
      notes.push_back(fmt::format("No {} in these results: history = [\"{}\"] in [output] keeps {}.", what, name, "it"));
  };
  add("/nodes/id", "motion of nodes", "nodes");
  if (!run.summary.at("pairs").empty()) add("/contacts/gap", "gaps", "contacts");
  add("/energy/input", "course of the energy", "energy");
  add("/ground/acceleration", "ground motion", "ground");
  if (!run.results.has("/floor_spectra/period"))
    notes.push_back("No floor spectra in these results: floor_spectra = \"floors\" in [output] keeps them.");
  return notes;
}

}  // namespace nsframe
