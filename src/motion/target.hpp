// Target spectra of pseudo-acceleration: shapes of codes, or a table; and how far a record is from one.
#pragma once

#include <filesystem>
#include <functional>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "motion/units.hpp"

namespace nsframe {

struct TargetSpectrum {
  std::string name;
  double damping = 0.05;  // ratio it is for
  double shortest = 0;    // periods it is given for [s]
  double longest = std::numeric_limits<double>::infinity();
  std::function<double(double)> acceleration;  // [m/s2] at a period [s]
};

// Horizontal elastic spectrum of EN 1998-1:2004, 3.2.2.2, periods to 4 s.
struct Eurocode8 {
  int type = 1;           // 1 or 2
  char ground = 'A';      // A to E
  double ag = 0;          // design ground acceleration on type A ground [m/s2]
  double damping = 0.05;  // ratio
};
TargetSpectrum eurocode8(const Eurocode8& parameters);  // throws InputError

// Design response spectrum of ASCE/SEI 7-16, 11.4.6.
struct Asce7 {
  double sds = 0, sd1 = 0;  // [m/s2]
  double tl = 8;            // long-period transition [s]
};
TargetSpectrum asce7(const Asce7& parameters);  // throws InputError

// Rows of period [s] and pseudo-acceleration, periods rising, linear between; the unit from the file ("# unit: g", or a
// heading "period [s], PSA [g]") or declared. Throws RecordError, IoError.
TargetSpectrum target_table(const std::filesystem::path& file, std::optional<AccelerationUnit> unit, double damping);

// Factors from the target to the record's pseudo-acceleration, over periods evenly spaced in logarithm (theory.md,
// 318).
struct SpectralRatio {
  double least = 0, largest = 0, mean = 0;  // mean: geometric
  double least_at = 0, largest_at = 0;      // periods [s]
};
SpectralRatio spectral_ratio(std::span<const double> acceleration, double dt, const TargetSpectrum& target,
                             double shortest, double longest, int count = 200);

// Throws InputError unless the target is given for these periods.
void check_range(const TargetSpectrum& target, double shortest, double longest);

}  // namespace nsframe
