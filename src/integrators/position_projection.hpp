// Contact at velocity level leaves penetrations of the order of a step times a gap rate. The projection takes them away after
// the step, as Schatzman's schemes and that of Gear, Gupta and Leimkuhler (1985) do, without a change of velocities
// (theory.md, 265-266).
#pragma once

#include "contact/contact_problem.hpp"
#include "integrators/iteration_matrix.hpp"

namespace nsframe {

inline constexpr double closed_gap = 1e-12;  // [m] up to which a projected pair counts as closed

struct ProjectedPair {
  int pair = 0;
  double gap = 0;     // [m]
  bool opens = true;  // to gap 0; else it is only not pressed further in
};

// The least shift of displacements, in the norm of the iteration matrix J, that opens penetrated pairs to gap 0 and presses none
// further in: J^-1 H' lambda. Empty where none is penetrated. Throws ConvergenceError.
VectorX shift_to_closed(const Contacts& contacts, IterationMatrix& matrix, const std::vector<ProjectedPair>& pairs);

}  // namespace nsframe
