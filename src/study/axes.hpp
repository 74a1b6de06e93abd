// What a study varies: "dt=1e-3,5e-4,scheme=moreau-jean,exact" to keys of the scene and their values, and every
// combination of these.
#pragma once

#include <string>
#include <vector>

namespace nsframe {

struct StudyAxis {
  std::string key;                  // of the scene, as --set takes it: "analysis.dt"
  std::vector<std::string> values;
  bool physical() const;            // changes what is simulated, not how: such combinations need references of their own
};

// Short names: dt, scheme, theta, gamma, restitution, pga, duration. Throws InputError with the nearest valid name.
std::vector<StudyAxis> parse_axes(const std::vector<std::string>& texts);

// One value an axis, as key=value; the last axis varies fastest.
using Combination = std::vector<std::string>;
std::vector<Combination> combinations(const std::vector<StudyAxis>& axes);

}  // namespace nsframe
