#include "motion/adjust.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "base/types.hpp"
#include "motion/equations.hpp"
#include "motion/history.hpp"

namespace nsframe {

namespace {

// y = (b0 x + b1 x' + b2 x'') - (a1 y' + a2 y''), primes: one and two samples before
struct Section {
  double b0, b1, b2, a1, a2;
};

// One second-order (q > 0) or first-order (q = 0) part with its corner at k = tan(pi f dt), low-pass or high-pass.
Section section(double k, double q, bool high) {
  if (q == 0) {
    const double scale = 1 / (1 + k);
    return high ? Section{scale, -scale, 0, (k - 1) * scale, 0} : Section{k * scale, k * scale, 0, (k - 1) * scale, 0};
  }
  const double scale = 1 / (1 + k / q + k * k), gain = high ? scale : k * k * scale, middle = high ? -2 : 2;
  return {gain, middle * gain, gain, 2 * (k * k - 1) * scale, (1 - k / q + k * k) * scale};
}

std::vector<Section> butterworth(double corner, double dt, int order, bool high) {
  const double k = std::tan(pi * corner * dt);
  std::vector<Section> sections;
  for (int i = 0; i < order / 2; ++i)
    sections.push_back(section(k, 1 / (2 * std::sin(pi * (2 * i + 1) / (2 * order))), high));
  if (order % 2 == 1) sections.push_back(section(k, 0, high));
  return sections;
}

void pass(const std::vector<Section>& sections, std::vector<double>& values) {
  for (const Section& s : sections) {
    double x1 = 0, x2 = 0, y1 = 0, y2 = 0;
    for (double& value : values) {
      const double x = value;
      value = s.b0 * x + s.b1 * x1 + s.b2 * x2 - s.a1 * y1 - s.a2 * y2;
      x2 = x1, x1 = x, y2 = y1, y1 = value;
    }
  }
}

void check(const BandPass& options, double dt) {
  const double nyquist = 0.5 / dt;
  if (options.order < 1 || options.order > 10) throw std::invalid_argument("the order of a filter must lie in [1, 10]");
  if (options.from < 0 || options.to < 0 || (options.from == 0 && options.to == 0))
    throw std::invalid_argument("a filter needs a corner frequency above 0");
  if (options.from >= nyquist || options.to >= nyquist)
    throw std::invalid_argument("corner frequencies must lie below half the sampling frequency");
  if (options.from > 0 && options.to > 0 && options.from >= options.to)
    throw std::invalid_argument("the corners of a band-pass must rise");
}

}  // namespace

std::vector<double> baseline_corrected(std::span<const double> acceleration, double dt, int degree) {
  if (degree < 0 || degree > 6) throw std::invalid_argument("the degree of a baseline must lie in [0, 6]");
  const std::size_t count = acceleration.size(), n = static_cast<std::size_t>(degree) + 1;
  if (count < n + 1) throw std::invalid_argument("a record is too short for its baseline");
  const std::vector<double> velocity = integrate(acceleration, dt).velocity;
  const double duration = dt * static_cast<double>(count - 1);
  std::vector<double> A(n * n), b(n);  // unknowns: coefficients of (t / duration)^k in the acceleration
  for (std::size_t i = 0; i < count; ++i) {
    const double s = static_cast<double>(i) / static_cast<double>(count - 1);
    const double weight = i == 0 || i + 1 == count ? 0.5 : 1;
    std::vector<double> basis(n);
    for (std::size_t k = 0; k < n; ++k)
      basis[k] = duration * std::pow(s, static_cast<double>(k + 1)) / static_cast<double>(k + 1);
    for (std::size_t k = 0; k < n; ++k) {
      b[k] += weight * basis[k] * velocity[i];
      for (std::size_t l = 0; l < n; ++l) A[k * n + l] += weight * basis[k] * basis[l];
    }
  }
  const std::vector<double> c = solve_equations(std::move(A), std::move(b));
  std::vector<double> out(acceleration.begin(), acceleration.end());
  for (std::size_t i = 0; i < count; ++i) {
    const double s = static_cast<double>(i) / static_cast<double>(count - 1);
    for (std::size_t k = n; k-- > 0;) out[i] -= c[k] * std::pow(s, static_cast<double>(k));
  }
  return out;
}

std::vector<double> brought_to_rest(std::span<const double> acceleration, double dt) {
  std::vector<double> out(acceleration.begin(), acceleration.end());
  if (out.size() < 4) throw std::invalid_argument("a record is too short to be brought to rest");
  const auto shape = [&](int k, std::size_t i) {
    const double s = static_cast<double>(i) / static_cast<double>(out.size() - 1);
    return s * (1 - s) * (k == 0 ? 1 : s);
  };
  double v[3], d[3];  // at the end: of the record, and of the two shapes
  std::vector<double> one(out.size());
  for (int k = -1; k < 2; ++k) {
    for (std::size_t i = 0; i < out.size(); ++i) one[i] = k < 0 ? out[i] : shape(k, i);
    const GroundHistory history = integrate(one, dt);
    v[k + 1] = history.velocity.back();
    d[k + 1] = history.displacement.back();
  }
  const std::vector<double> c = solve_equations({v[1], v[2], d[1], d[2]}, {v[0], d[0]});
  for (std::size_t i = 0; i < out.size(); ++i) out[i] -= c[0] * shape(0, i) + c[1] * shape(1, i);
  return out;
}

Filtered band_passed(std::span<const double> acceleration, double dt, const BandPass& options) {
  check(options, dt);
  // transients of the high-pass die out over 1.5 order / corner (Boore 2005); of a low-pass sooner
  const double slowest = options.from > 0 ? options.from : options.to;
  const auto pad = static_cast<std::size_t>(std::ceil(1.5 * options.order / slowest / dt));
  std::vector<double> values(acceleration.size() + 2 * pad);
  std::copy(acceleration.begin(), acceleration.end(), values.begin() + static_cast<std::ptrdiff_t>(pad));
  std::vector<Section> sections;
  if (options.from > 0) sections = butterworth(options.from, dt, options.order, true);
  if (options.to > 0)
    for (const Section& s : butterworth(options.to, dt, options.order, false)) sections.push_back(s);
  pass(sections, values);
  std::reverse(values.begin(), values.end());
  pass(sections, values);
  std::reverse(values.begin(), values.end());
  const GroundHistory history = integrate(values, dt);
  if (options.keep_pads)
    return {values, -dt * static_cast<double>(pad), history.velocity[pad], history.displacement[pad]};
  const auto first = values.begin() + static_cast<std::ptrdiff_t>(pad);
  return {{first, first + static_cast<std::ptrdiff_t>(acceleration.size())},
          0,
          history.velocity[pad],
          history.displacement[pad]};
}

std::vector<double> rotated(std::span<const double> first, std::span<const double> second, double angle) {
  std::vector<double> out(std::max(first.size(), second.size()));
  for (std::size_t i = 0; i < first.size(); ++i) out[i] += std::cos(angle) * first[i];
  for (std::size_t i = 0; i < second.size(); ++i) out[i] += std::sin(angle) * second[i];
  return out;
}

}  // namespace nsframe
