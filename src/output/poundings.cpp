#include "output/poundings.hpp"

#include <algorithm>
#include <unordered_map>

namespace nsframe {

namespace {

constexpr double resting = 1e-12;  // of the fastest approach: rounding of a contact that rests

}  // namespace

std::vector<Pounding> merge_impacts(const std::vector<Impact>& impacts, double window) {
  std::vector<Pounding> poundings;
  std::unordered_map<int, std::size_t> latest;  // pounding of each pair
  double fastest = 0;
  for (const Impact& impact : impacts) fastest = std::max(fastest, impact.approach_velocity);
  for (const auto& impact : impacts) {
    const auto found = latest.find(impact.pair);
    const bool continues = found != latest.end() &&
                           impact.time - impact.duration - (poundings[found->second].time + poundings[found->second].duration) < window;
    if (!continues) {
      latest[impact.pair] = poundings.size();
      Pounding first;
      first.time = impact.time - impact.duration;
      first.pair = impact.pair;
      first.approach_velocity = impact.approach_velocity;
      poundings.push_back(first);
    }
    Pounding& pounding = poundings[latest[impact.pair]];
    pounding.duration = impact.time - pounding.time;
    pounding.impulse += impact.impulse;
    pounding.impacts += 1;
    // A pounding that begins in resting contact has no approach to compare with.
    pounding.effective_restitution =
        pounding.approach_velocity > resting * fastest ? impact.rate_after / pounding.approach_velocity : 0;
  }
  // a contact with a law of force is told when it ends
  std::stable_sort(poundings.begin(), poundings.end(), [](const Pounding& p, const Pounding& q) { return p.time < q.time; });
  return poundings;
}

}  // namespace nsframe
