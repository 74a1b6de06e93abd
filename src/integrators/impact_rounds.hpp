// Impacts at one time one after another, until no pair that touches closes any more: what `exact`, `exponential` and `event-split` share.
#pragma once

#include <algorithm>
#include <vector>

#include "models/results.hpp"

namespace nsframe {

// Impacts at one time one after another; then all touching pairs together, and plastically, end them.
inline constexpr int most_impact_rounds = 20000;
// Rounds between two looks for a sequence that repeats itself, smaller, every so many rounds: it then ends in its limit (theory.md, 172).
inline constexpr int rounds_between_looks = 120, rounds_of_period = 12;
inline constexpr double repeated_rates = 1e-9;  // to which they repeat themselves

// Whether the rates are those of `before` but for one factor below 1; `rounding` [m/s] may hide the difference.
inline bool shrinks(const VectorX& before, const VectorX& now, double rounding) {
  const double factor = now.dot(before) / before.squaredNorm();
  return factor > 0 && factor < 1 && (now - factor * before).norm() <= std::max(repeated_rates * before.norm(), rounding);
}

// collide_once(last) makes one impact; it changes `rate` [m/s] and adds to `impulse` [N s], both of all pairs; false when none was left to
// make. rounding(): of rates [m/s].
template <class CollideOnce, class Rounding>
void collide_in_rounds(const VectorX& rate, const VectorX& impulse, Accumulations& accumulations, const CollideOnce& collide_once,
                       const Rounding& rounding) {
  VectorX before, given;
  bool ends = false;
  for (int round = 0; round <= most_impact_rounds; ++round) {
    const bool last = ends || round == most_impact_rounds;
    if (!collide_once(last)) return;
    if (last) {
      ++(ends ? accumulations.ended : accumulations.plastic);
      return;
    }
    if (round > 0 && round % rounds_between_looks == 0) {
      before = rate;
      given = impulse;
    }
    if (round > rounds_between_looks && round % rounds_between_looks == rounds_of_period) {
      std::vector<int> struck;  // others that touch may leave, at rates that don't shrink
      for (int c = 0; c < static_cast<int>(rate.size()); ++c) {
        if (impulse[c] > given[c]) struck.push_back(c);
      }
      ends = struck.empty() || shrinks(before(struck), rate(struck), rounding());
    }
  }
}

}  // namespace nsframe
