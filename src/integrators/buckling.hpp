// Linear buckling: load factors at which a structure under constant loads loses its stability as one more load pattern
// grows, (K + lambda K_g) phi = 0 (theory.md, 94). K is the tangent under the constant loads, K_g its derivative along the
// linear response to the pattern, with constant tangents of the laws. That derivative holds all that geometry does
// (P-Delta, corotational), exactly and without symmetrising. Laws that answer loading and unloading by different tangents have
// those of loading by the pattern (Engesser 1889, Shanley 1947; theory.md, 384).
#pragma once

#include <vector>

#include "assembly/system.hpp"

namespace nsframe {

struct BucklingMode {
  double load_factor = 0;
  VectorX shape;             // free DOFs; largest translation 1
};

// The lowest `count` positive load factors, rising; fewer when the pattern has not as many. `state` is one of equilibrium. The
// loads on members that aren't linear are no part of `pattern`: `member_loads` of them grows with it.
// Throws ConvergenceError when the structure is not stable there.
std::vector<BucklingMode> buckling_modes(System& system, const State& state, const VectorX& pattern, int count,
                                         double member_loads = 0);

}  // namespace nsframe
