// Response spectra of whole records: oscillators at rest before the record, a base acceleration that is linear between
// its samples and zero after the last one (theory.md, 120-122, 310-311). Arrays are by period.
#pragma once

#include <span>
#include <vector>

namespace nsframe {

struct SpectrumOptions {
  double damping = 0.05;    // ratio, in [0, 1)
  bool at_samples = false;  // peaks at the samples of the record only, as in most books and programs; else also between
                            // them (there within 2e-4) and after the end
};

// Largest relative displacements [m] under accelerations [m/s2] each dt [s]. Periods of any order, all positive; throws
// std::invalid_argument as OscillatorStep. Many periods at a time, by SIMD.
std::vector<double> spectral_displacement(std::span<const double> acceleration, double dt,
                                          const std::vector<double>& periods, const SpectrumOptions& options = {});

// The same by Oscillators, one sample after the other: the definition that the former is tested against.
std::vector<double> spectral_displacement_scalar(std::span<const double> acceleration, double dt,
                                                 const std::vector<double>& periods,
                                                 const SpectrumOptions& options = {});

// Two horizontal components: the largest displacement along each of 180 directions a degree apart (Boore 2010, RotDnn).
struct RotatedSpectrum {
  std::vector<double> first, second;    // of the components [m]
  std::vector<double> rotd50, rotd100;  // median and largest over the directions [m]
};

// Components of the same length and step; between samples within 5e-4. Throws std::invalid_argument.
RotatedSpectrum rotated_spectrum(std::span<const double> first, std::span<const double> second, double dt,
                                 const std::vector<double>& periods, const SpectrumOptions& options = {});

}  // namespace nsframe
