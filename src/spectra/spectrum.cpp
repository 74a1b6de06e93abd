#include "spectra/spectrum.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

#include "base/types.hpp"
#include "spectra/oscillators.hpp"
#include "spectra/spectrum_kernel.hpp"

namespace nsframe {

namespace {

// Largest |u| of a free vibration that begins with u and u' = v (theory.md, 310).
double free_peak(double u, double v, double period, double xi) {
  const double w = 2 * pi / period, wd = w * std::sqrt(1 - xi * xi), b = (v + xi * w * u) / wd;
  double phase = std::atan2(v, u * wd + xi * w * b);
  if (phase < 0) phase += pi;
  return std::max(std::abs(u), std::abs(std::exp(-xi * w / wd * phase) * (u * std::cos(phase) + b * std::sin(phase))));
}

void check(std::span<const double> acceleration) {
  if (acceleration.empty()) throw std::invalid_argument("a spectrum needs a record with values");
}

std::vector<double> part(const std::vector<double>& periods, std::size_t first) {
  return {periods.begin() + static_cast<std::ptrdiff_t>(first),
          periods.begin() + static_cast<std::ptrdiff_t>(std::min(first + block_periods, periods.size()))};
}

SpectrumBlock block_of(const OscillatorStep& step, std::size_t count) {
  SpectrumBlock block;
  block.piece = step.piece();
  block.pieces = step.pieces();
  for (std::size_t i = 0; i < block_periods; ++i) {
    const auto c = step.coefficients(std::min(i, count - 1));
    block.uu[i] = c.uu, block.uv[i] = c.uv, block.ua[i] = c.ua, block.ub[i] = c.ub;
    block.vu[i] = c.vu, block.vv[i] = c.vv, block.va[i] = c.va, block.vb[i] = c.vb;
  }
  return block;
}

}  // namespace

std::vector<double> spectral_displacement(std::span<const double> acceleration, double dt,
                                          const std::vector<double>& periods, const SpectrumOptions& options) {
  check(acceleration);
  std::vector<double> out;
  for (std::size_t first = 0; first < periods.size(); first += block_periods) {
    const std::vector<double> some = part(periods, first);
    SpectrumBlock block = block_of(OscillatorStep(some, options.damping, dt), some.size());
    run_block(block, acceleration, options.at_samples);
    for (std::size_t i = 0; i < some.size(); ++i)
      out.push_back(options.at_samples
                        ? block.peak[i]
                        : std::max(block.peak[i], free_peak(block.u[i], block.v[i], some[i], options.damping)));
  }
  return out;
}

std::vector<double> spectral_displacement_scalar(std::span<const double> acceleration, double dt,
                                                 const std::vector<double>& periods, const SpectrumOptions& options) {
  check(acceleration);
  std::vector<double> out;
  for (std::size_t first = 0; first < periods.size(); first += block_periods) {
    const std::vector<double> some = part(periods, first);
    const OscillatorStep step(some, options.damping, dt);
    Oscillators oscillators(some.size());
    std::vector<double> sampled(some.size());
    for (std::size_t i = 0; i + 1 < acceleration.size(); ++i) {
      oscillators.advance(step, acceleration[i], acceleration[i + 1]);
      for (std::size_t k = 0; k < some.size(); ++k)
        sampled[k] = std::max(sampled[k], std::abs(oscillators.displacement()[k]));
    }
    for (std::size_t k = 0; k < some.size(); ++k) {
      const double after =
          free_peak(oscillators.displacement()[k], oscillators.velocity()[k], some[k], options.damping);
      out.push_back(options.at_samples ? sampled[k] : std::max(oscillators.peak()[k], after));
    }
  }
  return out;
}

}  // namespace nsframe
