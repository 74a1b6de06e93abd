#include "study/chart.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

namespace nsframe {

namespace {

// Okabe and Ito (2008): told apart by the colour-blind.
constexpr const char* colours[]{"#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9", "#000000"};
constexpr double left = 80, top = 30, wide = 520, below = 70;
constexpr std::size_t most_points = 4000;  // of a curve: more are drawn by the extremes of groups

std::string escaped(const std::string& text) {
  std::string out;
  for (const char c : text) out += c == '&' ? "&amp;" : c == '<' ? "&lt;" : c == '>' ? "&gt;" : std::string(1, c);
  return out;
}

std::string line(double x1, double y1, double x2, double y2, const char* stroke) {
  return fmt::format("<line x1=\"{:.1f}\" y1=\"{:.1f}\" x2=\"{:.1f}\" y2=\"{:.1f}\" stroke=\"{}\"/>\n", x1, y1, x2, y2,
                     stroke);
}

std::string text(double x, double y, const char* anchor, const std::string& content) {
  return fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"{}\">{}</text>\n", x, y, anchor, content);
}

struct Tick {
  double value;
  bool labelled;
};

class Axis {
 public:
  // `tight`: a linear axis ends where the data do.
  Axis(bool logarithmic, bool tight, double least, double most) : log_(logarithmic) {
    if (log_) {
      first_ = std::floor(std::log10(least));
      last_ = std::max(std::ceil(std::log10(most)), first_ + 1);
      return;
    }
    const double span = most > least ? most - least : std::max(std::abs(most), 1e-12);
    const double power = std::pow(10.0, std::floor(std::log10(span / 4)));
    for (const double factor : {1.0, 2.0, 5.0, 10.0}) {
      step_ = factor * power;
      if (span / step_ <= 6) break;
    }
    first_ = step_ * std::floor(least / step_ + 1e-9);
    last_ = step_ * std::ceil(most / step_ - 1e-9);
    if (!(last_ > first_)) last_ = first_ + step_;
    tick_ = first_;
    if (tight && most > least) {
      first_ = least;
      last_ = most;
      tick_ = step_ * std::ceil(least / step_ - 1e-9);
    }
  }

  double place(double value) const { return ((log_ ? std::log10(value) : value) - first_) / (last_ - first_); }

  std::vector<Tick> ticks() const {
    std::vector<Tick> out;
    if (!log_) {
      for (int i = 0; tick_ + i * step_ <= last_ + 1e-9 * step_; ++i) out.push_back({tick_ + i * step_, true});
      return out;
    }
    for (int decade = static_cast<int>(first_); decade <= static_cast<int>(last_); ++decade)
      for (int k = 1; k <= (decade == static_cast<int>(last_) ? 1 : 9); ++k)
        out.push_back({k * std::pow(10.0, decade), k == 1});
    return out;
  }

  std::string label(double value) const {
    if (!log_) return fmt::format("{:.6g}", std::abs(value) < 1e-9 * step_ ? 0.0 : value);
    return fmt::format("10<tspan dy=\"-6\" font-size=\"10\">{:.0f}</tspan>", std::round(std::log10(value)));
  }

 private:
  bool log_;
  double first_ = 0, last_ = 1, step_ = 1, tick_ = 0;  // decades, or values; tick_: the first of a linear axis
};

std::string marker(std::size_t kind, double x, double y, const char* colour) {
  if (kind % 3 == 0) return fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"4.5\" fill=\"{}\"/>\n", x, y, colour);
  if (kind % 3 == 1)
    return fmt::format("<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"8\" height=\"8\" fill=\"{}\"/>\n", x - 4, y - 4,
                       colour);
  return fmt::format("<path d=\"M{:.1f} {:.1f} l5 9 h-10 z\" fill=\"{}\"/>\n", x, y - 5, colour);
}

// Indices to draw: of long curves the least and the largest of each group, in their order.
std::vector<std::size_t> drawn(const Chart& chart, const Curve& curve) {
  std::vector<std::size_t> valid, out;
  for (std::size_t i = 0; i < std::min(curve.x.size(), curve.y.size()); ++i)
    if (std::isfinite(curve.y[i]) && (!chart.log_x || curve.x[i] > 0) && (!chart.log_y || curve.y[i] > 0))
      valid.push_back(i);
  if (valid.size() <= most_points) return valid;
  const std::size_t group = 2 * (valid.size() / most_points + 1);
  for (std::size_t first = 0; first < valid.size(); first += group) {
    const auto begin = valid.begin() + static_cast<std::ptrdiff_t>(first),
               end = valid.begin() + static_cast<std::ptrdiff_t>(std::min(first + group, valid.size()));
    const auto [low, high] =
        std::minmax_element(begin, end, [&](std::size_t a, std::size_t b) { return curve.y[a] < curve.y[b]; });
    out.insert(out.end(), {std::min(*low, *high), std::max(*low, *high)});
  }
  return out;
}

