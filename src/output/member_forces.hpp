// Forces of members in their local axes, from a state.
#pragma once

#include <vector>

#include "elements/member_load.hpp"
#include "models/model.hpp"
#include "models/state.hpp"

namespace nsframe {

// Displacements (12) of the nodes of an element out of all nodes' displacements (6 a node); zero for the ground.
Vector12 element_displacement(const ElementGroup& group, int element, const VectorX& full_displacement);

// First double of an element's history in `state`.
const double* element_history(const Model& model, std::size_t group, int element, const State& state);

// Forces that the nodes apply to the ends of elements (at the far side of rigid arms), in the element's present local axes: at node i N, VY, VZ [N],
// T, MY, MZ [N m], then the same at node j. Keeps scratch between calls.
class EndForces {
 public:
  const Vector12& evaluate(const Model& model, std::size_t group, int element, const State& state,
                           const VectorX& full_displacement);

 private:
  std::vector<double> trial_;
  Vector12 force_;
};

// The load between an element's ends in its local axes at `displacement` (12); `history` as committed.
MemberLoad present_load(const ElementGroup& group, int element, const Vector12& displacement, const double* history);

// Section force and moment at `along` in [0, 1] of a member, as the part beyond acts on the part before: (N, VY, VZ) [N]
// and (T, MY, MZ) [N m]. By equilibrium with the end forces and, where the member has one, `part` of its load.
struct SectionForce {
  Vector3 force, moment;
};
SectionForce section_force(const Vector12& end_forces, double along);
SectionForce section_force(const Vector12& end_forces, double along, const MemberLoad& load, double part, double length);

}  // namespace nsframe
