#include "report/charts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "report/floor_charts.hpp"
#include "report/thinning.hpp"

namespace nsframe {
namespace {

constexpr std::size_t most_pairs = 6, most_spectra = 8, other_series = 15;
constexpr double all_parts = 42000;  // of all histories of a page: two points of about 20 bytes each
constexpr std::array<const char*, 3> axis{"x", "y", "z"};

// Every `stride`-th number of `values`, thinned.
ChartSeries thinned(const std::string& name, const RunFolder& run, const std::vector<double>& values, std::size_t first,
                    std::size_t stride, std::size_t parts) {
  const std::size_t rows = run.time.size();
  Thinner thinner(rows, parts);
  for (std::size_t row = 0; row < rows && row * stride + first < values.size(); ++row) thinner.add(values[row * stride + first]);
  ChartSeries series{name, -1, 0, {}, thinner.values()};
  for (const std::size_t row : thinner.rows()) series.x.push_back(run.time[row]);
  return series;
}

double largest(const ChartSeries& series) {
  double value = 0;
  for (const double y : series.y) value = std::max(value, std::abs(y));
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

ChartGroup contact_charts(const RunFolder& run, std::size_t parts) {
  const auto names = run.summary.at("pairs").get<std::vector<std::string>>();
  const std::vector<std::size_t> order = strongest_pairs(run);
  ChartGroup group{
      "contact",
      "Contact",
      names.size() > order.size() ? fmt::format("{} of {} pairs, those with the largest impulses.", order.size(), names.size()) : "",
      {}};
  ReportChart stems{"Impulses of the poundings", "N s", "time, s", 1, true, false, true, true};
  for (const std::size_t pair : order) {
    ChartSeries series{names[pair]};
    for (const auto& pounding : run.summary.at("poundings")) {
      if (pounding.at("pair") != names[pair]) continue;
      series.x.push_back(pounding.at("t"));
      series.y.push_back(pounding.at("impulse"));
    }
    stems.series.push_back(std::move(series));
  }
  if (!run.summary.at("poundings").empty()) group.charts.push_back(std::move(stems));
  if (run.results.has("/contacts/gap") && !names.empty()) {
    ReportChart gaps{"Gap", "mm", "time, s", 1e3, true, false, false, true};
    const std::size_t rows = run.time.size(), width = names.size(), block = std::max<std::size_t>(1, (1U << 19U) / width);
    std::vector<Thinner> thinners(order.size(), Thinner(rows, parts));
    std::vector<double> values;
    for (std::size_t first = 0; first < rows; first += block) {
      const std::size_t count = std::min(block, rows - first);
      run.results.read_rows("/contacts/gap", first, count, values);
      for (std::size_t i = 0; i < count; ++i) {
        for (std::size_t k = 0; k < order.size(); ++k) thinners[k].add(values[i * width + order[k]]);
      }
    }
    for (std::size_t k = 0; k < order.size(); ++k) {
      ChartSeries series{names[order[k]], -1, 0, {}, thinners[k].values()};
      for (const std::size_t row : thinners[k].rows()) series.x.push_back(run.time[row]);
      gaps.series.push_back(std::move(series));
    }
    group.charts.push_back(std::move(gaps));
  }
  return group;
}

ChartGroup energy_charts(const RunFolder& run, std::size_t parts) {
  ChartGroup group{"energy", "Energy", "", {}};
  if (!run.results.has("/energy/input")) return group;
  ReportChart chart{"Energy and where it went", "J", "time, s", 1, true, false, false, true};
  for (const char* name : {"input", "kinetic", "strain", "damping", "contact", "numerical"}) {
    chart.series.push_back(thinned(name, run, run.results.numbers(std::string("/energy/") + name), 0, 1, parts));
  }
  double most = 0;
  for (const ChartSeries& series : chart.series) most = std::max(most, largest(series));
  if (most > 1e4) chart.unit = "kJ", chart.factor = 1e-3;
  ReportChart error{"Error of the energy balance", "J", "time, s", 1, true};
  error.series.push_back(thinned("input less all others", run, run.results.numbers("/energy/balance_error"), 0, 1, parts));
  group.charts = {std::move(chart), std::move(error)};
  return group;
}

ChartGroup ground_charts(const RunFolder& run, std::size_t parts) {
  ChartGroup group{"ground", "Ground motion", "", {}};
  if (!run.results.has("/ground/acceleration")) return group;
  for (const auto& [name, title, unit] : {std::array{"/ground/acceleration", "Acceleration of the base", "m/s²"},
                                          std::array{"/ground/velocity", "Velocity of the base", "m/s"}}) {
    if (!run.results.has(name)) continue;
    const std::vector<double> values = run.results.numbers(name);
    ReportChart chart{title, unit, "time, s", 1, true};
    for (std::size_t k = 0; k < 3; ++k) {
      ChartSeries series = thinned(std::string("along ") + axis[k], run, values, k, 3, parts);
      if (largest(series) > 0) chart.series.push_back(std::move(series));
    }
    if (!chart.series.empty()) group.charts.push_back(std::move(chart));
  }
  return group;
}

ChartGroup spectrum_charts(const RunFolder& run) {
  ChartGroup group{"spectra", "Floor spectra", "", {}};
  if (!run.results.has("/floor_spectra/pseudo_acceleration")) return group;
  const std::vector<std::string> nodes = run.results.texts("/floor_spectra/node");
  const std::vector<double> periods = run.results.numbers("/floor_spectra/period"),
                            values = run.results.numbers("/floor_spectra/pseudo_acceleration");
  const std::size_t count = std::min(nodes.size(), most_spectra);
  std::map<std::string, std::size_t> place;
  for (std::size_t i = 0; i < run.model.size(); ++i) place[run.model.nodes[i]] = i;
  double most = 0;
  for (const double value : values) most = std::max(most, value);
  std::map<int, std::pair<double, double>> levels;  // lowest and highest of each structure
  for (std::size_t i = 0; i < count; ++i) {
    const double z = run.model.position[3 * place.at(nodes[i]) + 2];
    auto& [low, high] = levels.try_emplace(run.model.structure[place.at(nodes[i])], z, z).first->second;
    low = std::min(low, z), high = std::max(high, z);
  }
  for (std::size_t k = 0; k < 3; ++k) {
    ReportChart chart{fmt::format("Pseudo-acceleration along {}", axis[k]), "m/s²", "period, s", 1, false, true, false, true};
    double reached = 0;
    for (std::size_t i = 0; i < count; ++i) {
      const auto first = values.begin() + static_cast<std::ptrdiff_t>((3 * i + k) * periods.size());
      const std::size_t node = place.at(nodes[i]);
      const auto& [low, high] = levels.at(run.model.structure[node]);
      const double z = run.model.position[3 * node + 2];
      ChartSeries series{fmt::format("{}, z = {:g} m", nodes[i], z),
                         run.model.structure[node],
                         high > low ? 0.62 * (high - z) / (high - low) : 0,
                         periods,
                         {first, first + static_cast<std::ptrdiff_t>(periods.size())}};
      reached = std::max(reached, largest(series));
      chart.series.push_back(std::move(series));
    }
    if (reached > 1e-3 * most) group.charts.push_back(std::move(chart));
  }
  for (const auto& peak : run.summary.at("floor_spectra")) {
    group.note = fmt::format("Oscillators with {:g} % damping on the floors; an impact is a jump of the floor's velocity.",
                             100 * peak.at("damping").get<double>());
    break;
  }
  if (count < nodes.size()) group.note += fmt::format(" {} of {} nodes are drawn.", count, nodes.size());
  return group;
}

ChartGroup stage_charts(const RunFolder& run) {
  ChartGroup group{"static", "Static stages", "", {}};
  for (const auto& stage : run.summary.at("stages")) {
    const std::string name = stage.at("stage"), folder = "/static/" + name;
    if (!run.results.has(folder + "/load_factor")) continue;
    const std::string at = stage.value("at", "");
    ReportChart chart{"Stage " + name, "load factor",
                      at.empty() ? "point" : "displacement of " + at + (at.find(" r") == std::string::npos ? ", m" : ", rad")};
    ChartSeries series{"load factor", -1, 0, run.results.numbers(folder + "/control_displacement"),
                       run.results.numbers(folder + "/load_factor")};
    if (at.empty()) {
      for (std::size_t i = 0; i < series.x.size(); ++i) series.x[i] = static_cast<double>(i);
    }
    chart.series.push_back(std::move(series));
    group.charts.push_back(std::move(chart));
  }
  return group;
}

}  // namespace

std::vector<ChartGroup> report_charts(const RunFolder& run) {
  const auto series = static_cast<double>(9 * drawn_floors(run) + other_series);
  const auto parts = static_cast<std::size_t>(std::clamp(all_parts / series, 100.0, 700.0));
  std::vector<ChartGroup> groups{stage_charts(run)};
  for (ChartGroup& group : floor_charts(run, parts)) groups.push_back(std::move(group));
  groups.push_back(contact_charts(run, parts));
  groups.push_back(spectrum_charts(run));
  groups.push_back(energy_charts(run, parts));
  groups.push_back(ground_charts(run, parts));
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
