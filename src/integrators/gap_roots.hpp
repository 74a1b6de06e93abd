// Where a gap can close within an interval, from its values and rates at both ends and a bound on its fourth derivative: the cubic
// through them is off by at most bound h^4 / 384 (theory.md, 154). And first roots of polynomials in Bernstein form.
#pragma once

#include "base/types.hpp"

namespace nsframe {

// A gap over an interval of length h.
struct GapPiece {
  double h = 0;                        // [s]
  double start = 0, start_rate = 0, end = 0, end_rate = 0;  // [m], [m/s]
  double fourth = 0;                   // bound on |d4 g / dt4| in it [m/s4]
};

enum class Verdict { open, closes, unsure };

// open: the gap stays above -tolerance; closes: it falls through zero (or, where it begins below `tolerance`, through -tolerance / 2), once, or
// the cubic is as good as the gap itself.
Verdict judge(const GapPiece& piece, double tolerance);

// Time in [0, h] where the cubic first falls through `level`; h when it does not.
double first_fall(const GapPiece& piece, double level);

// Largest part of [0, h] over which a gap that is zero now stays open for certain, from its derivatives now; 0 when none is found.
double certain_opening(double rate, double second, double third, double fourth_bound, double h);

// First root in (0, 1] of the polynomial with Bernstein coefficients b where it turns negative; 2 when there is none.
double first_negative(VectorX b, double tolerance);

}  // namespace nsframe
