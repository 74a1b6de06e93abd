// Artificial accelerograms whose spectrum matches a target: sines with random phases under an envelope, their
// amplitudes corrected in turns (Gasparini, Vanmarcke 1976), then wavelets added at the times of the peaks (Al Atik,
// Abrahamson 2010); theory.md, 319-323.
#pragma once

#include <cstdint>

#include "motion/target.hpp"

namespace nsframe {

// Rises with the square of time, stays at one, falls exponentially (Jennings, Housner, Tsai 1968).
struct Envelope {
  double rise = 2, level = 10;  // lengths of the two parts [s]
  double decay = 0.3;           // rate of the fall [1/s]
  double at(double time) const;
};

struct ArtificialOptions {
  double duration = 20, dt = 0.005;  // [s]
  Envelope envelope;
  double shortest = 0, longest = 0;  // periods between which the spectrum must match [s]
  double tolerance = 0.08;           // largest relative difference from the target there
  std::uint32_t seed = 1;
  int max_iterations = 15;  // of the wavelets, for one set of phases
  int max_draws = 12;       // of sets of phases, one after the other from the same seed
};

struct ArtificialMotion {
  std::vector<double> acceleration;  // [m/s2]; velocity and displacement are zero at the end
  double misfit = 0;                 // largest relative difference from the target over 300 periods
  double misfit_of_sines = 0;        // the same before wavelets
  int iterations = 0, draws = 0;
};

// Throws InputError for options that contradict each other, ConvergenceError when the tolerance is not reached.
ArtificialMotion artificial_motion(const TargetSpectrum& target, const ArtificialOptions& options);

}  // namespace nsframe
