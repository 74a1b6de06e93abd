// Laws whose stress depends on how fast the strain changes. Their respond() is the law at rest, infinitely slow; what a
// time step adds comes from respond_rate(), which only springs, links and trusses call (elements/element_group.hpp).
// Such a law has, beside what wrapper.hpp asks of laws without SIMD kernel,
//   respond_rate(strain, committed, trial, step)
// and a history that begins with two doubles: the strain, and the stress that the last step left.
#pragma once

#include <algorithm>

#include "materials/wrapper.hpp"

namespace nsframe {

// A step of the theta scheme (theory.md, 5 to 7).
struct StepSpan {
  double duration = 0;  // [s]
  double theta = 1;
};

// What a step leaves in the law, [J/m3] of a law and [J] of an element.
struct RateEnergy {
  double dissipated = 0, stored = 0;
};

struct RatePoint {
  double stress = 0;   // at the theta point of the step [Pa]
  double tangent = 0;  // its derivative by the strain at the end of the step [Pa]
  RateEnergy energy;
};

inline constexpr int rate_history_size = 2;

template <class Law>
concept RateLaw = requires(const Law& law, const double* committed, double* trial) {
  { law.respond_rate(0.0, committed, trial, StepSpan{}) } -> std::same_as<RatePoint>;
};

// At rest there is neither stress nor stiffness.
inline void respond_at_rest(const PointArrays& p) {
  std::fill_n(p.stress, p.count, 0.0);
  std::fill_n(p.tangent, p.count, 0.0);
  for (int i = 0; i < p.count; ++i) {
    p.trial[i] = p.strain[i];
    p.trial[p.stride + i] = 0;
  }
}

}  // namespace nsframe
