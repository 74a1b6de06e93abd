// Wavelets that bring the spectrum of an acceleration to a target (Al Atik, Abrahamson 2010; theory.md, 322-323).
#pragma once

#include <span>
#include <vector>

namespace nsframe {

class WaveletMatching {
 public:
  // Periods [s] and the pseudo-accelerations wanted there [m/s2]; records of `samples` values each dt [s].
  WaveletMatching(std::vector<double> periods, std::vector<double> wanted, double damping, double dt,
                  std::size_t samples);

  // What to add to the acceleration: one step of Newton's method for the largest response of every oscillator, which
  // keeps other extremes of the responses, among the next largest, below the target.
  std::vector<double> step(std::span<const double> acceleration) const;

 private:
  struct Extreme {
    std::size_t oscillator, sample;
    double ratio;  // signed response at it over the target
  };
  std::vector<double> response(std::size_t oscillator, std::span<const double> acceleration) const;  // over the target
  std::vector<Extreme> extremes(std::size_t oscillator, std::span<const double> acceleration) const;
  struct Wavelet {
    std::size_t first;  // sample
    std::vector<double> values;
  };
  Wavelet wavelet(const Extreme& at) const;
  double response(const Extreme& at, const Wavelet& wavelet) const;

  std::vector<double> periods_, wanted_;
  double damping_, dt_;
  std::vector<std::vector<double>>
      pulse_;  // response of each oscillator to an acceleration of one at one sample, over the target
};

}  // namespace nsframe
