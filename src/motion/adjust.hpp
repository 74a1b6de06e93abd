// What is done to accelerations before they are used: baseline, filter, rotation.
#pragma once

#include <span>
#include <vector>

namespace nsframe {

// Takes the polynomial of time of `degree` (0 to 6) from the acceleration for which the integral of velocity squared is
// least (theory.md, 314). Throws std::invalid_argument.
std::vector<double> baseline_corrected(std::span<const double> acceleration, double dt, int degree);

// Takes from the acceleration a polynomial that leaves velocity and displacement zero at the end; it is zero at both
// ends (theory.md, 315).
std::vector<double> brought_to_rest(std::span<const double> acceleration, double dt);

struct BandPass {
  double from = 0;         // corner of the high-pass [Hz]; 0: none
  double to = 0;           // corner of the low-pass [Hz]; 0: none
  int order = 4;           // of each, 1 to 10, and of each of the two passes
  bool keep_pads = false;  // the result begins and ends with what the filter brings before and after the record
};
struct Filtered {
  std::vector<double> acceleration;
  double begins = 0;  // [s]: time of the first value, negative with pads
  double velocity = 0,
         displacement = 0;  // of the filtered motion at the start of the record, at rest long before [m/s], [m]
};
// Butterworth filters, once forwards and once backwards, so without shift of phase: the amplitude at a corner is halved
// (theory.md, 316-317). Zeros are put before and after the record (Boore 2005). Throws std::invalid_argument.
Filtered band_passed(std::span<const double> acceleration, double dt, const BandPass& options);

// Along the direction at `angle` [rad] from the first component towards the second; the shorter one goes on with zeros.
std::vector<double> rotated(std::span<const double> first, std::span<const double> second, double angle);

}  // namespace nsframe
