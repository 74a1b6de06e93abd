#include "motion/artificial.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "base/errors.hpp"
#include "base/types.hpp"
#include "motion/adjust.hpp"
#include "motion/wavelets.hpp"
#include "spectra/oscillators.hpp"
#include "spectra/spectrum.hpp"

namespace nsframe {

namespace {

constexpr int sine_iterations = 12, periods_checked = 300;
constexpr double highest_frequency = 50;  // [Hz] of the sines
constexpr double spacing = 0.5;  // of the periods that wavelets are put at, in logarithm, over the damping ratio

double misfit_of(const SpectralRatio& ratio) { return std::max(ratio.largest - 1, 1 - ratio.least); }

class Maker {
 public:
  Maker(const TargetSpectrum& target, const ArtificialOptions& options, std::mt19937& generator);
  ArtificialMotion make();

 private:
  std::vector<double> sum_of_sines() const;
  void correct_amplitudes(const std::vector<double>& acceleration);
  std::vector<double> wavelet_periods() const {
    const int count = static_cast<int>(std::ceil(std::log(options_.longest / options_.shortest) /
                                                 (spacing * std::max(target_.damping, 0.02)))) +
                      1;
    return logarithmic_periods(options_.shortest, options_.longest, std::max(count, 2));
  }
  double misfit(const std::vector<double>& acceleration) const {
    return misfit_of(
        spectral_ratio(acceleration, options_.dt, target_, options_.shortest, options_.longest, periods_checked));
  }

  const TargetSpectrum& target_;
  const ArtificialOptions& options_;
  std::size_t count_;                                  // samples
  std::vector<double> frequency_, amplitude_, phase_;  // of the sines
};

Maker::Maker(const TargetSpectrum& target, const ArtificialOptions& options, std::mt19937& generator)
    : target_(target),
      options_(options),
      count_(static_cast<std::size_t>(std::lround(options.duration / options.dt)) + 1) {
  const double step = 1 / options.duration, highest = std::min(highest_frequency, 0.4 / options.dt);
  const double lowest = std::max(step, 0.7 / options.longest);
  for (double f = lowest; f <= highest; f += step) {
    const double period = std::clamp(1 / f, options.shortest, options.longest);
    frequency_.push_back(f);
    amplitude_.push_back(target.acceleration(period) * std::sqrt(step / f));
    phase_.push_back(2 * pi * static_cast<double>(generator()) / 4294967296.0);
  }
}

std::vector<double> Maker::sum_of_sines() const {
  std::vector<double> out(count_);
  for (std::size_t k = 0; k < frequency_.size(); ++k) {
    // the sine of the next sample by a rotation
    const double turn = 2 * pi * frequency_[k] * options_.dt, c = std::cos(turn), s = std::sin(turn);
    double x = amplitude_[k] * std::cos(phase_[k]), y = amplitude_[k] * std::sin(phase_[k]);
    for (double& value : out) {
      value += y;
      const double next = c * x - s * y;
      y = s * x + c * y;
      x = next;
    }
  }
  for (std::size_t i = 0; i < count_; ++i) out[i] *= options_.envelope.at(options_.dt * static_cast<double>(i));
  return brought_to_rest(out, options_.dt);
}

// Each amplitude by the ratio of target to response at its own period; beyond the matched range, where the target goes
// on.
void Maker::correct_amplitudes(const std::vector<double>& acceleration) {
  std::vector<double> periods;
  for (const double f : frequency_)
    periods.push_back(
        std::clamp(1 / f, std::max(target_.shortest, 1e-3), std::min(target_.longest, 1.2 * options_.longest)));
  const auto psa =
      pseudo_acceleration(periods, spectral_displacement(acceleration, options_.dt, periods, {target_.damping, false}));
  for (std::size_t k = 0; k < periods.size(); ++k)
    amplitude_[k] *= std::clamp(target_.acceleration(periods[k]) / psa[k], 0.3, 3.0);
}

ArtificialMotion Maker::make() {
  ArtificialMotion best;
  best.misfit = std::numeric_limits<double>::infinity();
  const auto keep = [&](const std::vector<double>& candidate) {
    const double now = misfit(candidate);
    if (now < best.misfit) best.misfit = now, best.acceleration = candidate;
    return now;
  };
  for (int i = 0; i <= sine_iterations; ++i) {
    const std::vector<double> sines = sum_of_sines();
    keep(sines);
    if (i < sine_iterations) correct_amplitudes(sines);
  }
  best.misfit_of_sines = best.misfit;
  const std::vector<double> periods = wavelet_periods();
  std::vector<double> wanted;
  for (const double period : periods) wanted.push_back(target_.acceleration(period));
  const WaveletMatching matching(periods, wanted, target_.damping, options_.dt, count_);
  std::vector<double> present = best.acceleration;
  while (best.misfit > options_.tolerance && best.iterations < options_.max_iterations) {
    const std::vector<double> step = matching.step(present), from = present;
    double least = std::numeric_limits<double>::infinity();
    for (const double length : {1.0, 0.5, 0.25}) {
      std::vector<double> candidate = from;
      for (std::size_t i = 0; i < count_; ++i) candidate[i] += length * step[i];
      candidate = brought_to_rest(candidate, options_.dt);
      const double now = keep(candidate);
      if (now < least) least = now, present = std::move(candidate);
    }
    ++best.iterations;
  }
  return best;
}

void check(const ArtificialOptions& o) {
  const auto require = [](bool condition, const std::string& text) {
    if (!condition) throw InputError("error: " + text);
  };
  require(o.dt > 0 && o.duration >= 100 * o.dt && o.duration <= 1e6 * o.dt,
          "an artificial motion needs 100 to 1000000 steps");
  require(o.envelope.rise >= 0 && o.envelope.level >= 0 && o.envelope.decay > 0,
          "parts of the envelope must not be negative, and it must decay");
  require(o.envelope.rise + o.envelope.level <= o.duration,
          "the rise and the level part of the envelope are longer than the motion");
  require(o.shortest >= 8 * o.dt * (1 - 1e-9),
          fmt::format("periods from {:g} s need a step of {:g} s or less", o.shortest, o.shortest / 8));
  require(o.longest <= 0.5 * o.duration,
          fmt::format("periods to {:g} s need a duration of {:g} s or more", o.longest, 2 * o.longest));
  require(o.tolerance > 0, "the tolerance must be positive");
}

}  // namespace

double Envelope::at(double time) const {
  if (time < rise) return (time / rise) * (time / rise);
  return time <= rise + level ? 1 : std::exp(-decay * (time - rise - level));
}

ArtificialMotion artificial_motion(const TargetSpectrum& target, const ArtificialOptions& options) {
  check_range(target, options.shortest, options.longest);
  check(options);
  std::mt19937 generator(options.seed);
  ArtificialMotion best;
  best.misfit = std::numeric_limits<double>::infinity();
  for (int draw = 1; draw <= options.max_draws; ++draw) {
    ArtificialMotion one = Maker(target, options, generator).make();
    one.draws = draw;
    if (one.misfit < best.misfit) best = std::move(one);
    if (best.misfit <= options.tolerance) return best;
  }
  throw ConvergenceError(fmt::format(
      "the spectrum still differs by {:.1f} % from the target after {} sets of phases, more than the tolerance of "
      "{:g} %: try another seed, a longer duration or a shorter range of periods",
      100 * best.misfit, options.max_draws, 100 * options.tolerance));
}

}  // namespace nsframe
