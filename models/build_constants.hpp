// What of a model is assembled once: masses, dashpots, weights.
#pragma once

#include "models/build_elements.hpp"
#include "models/model.hpp"

namespace nsframe {

// Adds half a member's mass to the nodal masses at each of its ends.
void share_member_masses(Model& model, const std::vector<ElementMass>& members);

// Mass, damping and static loads in free DOFs. `concentrated_mass`: of the nodes, full DOFs, without the members' own.
void assemble_constants(Model& model, const VectorX& concentrated_mass, const std::vector<ElementMass>& members,
                        const GravityDescription& gravity);

}  // namespace nsframe
