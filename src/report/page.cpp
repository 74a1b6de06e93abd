#include "report/page.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "base/errors.hpp"
#include "report/charts.hpp"
#include "report/drawing.hpp"
#include "report/page_parts.hpp"

namespace nsframe {
namespace {

using Json = nlohmann::json;

constexpr std::size_t most_poundings = 1000;

// Six significant digits, so that a number is short as text.
double rounded(double value) {
  if (value == 0 || !std::isfinite(value)) return value;
  char text[32];
  const char* end = std::to_chars(text, text + sizeof text, value, std::chars_format::scientific, 5).ptr;
  std::from_chars(text, end, value);
  return value;
}

Json rounded(const std::vector<double>& values) {
  Json list = Json::array();
  for (const double value : values) list.push_back(rounded(value));  // NaN becomes null
  return list;
}

Json groups_json(const std::vector<ChartGroup>& groups) {
  Json list = Json::array();
  for (const ChartGroup& group : groups) {
    Json charts = Json::array();
    for (const RunChart& chart : group.charts) {
      Json series = Json::array();
      for (const Curve& c : chart.curves) {
        series.push_back({{"name", c.name}, {"colour", c.colour}, {"tint", c.tint}, {"x", rounded(c.x)}, {"y", rounded(c.y)}});
      }
      charts.push_back({{"title", chart.title},
                        {"unit", chart.unit},
                        {"x_label", chart.x_label},
                        {"factor", chart.factor},
                        {"over_time", chart.over_time},
                        {"log", chart.log_x},
                        {"stems", chart.stems},
                        {"zero", chart.from_zero},
                        {"series", series}});
    }
    list.push_back({{"id", group.id}, {"title", group.title}, {"note", group.note}, {"charts", charts}});
  }
  return list;
}

// The strongest, in the order of time.
Json poundings_json(const Json& summary) {
  std::vector<Json> list = summary.at("poundings").get<std::vector<Json>>();
  if (list.size() > most_poundings) {
    std::nth_element(list.begin(), list.begin() + most_poundings, list.end(),
                     [](const Json& a, const Json& b) { return a.at("impulse").get<double>() > b.at("impulse").get<double>(); });
    list.resize(most_poundings);
  }
  std::stable_sort(list.begin(), list.end(),
                   [](const Json& a, const Json& b) { return a.at("t").get<double>() < b.at("t").get<double>(); });
  return list;
}

// The largest value of the run and where it was, of what `items` of the summary have below `key` along x and y.
template <class Describe>
Json largest_of(const Json& items, const char* key, const Describe& describe) {
  Json found;
  double largest = 0;
  for (const Json& item : items) {
    for (std::size_t k = 0; k < 2; ++k) {
      const double value = item.at(key).at(k).get<double>();
      if (value <= largest) continue;
      largest = value;
      found = describe(item);
      found["value"] = value;
      found["direction"] = k == 0 ? "x" : "y";
    }
  }
  return found;
}

Json peaks_json(const Json& summary) {
  Json twist;
  double largest = 1e-9;  // [rad]; less is rounding
  for (const Json& peak : summary.at("peaks")) {
    if (peak.at("twist").get<double>() <= largest) continue;
    largest = peak.at("twist").get<double>();
    twist = {{"value", largest}, {"node", peak.at("node")}};
  }
  return {{"displacement", largest_of(summary.at("peaks"), "displacement",
                                      [](const Json& peak) {
                                        return Json{{"node", peak.at("node")}};
                                      })},
          {"drift", largest_of(summary.at("drifts"), "drift",
                               [](const Json& drift) {
                                 return Json{{"structure", drift.at("structure")}, {"story", drift.at("story")}};
                               })},
          {"twist", twist}};
}

Json page_data(const RunFolder& run) {
  Json summary;
  for (const char* key : {"title",
                          "version",
                          "completed",
                          "stop_reason",
                          "end_time",
                          "scheme",
                          "scheme_reason",
                          "dt",
                          "theta",
                          "gamma",
                          "steps",
                          "elements",
                          "fibers",
                          "dofs",
                          "structures",
                          "numerical_damping",
                          "pairs",
                          "energy",
                          "max_penetration",
                          "max_complementarity_error",
                          "newton_iterations",
                          "halved_steps",
                          "evaluations",
                          "rejected_parts",
                          "timing",
                          "warnings"}) {
    summary[key] = run.summary.at(key);
  }
  summary["poundings_total"] = run.summary.at("poundings").size();
  summary["impacts_total"] = run.summary.at("impacts").size();
  return {{"summary", summary},
          {"poundings", poundings_json(run.summary)},
          {"peaks", peaks_json(run.summary)},
          {"view", drawing(run)},
          {"groups", groups_json(report_charts(run))},
          {"notes", missing_histories(run)},
          {"scene", run.results.text("/scene")}};
}

std::string escaped(const std::string& text) {
  std::string out;
  for (const char c : text) out += c == '&' ? "&amp;" : c == '<' ? "&lt;" : c == '>' ? "&gt;" : std::string(1, c);
  return out;
}

// JSON that no browser takes for the end of its element.
std::string embedded(const Json& data) {
  const std::string text = data.dump(-1, ' ', false, Json::error_handler_t::replace);
  std::string out;
  out.reserve(text.size());
  for (const char c : text) {
    if (c == '<') {
      out += "\\u003c";
    } else {
      out += c;
    }
  }
  return out;
}

void replace(std::string& page, const std::string& mark, const std::string& text) { page.replace(page.find(mark), mark.size(), text); }

}  // namespace

std::string report_page(const std::filesystem::path& folder) {
  const RunFolder run(folder);
  try {
    const Json data = page_data(run);
    std::string page = page_parts::page;
    replace(page, "{{title}}", escaped(run.summary.at("title").get<std::string>()));
    replace(page, "{{style}}", page_parts::style);
    replace(page, "{{script}}", std::string(page_parts::chart) + page_parts::view + page_parts::script);
    replace(page, "{{data}}", embedded(data));
    return page;
  } catch (const Json::exception& problem) {
    throw InputError(fmt::format("error: '{}' is not a summary of this nsframe: {}", (folder / "summary.json").string(), problem.what()));
  }
}

}  // namespace nsframe
