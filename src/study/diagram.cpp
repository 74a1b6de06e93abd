// Error against time on logarithmic axes, as SVG: one line a set of settings other than dt.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "study/report.hpp"

namespace nsframe {

namespace {

// Okabe and Ito (2008): told apart by the colour-blind.
constexpr const char* colours[]{"#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9", "#000000"};
constexpr double left = 80, top = 30, wide = 520, high = 380;

struct Point {
  double seconds, error;
};

std::string escaped(const std::string& text) {
  std::string out;
  for (const char c : text) out += c == '&' ? "&amp;" : c == '<' ? "&lt;" : c == '>' ? "&gt;" : std::string(1, c);
  return out;
}

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

struct Axis {
  int first, last;  // decades
  double place(double value) const { return (std::log10(value) - first) / (last - first); }
};

Axis axis_over(double least, double most) {
  const int first = static_cast<int>(std::floor(std::log10(least))), last = static_cast<int>(std::ceil(std::log10(most)));
  return {first, std::max(last, first + 1)};
}

std::string line(double x1, double y1, double x2, double y2, const char* stroke) {
  return fmt::format("<line x1=\"{:.1f}\" y1=\"{:.1f}\" x2=\"{:.1f}\" y2=\"{:.1f}\" stroke=\"{}\"/>\n", x1, y1, x2, y2, stroke);
}

std::string text(double x, double y, const char* anchor, const std::string& content) {
  return fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"{}\">{}</text>\n", x, y, anchor, content);
}

std::string ticks(const Axis& axis, bool horizontal) {
  std::string out;
  for (int decade = axis.first; decade <= axis.last; ++decade) {
    for (int k = 1; k <= 9; ++k) {
      const double at = axis.place(k * std::pow(10.0, decade));
      if (at > 1 + 1e-9) break;
      const double x = left + wide * at, y = top + high * (1 - at), size = k == 1 ? 8 : 4;
      if (k == 1) out += horizontal ? line(x, top, x, top + high, "#dddddd") : line(left, y, left + wide, y, "#dddddd");
      out += horizontal ? line(x, top + high, x, top + high - size, "black") : line(left, y, left + size, y, "black");
      if (k > 1) continue;
      const std::string power = fmt::format("10<tspan dy=\"-6\" font-size=\"10\">{}</tspan>", decade);
      out += horizontal ? text(x, top + high + 20, "middle", power) : text(left - 8, y + 5, "end", power);
    }
  }
  return out;
}

std::string marker(std::size_t kind, double x, double y, const char* colour) {
  if (kind % 3 == 0) return fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"4.5\" fill=\"{}\"/>\n", x, y, colour);
  if (kind % 3 == 1) return fmt::format("<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"8\" height=\"8\" fill=\"{}\"/>\n", x - 4, y - 4, colour);
  return fmt::format("<path d=\"M{:.1f} {:.1f} l5 9 h-10 z\" fill=\"{}\"/>\n", x, y - 5, colour);
}

}  // namespace

std::string study_svg(const Study& study) {
  const auto series = series_of(study);
  if (series.empty()) return {};
  double seconds[2]{1e300, 0}, errors[2]{1e300, 0};
  for (const auto& [name, points] : series) {
    for (const Point& p : points) {
      seconds[0] = std::min(seconds[0], p.seconds), seconds[1] = std::max(seconds[1], p.seconds);
      errors[0] = std::min(errors[0], p.error), errors[1] = std::max(errors[1], p.error);
    }
  }
  const Axis x = axis_over(seconds[0], seconds[1]), y = axis_over(errors[0], errors[1]);
  std::size_t longest = 0;
  for (const auto& entry : series) longest = std::max(longest, entry.first.size());
  const double width = left + wide + 60 + 7.5 * static_cast<double>(longest);
  std::string out = fmt::format("<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0:.0f}\" height=\"480\" viewBox=\"0 0 {0:.0f} 480\" "
                                "font-family=\"sans-serif\" font-size=\"14\">\n<rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n", width);
  out += ticks(x, true) + ticks(y, false);
  out += fmt::format("<rect x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" fill=\"none\" stroke=\"black\"/>\n", left, top, wide, high);
  out += text(left + wide / 2, top + high + 48, "middle", "time of the step loop, s");
  out += fmt::format("<text transform=\"translate(22 {:.1f}) rotate(-90)\" text-anchor=\"middle\">largest displacement error, m</text>\n",
                     top + high / 2);
  out += text(left, 20, "start", escaped(study.title));
  std::size_t kind = 0;
  for (const auto& [name, points] : series) {
    const char* colour = colours[kind % std::size(colours)];
    std::string path, marks;
    for (const Point& p : points) {
      const double px = left + wide * x.place(p.seconds), py = top + high * (1 - y.place(p.error));
      path += fmt::format("{:.1f},{:.1f} ", px, py);
      marks += marker(kind, px, py, colour);
    }
    out += fmt::format("<polyline points=\"{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"1.5\"/>\n{}", path, colour, marks);
    const double row = top + 14 + 22 * static_cast<double>(kind);
    out += marker(kind, left + wide + 22, row - 5, colour) + text(left + wide + 34, row, "start", escaped(name));
    ++kind;
  }
  return out + "</svg>\n";
}

}  // namespace nsframe
