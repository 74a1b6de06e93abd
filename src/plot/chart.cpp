#include "plot/chart.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "base/errors.hpp"
#include "plot/axis.hpp"
#include "plot/thinning.hpp"

namespace nsframe {

namespace {

// Okabe and Ito (2008), yellow darkened for white paper: told apart by the colour-blind. As in the page of a run.
constexpr unsigned colours[]{0x0072b2, 0xd55e00, 0x009e73, 0xcc79a7, 0xb07d00, 0x56b4e9, 0x000000, 0x7a7a7a};
constexpr const char* mark_colour = "#8c1d40";
constexpr double left = 84, top = 30, below = 70, frame_width = 520, least_width = 160, least_height = 60;
constexpr double letter = 8.4;             // an average one's width in pixels, of text of 14 pixels
constexpr std::size_t most_points = 4000;  // of a curve: longer ones are thinned, every peak stays

std::string xml_text(const std::string& text) {
  std::string out;
  for (const char c : text) out += c == '&' ? "&amp;" : c == '<' ? "&lt;" : c == '>' ? "&gt;" : std::string(1, c);
  return out;
}

double width_of(const std::string& text) {
  return letter * static_cast<double>(std::count_if(text.begin(), text.end(), [](char c) { return (c & 0xc0) != 0x80; }));
}

std::string svg_line(double x1, double y1, double x2, double y2, const char* stroke) {
  return fmt::format("<line x1=\"{:.1f}\" y1=\"{:.1f}\" x2=\"{:.1f}\" y2=\"{:.1f}\" stroke=\"{}\"/>\n", x1, y1, x2, y2, stroke);
}

std::string svg_text(double x, double y, const char* anchor, const std::string& content, double size = 14) {
  const std::string font = size == 14 ? "" : fmt::format(" font-size=\"{:.1f}\"", size);
  return fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"{}\"{}>{}</text>\n", x, y, anchor, font, content);
}

std::string marker(std::size_t kind, double x, double y, const std::string& colour) {
  if (kind % 3 == 0) return fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"4.5\" fill=\"{}\"/>\n", x, y, colour);
  if (kind % 3 == 1)
    return fmt::format("<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"8\" height=\"8\" fill=\"{}\"/>\n", x - 4, y - 4, colour);
  return fmt::format("<path d=\"M{:.1f} {:.1f} l5 9 h-10 z\" fill=\"{}\"/>\n", x, y - 5, colour);
}

std::string colour_of(const Curve& curve, std::size_t place) {
  const unsigned base = colours[(curve.colour < 0 ? place : static_cast<std::size_t>(curve.colour)) % std::size(colours)];
  unsigned mixed = 0;
  for (const unsigned shift : {16U, 8U, 0U}) {
    const double part = base >> shift & 0xffU;
    mixed |= static_cast<unsigned>(std::lround(part + (255 - part) * curve.tint)) << shift;
  }
  return fmt::format("#{:06x}", mixed);
}

// What of a curve is drawn: x, and y in the unit of the label.
struct Points {
  std::vector<double> x, y;
};

Points points_of(const Chart& chart, const Curve& curve) {
  Points all;
  for (std::size_t i = 0; i < std::min(curve.x.size(), curve.y.size()); ++i) {
    const double x = curve.x[i], y = chart.factor * curve.y[i];
    if (!std::isfinite(x) || !std::isfinite(y) || (chart.log_x && x <= 0) || (chart.log_y && y <= 0)) continue;
    if (x < chart.from || x > chart.to) continue;
    all.x.push_back(x), all.y.push_back(y);
  }
  if (all.x.size() <= most_points || !std::is_sorted(all.x.begin(), all.x.end())) return all;
  Thinner thinner(all.y.size(), most_points / 2);
  for (const double y : all.y) thinner.add(y);
  Points some{{}, thinner.values()};
  for (const std::size_t row : thinner.rows()) some.x.push_back(all.x[row]);
  return some;
}

// The frame of a chart on the sheet [px].
struct Frame {
  double up, width, height;
};

struct Extent {
  double low = 1e300, high = -1e300;
  void add(double value) { low = std::min(low, value), high = std::max(high, value); }
  void widen(double span) {
    const double centre = 0.5 * (low + high);
    low = centre - 0.5 * span, high = centre + 0.5 * span;
  }
};

class Drawing {
 public:
  Drawing(const Chart& chart, const Frame& frame, const std::vector<Points>& points, Extent x, Extent y)
      : chart_(chart), frame_(frame), points_(points), x_(chart.log_x, true, x.low, x.high),
        y_(chart.log_y, chart.equal, y.low, y.high) {}

