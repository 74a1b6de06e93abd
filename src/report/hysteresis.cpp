#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

#include "base/diagnostics.hpp"
#include "base/errors.hpp"
#include "report/figures.hpp"

namespace nsframe {
namespace {

// Columns of /sections: e0, kz, ky and N, MZ, MY.
constexpr std::size_t section_columns = 3;
struct SectionComponent {
  const char *deformation, *force, *title;
  double force_factor;
};
constexpr std::array<SectionComponent, section_columns> section_components{
    {{"axial strain, 1", "axial force, kN", "Axial force and strain", 1e-3},
     {"curvature, 1/m", "moment about z, kN m", "Moment and curvature about z", 1e-3},
     {"curvature, 1/m", "moment about y, kN m", "Moment and curvature about y", 1e-3}}};

struct SectionPoint {
  std::string kind, element;
  std::size_t row = 0;  // in the data sets of the kind
  int number = 0;       // along its element, from 1
  double position = 0;  // along its element, in [0, 1]
  std::array<double, section_columns> deformation{}, force{};  // ranges over the run
};

std::vector<SectionPoint> all_points(const RunFolder& run) {
  std::vector<SectionPoint> points;
  for (const std::string& kind : run.results.names_in("/sections")) {
    const std::vector<std::string> elements = run.results.texts("/sections/" + kind + "/element");
    const std::vector<double> positions = run.results.numbers("/sections/" + kind + "/position");
    for (std::size_t i = 0; i < elements.size(); ++i) {
      const int number = i > 0 && elements[i] == elements[i - 1] ? points.back().number + 1 : 1;
      points.push_back({kind, elements[i], i, number, positions.at(i)});
    }
  }
  return points;
}

// Calls `row(index of the row, numbers)` for every row of a data set of one kind.
template <class Row>
void each_row(const RunFolder& run, const std::string& name, std::size_t width, const Row& row) {
  const std::size_t rows = run.time.size(), block = std::max<std::size_t>(1, (1U << 19U) / std::max<std::size_t>(1, width));
  std::vector<double> values;
  for (std::size_t first = 0; first < rows; first += block) {
    const std::size_t count = std::min(block, rows - first);
    run.read_rows(name, first, count, values);
    for (std::size_t i = 0; i < count; ++i) row(first + i, values.data() + i * width);
  }
}

std::size_t width_of_kind(const RunFolder& run, const std::string& kind) {
  return section_columns * run.results.shape("/sections/" + kind + "/element").at(0);
}

void find_ranges(const RunFolder& run, std::vector<SectionPoint>& points) {
  for (const std::string& kind : run.results.names_in("/sections")) {
    const std::size_t width = width_of_kind(run, kind);
    for (const bool force : {false, true}) {
      std::vector<double> low(width, 0), high(width, 0);
      each_row(run, "/sections/" + kind + (force ? "/force" : "/deformation"), width, [&](std::size_t, const double* row) {
        for (std::size_t c = 0; c < width; ++c) low[c] = std::min(low[c], row[c]), high[c] = std::max(high[c], row[c]);
      });
      for (SectionPoint& point : points) {
        if (point.kind != kind) continue;
        auto& range = force ? point.force : point.deformation;
        for (std::size_t k = 0; k < section_columns; ++k) range[k] = high[section_columns * point.row + k] - low[section_columns * point.row + k];
      }
    }
  }
}

const SectionPoint& chosen(const std::vector<SectionPoint>& points, const std::string& name, std::size_t component) {
  const std::size_t colon = name.rfind(':');
  const std::string element = name.substr(0, colon);
  int number = 0;
  if (colon != std::string::npos) {
    const char *begin = name.data() + colon + 1, *end = name.data() + name.size();
    const auto read = std::from_chars(begin, end, number);
    if (read.ec != std::errc() || read.ptr != end || number < 1)
      throw InputError(fmt::format("error: --sections '{}': after the colon must be the number of an integration point", name));
  }
  const SectionPoint* found = nullptr;
  std::vector<std::string> names;
  int most = 0;
  for (const SectionPoint& point : points) {
    names.push_back(point.element);
    if (point.element != element) continue;
    most = std::max(most, point.number);
    if (number > 0 ? point.number == number : !found || point.deformation[component] > found->deformation[component]) found = &point;
  }
  if (found) return *found;
  if (most > 0) throw InputError(fmt::format("error: --sections '{}': '{}' has {} integration points", name, element, most));
  names.erase(std::unique(names.begin(), names.end()), names.end());
  throw InputError(fmt::format("error: no section histories of '{}' in these results{}", element, did_you_mean(element, names)));
}

}  // namespace

RunChart hysteresis_chart(const RunFolder& run, const std::vector<std::string>& sections, int direction) {
  std::vector<SectionPoint> points = all_points(run);
  if (points.empty() || run.time.empty()) throw InputError("error: these results have no members with sections over time");
  find_ranges(run, points);
  std::vector<std::string> names = sections;
  const auto larger = [](std::size_t k) {
    return [k](const SectionPoint& a, const SectionPoint& b) { return a.force[k] < b.force[k]; };
  };
  constexpr std::array<std::size_t, section_columns> of_direction{0, 2, 1};
  std::size_t component = direction >= 0 ? of_direction[static_cast<std::size_t>(direction)] : 1;
  if (direction < 0 && std::max_element(points.begin(), points.end(), larger(2))->force[2] >
                           std::max_element(points.begin(), points.end(), larger(1))->force[1])
    component = 2;
  if (names.empty()) {
    const auto widest = std::max_element(points.begin(), points.end(), [&](const SectionPoint& a, const SectionPoint& b) {
      return a.deformation[component] < b.deformation[component];
    });
    names.push_back(fmt::format("{}:{}", widest->element, widest->number));
  }
  RunChart chart;
  chart.title = section_components[component].title;
  chart.x_label = section_components[component].deformation;
  chart.y_label = chart.unit = section_components[component].force;
  chart.factor = section_components[component].force_factor;
  for (const std::string& name : names) {
    const SectionPoint& point = chosen(points, name, component);
    Curve curve{fmt::format("{}:{}, at {:.3g} L", point.element, point.number, point.position)};
    const std::size_t column = section_columns * point.row + component, width = width_of_kind(run, point.kind);
    each_row(run, "/sections/" + point.kind + "/deformation", width, [&](std::size_t, const double* row) { curve.x.push_back(row[column]); });
    each_row(run, "/sections/" + point.kind + "/force", width, [&](std::size_t, const double* row) { curve.y.push_back(row[column]); });
    chart.curves.push_back(std::move(curve));
  }
  return chart;
}

}  // namespace nsframe
