#include "report/figures.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <functional>

#include "base/diagnostics.hpp"
#include "base/errors.hpp"
#include "report/floor_charts.hpp"

namespace nsframe {
namespace {

using Charts = std::vector<RunChart>;

struct Figure {
  const char* name;
  const char* kept_by;  // the key of [output] that keeps it; empty: the command's own error says it
  std::function<Charts(const RunFolder&, const FigureChoice&)> charts;
};

Charts floors(const RunFolder& run, const FigureChoice& choice, const char* quantity) {
  std::vector<ChartGroup> groups = floor_charts(run, {quantity}, choice.charts);
  return groups.empty() ? Charts{} : std::move(groups.front().charts);
}

Charts contact(const RunFolder& run, const FigureChoice& choice, bool stems) {
  Charts charts = contact_charts(run, choice.charts);
  std::erase_if(charts, [&](const RunChart& chart) { return chart.stems != stems; });
  return charts;
}

Figure of_floors(const char* name, const char* kept_by) {
  return {name, kept_by, [name](const RunFolder& run, const FigureChoice& choice) { return floors(run, choice, name); }};
}

const std::vector<Figure>& figures() {
  constexpr const char* nodes = "history = [\"nodes\"]";
  static const std::vector<Figure> all{
      of_floors("displacement", nodes),
      of_floors("velocity", nodes),
      of_floors("acceleration", nodes),
      of_floors("drift", nodes),
      of_floors("twist", nodes),
      of_floors("orbit", nodes),
      {"gap", "history = [\"contacts\"]", [](const RunFolder& run, const FigureChoice& c) { return contact(run, c, false); }},
      {"impulse", "", [](const RunFolder& run, const FigureChoice& c) { return contact(run, c, true); }},
      {"energy", "history = [\"energy\"]", [](const RunFolder& run, const FigureChoice& c) { return energy_charts(run, c.charts); }},
      {"ground", "history = [\"ground\"]", [](const RunFolder& run, const FigureChoice& c) { return ground_charts(run, c.charts); }},
      {"spectrum", "floor_spectra = \"floors\"",
       [](const RunFolder& run, const FigureChoice& c) { return spectrum_charts(run, c.charts); }},
      {"hysteresis", "history = [\"sections\"]",
       [](const RunFolder& run, const FigureChoice& c) {
         return run.results.has("/sections") ? Charts{hysteresis_chart(run, c.sections, c.charts.direction)} : Charts{};
       }},
      {"static", "", [](const RunFolder& run, const FigureChoice&) { return stage_charts(run); }},
  };
  return all;
}

const Figure& figure_named(const std::string& name) {
  for (const Figure& figure : figures()) {
    if (figure.name == name) return figure;
  }
  throw InputError(fmt::format("error: --quantity '{}' is not known{}", name, did_you_mean(name, figure_quantities())));
}

std::vector<std::string> most_telling(const RunFolder& run) {
  if (run.time.empty()) return {"static"};
  if (run.summary.at("poundings").empty()) return {"displacement"};
  return {"displacement", "impulse"};
}

// Of charts along x, y and z the one with the largest values.
void keep_largest(Charts& charts) {
  const auto largest = [](const RunChart& chart) {
    double value = 0;
    for (const Curve& curve : chart.curves) {
      for (const double y : curve.y) value = std::max(value, std::abs(y));
    }
    return value;
  };
  if (charts.size() < 2 || charts.front().direction < 0) return;
  charts = {*std::max_element(charts.begin(), charts.end(), [&](const auto& a, const auto& b) { return largest(a) < largest(b); })};
}

void refuse_nodes(const Figure& figure, const ChartChoice& choice) {
  const std::string name = figure.name;
  if (!choice.nodes.empty() && name == "drift") throw InputError("error: drifts are of floors: give --floors in place of --nodes");
  if (!choice.floors.empty() && name == "spectrum")
    throw InputError("error: floor spectra are of nodes: give --nodes in place of --floors");
}

std::string missing(const Figure& figure, const RunFolder& run, const FigureChoice& choice) {
  const std::string name = figure.name;
  if (name == "impulse") return "error: there were no poundings in this run";
  if (name == "static") return "error: this run has no static stages";
  if (run.time.empty()) return fmt::format("error: no {} in these results: the run has static stages only", name);
  const bool recorded = name == "spectrum" ? run.results.has("/floor_spectra/period")
                        : figure.kept_by == std::string("history = [\"nodes\"]") ? run.results.has("/nodes/id") : false;
  if (recorded && choice.charts.direction >= 0)
    return fmt::format("error: no {} along {} in these results", name, "xyz"[choice.charts.direction]);
  if (recorded) return fmt::format("error: these results have no floors for {}: the nodes of two must be in output.nodes", name);
  return fmt::format("error: no {} in these results: {} in [output] keeps it", name, figure.kept_by);
}

}  // namespace

std::vector<std::string> figure_quantities() {
  std::vector<std::string> names;
  for (const Figure& figure : figures()) names.push_back(figure.name);
  return names;
}

std::vector<Chart> figure(const RunFolder& run, const FigureChoice& choice) {
  std::vector<Chart> out;
  std::vector<double> poundings;
  for (const auto& pounding : run.summary.at("poundings")) poundings.push_back(pounding.at("t").get<double>());
  const std::vector<std::string> names = choice.quantities.empty() ? most_telling(run) : choice.quantities;
  for (const std::string& name : names) figure_named(name);
  for (const std::string& name : names) {
    const Figure& figure = figure_named(name);
    refuse_nodes(figure, choice.charts);
    Charts charts = figure.charts(run, choice);
    if (charts.empty()) throw InputError(missing(figure, run, choice));
    if (choice.charts.direction < 0) keep_largest(charts);
    for (RunChart& chart : charts) {
      chart.height = chart.over_time ? 200 : 380;
      if (chart.over_time) {
        chart.from = run.time.front(), chart.to = run.time.back();
        if (!chart.stems) chart.marks = poundings, chart.mark_name = "pounding";
        std::erase_if(chart.marks, [&](double t) { return t < chart.from || t > chart.to; });
      }
      if (chart.stems) std::erase_if(chart.curves, [](const Curve& curve) { return curve.x.empty(); });
      out.push_back(std::move(chart));
    }
  }
  return out;
}

void lay_over(std::vector<Chart>& charts, const std::vector<Chart>& others, const std::string& label, const std::string& other_label) {
  const auto titled = [](const std::vector<Chart>& list, const std::string& title) {
    return std::find_if(list.begin(), list.end(), [&](const Chart& chart) { return chart.title == title; });
  };
  for (const Chart& other : others) {
    if (titled(charts, other.title) == charts.end())
      throw InputError(fmt::format("error: '{}' is in the second run only: choose --quantity and --direction", other.title));
  }
  for (Chart& chart : charts) {
    const auto other = titled(others, chart.title);
    if (other == others.end())
      throw InputError(fmt::format("error: '{}' is in the first run only: choose --quantity and --direction", chart.title));
    if (other->factor != chart.factor) {
      chart.y_label = chart.factor > other->factor ? chart.y_label : other->y_label;
      chart.factor = std::max(chart.factor, other->factor);
    }
    const std::size_t own = chart.curves.size();
    for (std::size_t k = 0; k < own; ++k) {
      if (chart.curves[k].colour < 0) chart.curves[k].colour = static_cast<int>(k);
    }
    int next = static_cast<int>(own);
    for (Curve curve : other->curves) {
      const auto same = std::find_if(chart.curves.begin(), chart.curves.end(), [&](const Curve& c) { return c.name == curve.name; });
      const bool known = same != chart.curves.end();
      curve.colour = known ? same->colour : curve.colour < 0 ? next++ : curve.colour;
      curve.dashed = true;
      curve.name += ", " + other_label;
      chart.curves.push_back(std::move(curve));
    }
    for (std::size_t k = 0; k < own; ++k) chart.curves[k].name += ", " + label;
    if (!chart.marks.empty()) chart.mark_name = "pounding, " + label;
  }
}

}  // namespace nsframe
