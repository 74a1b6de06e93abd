// Error against time on logarithmic axes, as SVG: one line a set of settings other than dt.
#include <algorithm>
#include <map>

#include "plot/chart.hpp"
#include "study/report.hpp"

namespace nsframe {

namespace {

struct Point {
  double seconds, error;
};

std::map<std::string, std::vector<Point>> series_of(const Study& study) {
  std::map<std::string, std::vector<Point>> series;
  for (const StudyRow& row : study.rows) {
    if (!row.failure.empty() || !(row.error > 0) || !(row.seconds > 0)) continue;
    std::string name;
    for (const std::string& text : row.settings) {
      if (text.starts_with("analysis.dt=")) continue;
      name += (name.empty() ? "" : ", ") + (text.starts_with("analysis.") ? text.substr(9) : text);
    }
    series[name.empty() ? row.scheme : name].push_back({row.seconds, row.error});
  }
  for (auto& [name, points] : series)
    std::sort(points.begin(), points.end(), [](const Point& a, const Point& b) { return a.seconds < b.seconds; });
  return series;
}

}  // namespace

std::string study_svg(const Study& study) {
  Chart chart;
  chart.title = study.title;
  chart.x_label = "time of the step loop, s";
  chart.y_label = "largest displacement error, m";
  chart.log_x = chart.log_y = true;
  for (const auto& [name, points] : series_of(study)) {
    Curve curve{name, {}, {}, true, false};
    for (const Point& point : points) {
      curve.x.push_back(point.seconds);
      curve.y.push_back(point.error);
    }
    chart.curves.push_back(std::move(curve));
  }
  return chart_svg({chart});
}

}  // namespace nsframe