std::string frame(const Chart& chart, const Axis& x, const Axis& y, double up) {
  std::string out;
  for (const Tick& tick : x.ticks()) {
    const double at = left + wide * x.place(tick.value), foot = up + chart.height;
    if (tick.labelled) out += line(at, up, at, foot, "#dddddd") + text(at, foot + 20, "middle", x.label(tick.value));
    out += line(at, foot, at, foot - (tick.labelled ? 8 : 4), "black");
  }
  for (const Tick& tick : y.ticks()) {
    const double at = up + chart.height * (1 - y.place(tick.value));
    if (tick.labelled)
      out += line(left, at, left + wide, at, "#dddddd") + text(left - 8, at + 5, "end", y.label(tick.value));
    out += line(left, at, left + (tick.labelled ? 8 : 4), at, "black");
  }
  out += fmt::format("<rect x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" fill=\"none\" stroke=\"black\"/>\n", left, up,
                     wide, chart.height);
  out += text(left + wide / 2, up + chart.height + 48, "middle", escaped(chart.x_label));
  out += fmt::format("<text transform=\"translate(22 {:.1f}) rotate(-90)\" text-anchor=\"middle\">{}</text>\n",
                     up + chart.height / 2, escaped(chart.y_label));
  return out + text(left, up - 10, "start", escaped(chart.title));
}

std::string curves_of(const Chart& chart, double up) {
  double low[2]{1e300, 1e300}, high[2]{-1e300, -1e300};
  for (const Curve& curve : chart.curves) {
    for (const std::size_t i : drawn(chart, curve)) {
      low[0] = std::min(low[0], curve.x[i]), high[0] = std::max(high[0], curve.x[i]);
      low[1] = std::min(low[1], curve.y[i]), high[1] = std::max(high[1], curve.y[i]);
    }
  }
  if (high[0] < low[0]) return {};
  const Axis x(chart.log_x, true, low[0], high[0]), y(chart.log_y, false, low[1], high[1]);
  std::string out = frame(chart, x, y, up);
  std::size_t kind = 0, row = 0;
  for (const Curve& curve : chart.curves) {
    const char* colour = colours[kind % std::size(colours)];
    std::string path, marks;
    for (const std::size_t i : drawn(chart, curve)) {
      const double px = left + wide * x.place(curve.x[i]), py = up + chart.height * (1 - y.place(curve.y[i]));
      path += fmt::format("{:.1f},{:.1f} ", px, py);
      if (curve.markers) marks += marker(kind, px, py, colour);
    }
    const char* dash = curve.dashed ? " stroke-dasharray=\"7 4\"" : "";
    out += fmt::format("<polyline points=\"{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"1.5\"{}/>\n{}", path, colour,
                       dash, marks);
    if (!curve.name.empty()) {
      const double at = up + 14 + 22 * static_cast<double>(row++);
      out += curve.markers ? marker(kind, left + wide + 22, at - 5, colour)
                           : fmt::format(
                                 "<line x1=\"{0:.1f}\" y1=\"{2:.1f}\" x2=\"{1:.1f}\" y2=\"{2:.1f}\" stroke=\"{3}\" "
                                 "stroke-width=\"2\"{4}/>\n",
                                 left + wide + 12, left + wide + 30, at - 5, colour, dash);
      out += text(left + wide + 34, at, "start", escaped(curve.name));
    }
    ++kind;
  }
  return out;
}

}  // namespace

std::string chart_svg(const std::vector<Chart>& charts) {
  std::size_t longest = 0, longest_title = 0;
  double up = top;
  std::string body;
  for (const Chart& chart : charts) {
    const std::string curves = curves_of(chart, up);
    if (curves.empty()) continue;
    body += curves;
    up += chart.height + top + below;
    longest_title = std::max(longest_title, chart.title.size());
    for (const Curve& curve : chart.curves) longest = std::max(longest, curve.name.size());
  }
  if (body.empty()) return {};
  const double width = std::max(left + wide + 60 + 7.5 * static_cast<double>(longest),
                                left + 20 + 7.5 * static_cast<double>(longest_title)),
               height = up - top;
  return fmt::format(
             "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0:.0f}\" height=\"{1:.0f}\" viewBox=\"0 0 {0:.0f} "
             "{1:.0f}\" "
             "font-family=\"sans-serif\" font-size=\"14\">\n<rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n",
             width, height) +
         body + "</svg>\n";
}

}  // namespace nsframe