  std::string svg() const {
    std::string out = axes() + marks();
    const double room = frame_.height / static_cast<double>(std::max<std::size_t>(1, legend_rows())), step = std::min(22.0, room);
    std::size_t row = 0;
    for (std::size_t k = 0; k < chart_.curves.size(); ++k) {
      const Curve& curve = chart_.curves[k];
      out += this->curve(k);
      if (!curve.name.empty()) out += legend_entry(k, frame_.up + 0.65 * step + step * static_cast<double>(row++), step);
    }
    if (!chart_.marks.empty() && !chart_.mark_name.empty()) {
      const double at = frame_.up + 0.65 * step + step * static_cast<double>(row);
      out += triangle(left + frame_.width + 21, at - 1) + legend_text(chart_.mark_name, at, step);
    }
    return out;
  }

  std::size_t legend_rows() const {
    const auto named = std::count_if(chart_.curves.begin(), chart_.curves.end(), [](const Curve& c) { return !c.name.empty(); });
    return static_cast<std::size_t>(named) + (chart_.marks.empty() || chart_.mark_name.empty() ? 0 : 1);
  }

 private:
  double px(double x) const { return left + frame_.width * x_.place(x); }
  double py(double y) const { return frame_.up + frame_.height * (1 - y_.place(y)); }
  double foot() const { return frame_.up + frame_.height; }

  std::string axes() const {
    std::string out;
    for (const Tick& tick : x_.ticks()) {
      const double at = px(tick.value);
      if (tick.labelled) out += svg_line(at, frame_.up, at, foot(), "#dddddd") + svg_text(at, foot() + 20, "middle", x_.label(tick.value));
      out += svg_line(at, foot(), at, foot() - (tick.labelled ? 8 : 4), "black");
    }
    for (const Tick& tick : y_.ticks()) {
      const double at = py(tick.value);
      if (tick.labelled)
        out += svg_line(left, at, left + frame_.width, at, "#dddddd") + svg_text(left - 8, at + 5, "end", y_.label(tick.value));
      out += svg_line(left, at, left + (tick.labelled ? 8 : 4), at, "black");
    }
    out += fmt::format("<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\" fill=\"none\" stroke=\"black\"/>\n", left,
                       frame_.up, frame_.width, frame_.height);
    out += svg_text(left + frame_.width / 2, foot() + 44, "middle", xml_text(chart_.x_label));
    const double size = std::min(14.0, 14 * (frame_.height + top) / std::max(1.0, width_of(chart_.y_label)));
    out += fmt::format("<text transform=\"translate(20 {:.1f}) rotate(-90)\" text-anchor=\"middle\" font-size=\"{:.1f}\">{}</text>\n",
                       frame_.up + frame_.height / 2, size, xml_text(chart_.y_label));
    return out + svg_text(left, frame_.up - 10, "start", xml_text(chart_.title));
  }

  static std::string triangle(double x, double foot) {
    return fmt::format("<path d=\"M{:.1f} {:.1f} l4 8 h-8 z\" fill=\"{}\"/>\n", x, foot - 8, mark_colour);
  }

  std::string marks() const {
    std::string out;
    for (const double x : chart_.marks) {
      if (x_.place(x) < 0 || x_.place(x) > 1) continue;
      out += fmt::format("<line x1=\"{0:.1f}\" y1=\"{1:.1f}\" x2=\"{0:.1f}\" y2=\"{2:.1f}\" stroke=\"{3}\" stroke-opacity=\"0.3\"/>\n",
                         px(x), frame_.up, foot(), mark_colour) +
             triangle(px(x), foot());
    }
    return out;
  }

