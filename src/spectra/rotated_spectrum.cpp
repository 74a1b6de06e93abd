// Peaks of an oscillator on a base that moves in a plane, along directions a degree apart.
#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

#include "spectra/oscillators.hpp"
#include "base/types.hpp"
#include "spectra/spectrum.hpp"

namespace nsframe {

namespace {

constexpr std::size_t directions = 180;
constexpr double fine =
    0.05;  // w times the distance of the places looked at: a peak between is missed by (fine / 2)^2 / 2

struct Plane {
  double u, v;  // [m], [m/s]
};

// Largest |p . d| of points along each direction d of the half circle. Points are collected; those within the polygon
// of the points that reach furthest along a few directions change nothing and are left out.
class DirectionPeaks {
 public:
  DirectionPeaks() {
    for (std::size_t k = 0; k < directions; ++k) {
      cosine_[k] = std::cos(pi * static_cast<double>(k) / directions);
      sine_[k] = std::sin(pi * static_cast<double>(k) / directions);
    }
    x_.reserve(most_points);
    y_.reserve(most_points);
  }

  void add(double x, double y) {
    x_.push_back(x);
    y_.push_back(y);
    if (x_.size() == most_points) sort_out();
  }

  // Median and largest over the directions.
  std::array<double, 2> finish() {
    sort_out();
    std::sort(peak_.begin(), peak_.end());
    return {0.5 * (peak_[directions / 2 - 1] + peak_[directions / 2]), peak_.back()};
  }

 private:
  static constexpr std::size_t most_points = 4096, corners = 8;

  void sort_out() {
    find_corners();
    std::array<double, corners> nx, ny, reach;  // of the edges: inside where |n . p| <= reach
    for (std::size_t j = 0; j < corners; ++j) {
      const bool last = j + 1 == corners;  // the polygon is symmetric: the other half follows
      const double tx = last ? -corner_x_[0] : corner_x_[j + 1], ty = last ? -corner_y_[0] : corner_y_[j + 1];
      nx[j] = ty - corner_y_[j];
      ny[j] = corner_x_[j] - tx;
      reach[j] = nx[j] * corner_x_[j] + ny[j] * corner_y_[j];
    }
    outside_.assign(x_.size(), 0);
    for (std::size_t j = 0; j < corners; ++j)
      for (std::size_t i = 0; i < x_.size(); ++i)
        outside_[i] = std::max(outside_[i], std::abs(nx[j] * x_[i] + ny[j] * y_[i]) - reach[j]);
    for (std::size_t i = 0; i < x_.size(); ++i)
      if (outside_[i] > 0) compare(x_[i], y_[i]);
    for (std::size_t j = 0; j < corners; ++j) compare(corner_x_[j], corner_y_[j]);
    x_.clear();
    y_.clear();
  }

  void find_corners() {
    for (std::size_t j = 0; j < corners; ++j) {
      const double c = cosine_[j * directions / corners], s = sine_[j * directions / corners];
      double most = corner_x_[j] * c + corner_y_[j] * s;
      for (std::size_t i = 0; i < x_.size(); ++i) {
        const double along = x_[i] * c + y_[i] * s;
        if (std::abs(along) <= most) continue;
        most = std::abs(along);
        corner_x_[j] = std::copysign(1.0, along) * x_[i];
        corner_y_[j] = std::copysign(1.0, along) * y_[i];
      }
    }
  }

  void compare(double x, double y) {
    for (std::size_t k = 0; k < directions; ++k) peak_[k] = std::max(peak_[k], std::abs(x * cosine_[k] + y * sine_[k]));
  }

  std::array<double, directions> cosine_, sine_, peak_{};
  std::array<double, corners> corner_x_{}, corner_y_{};
  std::vector<double> x_, y_, outside_;
};

Plane advanced(const OscillatorStep::Coefficients& c, const Plane& s, double a0, double a1) {
  return {c.uu * s.u + c.uv * s.v + c.ua * a0 + c.ub * a1, c.vu * s.u + c.vv * s.v + c.va * a0 + c.vb * a1};
}

// Of the cubic with the values and slopes of both ends, at the fraction s between.
double between(const Plane& from, const Plane& to, double h, double s) {
  const double cubic = h * (from.v + to.v) - 2 * (to.u - from.u),
               square = 3 * (to.u - from.u) - h * (2 * from.v + to.v);
  return from.u + s * (h * from.v + s * (square + s * cubic));
}

// One oscillator over the record and half a period after it.
std::array<double, 2> peaks_of(std::span<const double> first, std::span<const double> second, double dt, double period,
                               const SpectrumOptions& options) {
  const OscillatorStep step({period}, options.damping, dt);
  const OscillatorStep::Coefficients c = step.coefficients(0);
  const double h = step.piece();
  const int parts = options.at_samples ? 1 : static_cast<int>(std::ceil(2 * pi / period * h / fine));
  DirectionPeaks peaks;
  Plane x{0, 0}, y{0, 0};
  const auto advance = [&](double ax0, double ax1, double ay0, double ay1, bool keep) {
    const Plane x1 = advanced(c, x, ax0, ax1), y1 = advanced(c, y, ay0, ay1);
    for (int i = 1; i < parts; ++i)
      peaks.add(between(x, x1, h, double(i) / parts), between(y, y1, h, double(i) / parts));
    x = x1;
    y = y1;
    if (keep) peaks.add(x.u, y.u);
  };
  for (std::size_t i = 0; i + 1 < first.size(); ++i) {
    const double ax = first[i], bx = first[i + 1] - ax, ay = second[i], by = second[i + 1] - ay;
    for (int k = 0; k < step.pieces(); ++k) {
      const double s0 = double(k) / step.pieces(), s1 = double(k + 1) / step.pieces();
      advance(ax + s0 * bx, ax + s1 * bx, ay + s0 * by, ay + s1 * by, !options.at_samples || k + 1 == step.pieces());
    }
  }
  if (!options.at_samples)
    for (double t = 0; t < 0.5 * period + h; t += h) advance(0, 0, 0, 0, true);
  return peaks.finish();
}

}  // namespace

RotatedSpectrum rotated_spectrum(std::span<const double> first, std::span<const double> second, double dt,
                                 const std::vector<double>& periods, const SpectrumOptions& options) {
  if (first.empty() || first.size() != second.size())
    throw std::invalid_argument("two components need the same number of values");
  RotatedSpectrum out;
  out.first = spectral_displacement(first, dt, periods, options);
  out.second = spectral_displacement(second, dt, periods, options);
  for (const double period : periods) {
    const auto [median, largest] = peaks_of(first, second, dt, period, options);
    out.rotd50.push_back(median);
    out.rotd100.push_back(largest);
  }
  return out;
}

}  // namespace nsframe
