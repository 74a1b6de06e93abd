// What a contact pair meets: the mass and the stiffness that its two sides oppose to it, in the laws of contact force.
#pragma once

#include "assembly/system.hpp"

namespace nsframe {

// m* = 1 / (H M^-1 H') [kg], for two free masses m1 m2 / (m1 + m2); 0 where the pair meets DOFs without mass.
double effective_mass(const System& system, int pair);

// The larger of 1 / (n' K^-1 n) of both sides at their point of contact along the normal, with the stiffness at the first rest
// [N/m]; 0 where both may move freely or are fixed.
double stiffer_body(const System& system, int pair);

}  // namespace nsframe
