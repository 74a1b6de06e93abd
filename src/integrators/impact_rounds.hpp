// Impacts at one time one after another, until no pair that touches closes any more: what `exact`, `exponential` and `event-split` share.
#pragma once

#include <vector>

#include "models/results.hpp"

namespace nsframe {

// Impacts at one time one after another; then all touching pairs together, and plastically, end them.
inline constexpr int most_impact_rounds = 20000;
// Rounds between two looks for a sequence that repeats itself, smaller, every so many rounds: it then ends in its limit (theory.md, 172).
inline constexpr int rounds_between_looks = 120, rounds_of_period = 12;
inline constexpr double repeated_rates = 1e-9;  // to which they repeat themselves

// Whether the rates are those of `before` but for one factor below 1.
inline bool shrinks(const VectorX& before, const VectorX& now) {
  const double factor = now.dot(before) / before.squaredNorm();
  return factor > 0 && factor < 1 && (now - factor * before).norm() <= repeated_rates * before.norm();
}

// collide_once(last) makes one impact and changes `rate`, of all pairs [m/s]; false when none was left to make. together(): the pairs that touch.
template <class CollideOnce, class Together>
void collide_in_rounds(const VectorX& rate, Accumulations& accumulations, const CollideOnce& collide_once, const Together& together) {
  VectorX before;
  bool ends = false;
  for (int round = 0; round <= most_impact_rounds; ++round) {
    const bool last = ends || round == most_impact_rounds;
    if (!collide_once(last)) return;
    if (last) {
      ++(ends ? accumulations.ended : accumulations.plastic);
      return;
    }
    if (round > 0 && round % rounds_between_looks == 0) before = rate;
    if (round > rounds_between_looks && round % rounds_between_looks == rounds_of_period) {
      const std::vector<int> pairs = together();
      ends = shrinks(before(pairs), rate(pairs));
    }
  }
}

}  // namespace nsframe
