// All that changes in time: plain arrays, copyable and comparable, no pointers. A restart file is a State.
#pragma once

#include "base/types.hpp"

namespace nsframe {

struct State {
  double time = 0;            // [s]
  VectorX displacement;       // free DOFs, relative to the base [m, rad]
  VectorX velocity;           // [m/s, rad/s]
  VectorX acceleration;       // of the last step without impacts, only a first guess for the next [m/s2, rad/s2]
  VectorX internal_force;     // P(q) without damping, free DOFs, at the start of a run; later where the scheme needs it [N, N m]
  VectorX history;            // of all nonlinear elements; layout: Model::history_begin, one block a group
  VectorX damping_stiffness;  // entries of the tangent at the end of the last step; empty unless damping needs it [N/m]
  VectorX impulse;            // of the contact pairs over the last step [N s]
  VectorX contact_episodes;   // of the pairs with a law of force, in their order: a ContactEpisode each (penalty_forces.hpp)
};

}  // namespace nsframe