  std::string curve(std::size_t place) const {
    const Curve& curve = chart_.curves[place];
    const std::string colour = colour_of(curve, place);
    std::string path, symbols, last;
    for (std::size_t i = 0; i < points_[place].x.size(); ++i) {
      const double x = px(points_[place].x[i]), y = py(points_[place].y[i]);
      if (chart_.stems) {
        symbols += svg_line(x, py(0), x, y, colour.c_str()) +
                   fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"3\" fill=\"{}\" stroke=\"{}\"/>\n", x, y,
                               curve.dashed ? "white" : colour, colour);
        continue;
      }
      const std::string point = fmt::format("{:.1f},{:.1f} ", x, y);
      if (point != last) path += point;
      last = point;
      if (curve.markers) symbols += marker(place, x, y, colour);
    }
    if (chart_.stems) return symbols;
    return fmt::format("<polyline points=\"{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"1.5\"{}/>\n", path, colour,
                       curve.dashed ? " stroke-dasharray=\"7 4\"" : "") +
           symbols;
  }

  std::string legend_text(const std::string& name, double y, double step) const {
    return svg_text(left + frame_.width + 36, y, "start", xml_text(name), std::min(14.0, step));
  }

  std::string legend_entry(std::size_t place, double y, double step) const {
    const Curve& curve = chart_.curves[place];
    const std::string colour = colour_of(curve, place);
    const double from = left + frame_.width + 12, middle = y - 5;
    std::string sign;
    if (chart_.stems) {
      sign = fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"3\" fill=\"{}\" stroke=\"{}\"/>\n", from + 9, middle,
                         curve.dashed ? "white" : colour, colour);
    } else if (curve.markers) {
      sign = marker(place, from + 10, middle, colour);
    } else {
      sign = fmt::format("<line x1=\"{0:.1f}\" y1=\"{2:.1f}\" x2=\"{1:.1f}\" y2=\"{2:.1f}\" stroke=\"{3}\" stroke-width=\"2\"{4}/>\n", from,
                         from + 20, middle, colour, curve.dashed ? " stroke-dasharray=\"6 3\"" : "");
    }
    return sign + legend_text(curve.name, y, step);
  }

  const Chart& chart_;
  const Frame frame_;
  const std::vector<Points>& points_;
  const Axis x_, y_;
};

std::string drawn(const Chart& chart, const Frame& frame) {
  std::vector<Points> points;
  Extent x, y;
  for (const Curve& curve : chart.curves) {
    points.push_back(points_of(chart, curve));
    for (const double value : points.back().x) x.add(value);
    for (const double value : points.back().y) y.add(value);
  }
  if (x.high < x.low) return {};
  if (std::isfinite(chart.from)) x.low = chart.from;
  if (std::isfinite(chart.to)) x.high = chart.to;
  if (chart.from_zero || chart.stems) y.add(0);
  if (chart.equal) {
    const double scale = 1.06 * std::max({(x.high - x.low) / frame.width, (y.high - y.low) / frame.height, 1e-12});
    x.widen(scale * frame.width), y.widen(scale * frame.height);
  }
  return Drawing(chart, frame, points, x, y).svg();
}

bool has_points(const Chart& chart) {
  return std::any_of(chart.curves.begin(), chart.curves.end(), [&](const Curve& c) { return !points_of(chart, c).x.empty(); });
}

}  // namespace

std::string chart_svg(const std::vector<Chart>& charts, const Sheet& sheet) {
  std::vector<const Chart*> shown;
  double legend = 20, titles = 0, wanted = 0;
  for (const Chart& chart : charts) {
    if (!has_points(chart)) continue;
    shown.push_back(&chart);
    wanted += chart.height;
    titles = std::max(titles, left + 20 + width_of(chart.title));
    for (const Curve& curve : chart.curves)
      if (!curve.name.empty()) legend = std::max(legend, 46 + width_of(curve.name));
    if (!chart.marks.empty()) legend = std::max(legend, 46 + width_of(chart.mark_name));
  }
  if (shown.empty()) return {};
  const double head = sheet.heading.empty() ? 0 : 28, around = head + (top + below) * static_cast<double>(shown.size());
  const double width = sheet.width > 0 ? sheet.width : std::max({left + frame_width + legend, titles, left + 20 + width_of(sheet.heading)});
  const double height = sheet.height > 0 ? sheet.height : wanted + around;
  const double inside = sheet.width > 0 ? width - left - legend : frame_width, stretch = (height - around) / wanted;
  if (inside < least_width)
    throw InputError(fmt::format("error: a width of {} pixels is too small for these charts: at least {:.0f}", sheet.width,
                                 left + legend + least_width));
  for (const Chart* chart : shown) {
    if (chart->height * stretch < least_height)
      throw InputError(fmt::format("error: a height of {} pixels is too small for {} charts: at least {:.0f}", sheet.height,
                                   shown.size(), around + least_height * wanted / chart->height));
  }
  std::string body;
  if (head > 0) body = svg_text(20, 24, "start", xml_text(sheet.heading), std::min(15.0, 14 * (width - 40) / width_of(sheet.heading)));
  double up = head + top;
  for (const Chart* chart : shown) {
    const Frame frame{up, inside, stretch * chart->height};
    body += drawn(*chart, frame);
    up += frame.height + top + below;
  }
  return fmt::format("<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0:.0f}\" height=\"{1:.0f}\" viewBox=\"0 0 {0:.0f} {1:.0f}\" "
                     "font-family=\"DejaVu Sans, Verdana, Helvetica, Arial, sans-serif\" font-size=\"14\">\n"
                     "<rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n",
                     width, height) +
         body + "</svg>\n";
}

}  // namespace nsframe
