#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <sstream>

#include "base/errors.hpp"
#include "plot/axis.hpp"
#include "plot/picture.hpp"

using namespace nsframe;

namespace {

// The points of the polylines of an SVG, in pixels.
std::vector<std::vector<std::pair<double, double>>> polylines(const std::string& svg) {
  std::vector<std::vector<std::pair<double, double>>> all;
  for (std::size_t at = svg.find("points=\""); at != std::string::npos; at = svg.find("points=\"", at + 1)) {
    std::istringstream text(svg.substr(at + 8, svg.find('"', at + 8) - at - 8));
    all.emplace_back();
    double x = 0, y = 0;
    for (char comma = 0; text >> x >> comma >> y;) all.back().emplace_back(x, y);
  }
  return all;
}

std::size_t count(const std::string& text, const std::string& part) {
  std::size_t found = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++found;
  return found;
}

Chart line_chart(std::vector<double> x, std::vector<double> y) {
  Chart chart{"title", "x, m", "y, N"};
  chart.curves = {{"curve", std::move(x), std::move(y)}};
  return chart;
}

}  // namespace

TEST_CASE("values lie on an axis in proportion, or in proportion to their logarithms") {
  const Axis linear(false, false, -3, 17);
  CHECK(linear.place(10) - linear.place(5) == doctest::Approx(linear.place(5) - linear.place(0)));
  CHECK(linear.place(-3) >= 0);
  CHECK(linear.place(17) <= 1);
  for (const Tick& tick : linear.ticks()) CHECK(std::abs(std::remainder(tick.value, 5)) < 1e-12);
  const Axis decades(true, true, 0.03, 2);
  CHECK(decades.place(0.01) == doctest::Approx(0));
  CHECK(decades.place(10) == doctest::Approx(1));
  CHECK(decades.place(0.1) == doctest::Approx(1.0 / 3));
  CHECK(linear.label(-5) == "−5");
  CHECK(Axis(false, false, -0.001, 100).place(0) == 0);  // a hair of penetration doesn't double the range of a gap
}

TEST_CASE("points are drawn in proportion, in the unit of the label, and without those that are not finite") {
  Chart chart = line_chart({0, 1, 2, 3, 4}, {0, 0.001, NAN, 0.002, 0.004});
  chart.factor = 1e3;
  const auto lines = polylines(chart_svg({chart}));
  REQUIRE(lines.size() == 1);
  REQUIRE(lines[0].size() == 4);
  const auto& p = lines[0];
  CHECK(p[1].first - p[0].first == doctest::Approx((p[3].first - p[0].first) / 4).epsilon(1e-3));  // pixels to a tenth
  CHECK(p[2].second - p[0].second == doctest::Approx((p[3].second - p[0].second) / 2).epsilon(1e-3));
  CHECK(p[0].second > p[3].second);  // up is more
  CHECK(chart_svg({chart}).find(">4</text>") != std::string::npos);
  CHECK(chart_svg({chart}).find("y, N") != std::string::npos);
}

TEST_CASE("a long curve keeps its spike, and one that returns keeps all its points") {
  std::vector<double> x, y, loop_x, loop_y;
  for (int i = 0; i < 100000; ++i) {
    x.push_back(i);
    y.push_back(i == 65432 ? 7.0 : 0.5 * std::sin(1e-3 * i));
    loop_x.push_back(std::cos(1e-3 * i)), loop_y.push_back(std::sin(1e-3 * i));
  }
  const auto spike = polylines(chart_svg({line_chart(x, y)}));
  CHECK(spike.at(0).size() < 5000);
  const auto top = *std::min_element(spike[0].begin(), spike[0].end(), [](auto a, auto b) { return a.second < b.second; });
  CHECK(top.first == doctest::Approx(84 + 520 * 0.65432).epsilon(1e-3));
  Chart circle = line_chart(loop_x, loop_y);
  circle.equal = true;
  double low = 1e9, high = -1e9, left = 1e9, right = -1e9;
  const auto loop = polylines(chart_svg({circle}));
  for (const auto& [px, py] : loop.at(0)) {
    low = std::min(low, py), high = std::max(high, py), left = std::min(left, px), right = std::max(right, px);
  }
  CHECK(high - low == doctest::Approx(right - left).epsilon(2e-3));
}

TEST_CASE("a sheet has the size asked for, or says that its charts need more") {
  const std::vector<Chart> charts{line_chart({0, 1}, {0, 1}), line_chart({0, 1}, {0, 2})};
  const std::string svg = chart_svg(charts, {"heading <of> all", 700, 520});
  CHECK(svg.find("width=\"700\" height=\"520\" viewBox=\"0 0 700 520\"") != std::string::npos);
  CHECK(svg.find("heading &lt;of&gt; all") != std::string::npos);
  for (const auto& line : polylines(svg)) {
    for (const auto& [x, y] : line) CHECK((x > 0 && x < 700 && y > 0 && y < 520));
  }
  CHECK_THROWS_WITH_AS(chart_svg(charts, {"", 200, 0}), doctest::Contains("too small"), InputError);
  CHECK_THROWS_WITH_AS(chart_svg(charts, {"", 0, 300}), doctest::Contains("too small for 2 charts"), InputError);
}

TEST_CASE("stems, marks and dashes are drawn, and marks beyond the axis are not") {
  Chart chart = line_chart({1, 2, 3}, {4, 5, 6});
  chart.stems = true;
  chart.from = 0, chart.to = 4;
  CHECK(count(chart_svg({chart}), "<circle") == 4);  // one in the legend
  chart.stems = false;
  chart.marks = {0.5, 3.5, 9};
  chart.mark_name = "pounding";
  const std::string svg = chart_svg({chart});
  CHECK(count(svg, "<path") == 3);  // one in the legend
  CHECK(svg.find(">pounding<") != std::string::npos);
  CHECK(count(svg, "stroke-dasharray") == 0);
  chart.curves[0].dashed = true;
  CHECK(count(chart_svg({chart}), "stroke-dasharray") == 2);
}

TEST_CASE("nothing to draw is no picture, and names of files say which picture") {
  CHECK(chart_svg({line_chart({1, 2}, {NAN, NAN})}).empty());
  CHECK(picture("a.svg", {line_chart({0, 1}, {0, 1})}).starts_with("<svg"));
  CHECK_THROWS_WITH_AS(picture("a.pdf", {}), doctest::Contains(".svg or .png"), InputError);
}
