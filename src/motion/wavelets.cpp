#include "motion/wavelets.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/types.hpp"
#include "motion/equations.hpp"
#include "spectra/oscillators.hpp"
#include "spectra/spectrum.hpp"

namespace nsframe {

namespace {

constexpr double regularisation = 0.02;  // of the wavelets' amplitudes, relative to the squared response of one
constexpr double next_largest = 0.85;    // extremes above this share of the largest are watched
constexpr std::size_t most_watched = 3;  // of an oscillator
constexpr int rounds = 4;                // in which watched extremes that would pass the target are added
constexpr double reach = 2.6;            // of a wavelet, in its widths: exp(-reach^2) = 1e-3

}  // namespace

WaveletMatching::WaveletMatching(std::vector<double> periods, std::vector<double> wanted, double damping, double dt,
                                 std::size_t samples)
    : periods_(std::move(periods)), wanted_(std::move(wanted)), damping_(damping), dt_(dt) {
  std::vector<double> pulse(samples + 1);
  pulse[1] = 1;
  for (std::size_t k = 0; k < periods_.size(); ++k) {
    pulse_.push_back(response(k, pulse));
    pulse_.back().erase(pulse_.back().begin());
  }
}

std::vector<double> WaveletMatching::response(std::size_t oscillator, std::span<const double> a) const {
  const OscillatorStep step({periods_[oscillator]}, damping_, dt_);
  const double scale = std::pow(2 * pi / periods_[oscillator], 2) / wanted_[oscillator];
  Oscillators one(1);
  std::vector<double> out{0};
  for (std::size_t i = 0; i + 1 < a.size(); ++i) {
    one.advance(step, a[i], a[i + 1]);
    out.push_back(scale * one.displacement()[0]);
  }
  return out;
}

// The largest first. Peaks between samples exceed those at samples, all by about the same factor.
std::vector<WaveletMatching::Extreme> WaveletMatching::extremes(std::size_t oscillator,
                                                                std::span<const double> a) const {
  const std::vector<double> values = response(oscillator, a);
  std::vector<Extreme> out;
  for (std::size_t i = 1; i < values.size(); ++i) {
    const double size = std::abs(values[i]);
    if (size >= std::abs(values[i - 1]) && (i + 1 == values.size() || size > std::abs(values[i + 1])))
      out.push_back({oscillator, i, values[i]});
  }
  std::sort(out.begin(), out.end(),
            [](const Extreme& x, const Extreme& y) { return std::abs(x.ratio) > std::abs(y.ratio); });
  if (out.empty()) return {{oscillator, 0, 0}};
  const double largest = std::abs(out.front().ratio);
  while (out.size() > most_watched || std::abs(out.back().ratio) < next_largest * largest) out.pop_back();
  const double peak = spectral_displacement(a, dt_, {periods_[oscillator]}, {damping_, false}).front() *
                      std::pow(2 * pi / periods_[oscillator], 2) / wanted_[oscillator];
  for (Extreme& e : out) e.ratio *= peak / largest;
  return out;
}

// A cosine under a bell, placed so that the oscillator of its period responds most at that sample.
WaveletMatching::Wavelet WaveletMatching::wavelet(const Extreme& at) const {
  const double period = periods_[at.oscillator], root = std::sqrt(1 - damping_ * damping_), w = 2 * pi / period * root;
  const double width = 1.178 * std::pow(period, 0.93),
               centre = dt_ * static_cast<double>(at.sample) - std::atan2(root, damping_) / w;
  Wavelet out;
  const double first = std::max(std::ceil((centre - reach * width) / dt_), 0.0), last = (centre + reach * width) / dt_;
  out.first = static_cast<std::size_t>(first);
  for (std::size_t i = out.first; i < pulse_.front().size() && static_cast<double>(i) <= last; ++i) {
    const double s = dt_ * static_cast<double>(i) - centre;
    out.values.push_back(std::cos(w * s) * std::exp(-(s / width) * (s / width)));
  }
  return out;
}

double WaveletMatching::response(const Extreme& at, const Wavelet& wavelet) const {
  if (at.sample < wavelet.first) return 0;
  const std::vector<double>& pulse = pulse_[at.oscillator];
  const std::size_t count = std::min(wavelet.values.size(), at.sample - wavelet.first + 1);
  double sum = 0;
  for (std::size_t i = 0; i < count; ++i) sum += pulse[at.sample - wavelet.first - i] * wavelet.values[i];
  return sum;
}

std::vector<double> WaveletMatching::step(std::span<const double> a) const {
  std::vector<Extreme> all;  // the largest of every oscillator, then the watched ones
  std::vector<Extreme> watched;
  for (std::size_t k = 0; k < periods_.size(); ++k) {
    const std::vector<Extreme> found = extremes(k, a);
    all.push_back(found.front());
    watched.insert(watched.end(), found.begin() + 1, found.end());
  }
  const std::size_t largest = all.size();
  all.insert(all.end(), watched.begin(), watched.end());
  const std::size_t n = all.size();
  std::vector<Wavelet> wavelets;
  for (const Extreme& e : all) {
    wavelets.push_back(wavelet(e));
    const double own = response(e, wavelets.back());
    for (double& value : wavelets.back().values) value *= own != 0 ? std::copysign(1.0, e.ratio) / own : 0;
  }
  std::vector<double> C(n * n);  // growth of extreme i by wavelet j
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < n; ++j) C[i * n + j] = std::copysign(1.0, all[i].ratio) * response(all[i], wavelets[j]);
  std::vector<std::size_t> rows(largest);
  std::iota(rows.begin(), rows.end(), std::size_t{0});
  std::vector<double> amount;
  for (int round = 0; round < rounds; ++round) {
    const std::size_t m = rows.size();
    std::vector<double> A(m * m), b(m);
    for (std::size_t i = 0; i < m; ++i)
      for (std::size_t k = 0; k < m; ++k) {
        const double c = C[rows[k] * n + rows[i]];
        b[i] += c * (1 - std::abs(all[rows[k]].ratio));
        for (std::size_t j = 0; j < m; ++j) A[i * m + j] += c * C[rows[k] * n + rows[j]];
      }
    for (std::size_t i = 0; i < m; ++i) A[i * m + i] += regularisation;
    amount = solve_equations(std::move(A), std::move(b));
    std::vector<std::size_t> passing;
    for (std::size_t i = largest; i < n; ++i) {
      if (std::find(rows.begin(), rows.end(), i) != rows.end()) continue;
      double ratio = std::abs(all[i].ratio);
      for (std::size_t j = 0; j < m; ++j) ratio += C[i * n + rows[j]] * amount[j];
      if (ratio > 1) passing.push_back(i);
    }
    if (passing.empty() || round + 1 == rounds) break;
    rows.insert(rows.end(), passing.begin(), passing.end());
  }
  std::vector<double> out(a.size());
  for (std::size_t j = 0; j < rows.size(); ++j) {
    const Wavelet& w = wavelets[rows[j]];
    for (std::size_t i = 0; i < w.values.size(); ++i) out[w.first + i] += amount[j] * w.values[i];
  }
  return out;
}

}  // namespace nsframe
