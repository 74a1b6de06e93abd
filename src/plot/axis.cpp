#include "plot/axis.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace nsframe {

namespace {

constexpr double tick_slack = 0.02;  // of the distance of two ticks, that a value may lie outside the range: less than a pixel

}  // namespace

Axis::Axis(bool logarithmic, bool tight, double least, double most) : log_(logarithmic) {
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
  first_ = step_ * std::floor(least / step_ + tick_slack);
  last_ = step_ * std::ceil(most / step_ - tick_slack);
  if (!(last_ > first_)) last_ = first_ + step_;
  tick_ = first_;
  if (tight && most > least) {
    first_ = least;
    last_ = most;
    tick_ = step_ * std::ceil(least / step_ - 1e-9);
  }
}

double Axis::place(double value) const { return ((log_ ? std::log10(value) : value) - first_) / (last_ - first_); }

std::vector<Tick> Axis::ticks() const {
  std::vector<Tick> out;
  if (!log_) {
    for (int i = 0; tick_ + i * step_ <= last_ + 1e-9 * step_; ++i) out.push_back({tick_ + i * step_, true});
    return out;
  }
  for (int decade = static_cast<int>(first_); decade <= static_cast<int>(last_); ++decade) {
    for (int k = 1; k <= (decade == static_cast<int>(last_) ? 1 : 9); ++k) out.push_back({k * std::pow(10.0, decade), k == 1});
  }
  return out;
}

std::string Axis::label(double value) const {
  const auto with_minus = [](std::string text) {  // of typography, as wide as a plus
    if (text.starts_with('-')) text.replace(0, 1, "−");
    return text;
  };
  if (!log_) return with_minus(fmt::format("{:.6g}", std::abs(value) < 1e-9 * step_ ? 0.0 : value));
  const std::string power = with_minus(fmt::format("{:.0f}", std::round(std::log10(value))));
  return fmt::format("10<tspan dy=\"-6\" font-size=\"10\">{}</tspan>", power);
}

}  // namespace nsframe
