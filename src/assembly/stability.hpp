// Finds structures that can move without resistance before any analysis fails on them.
#pragma once

#include "assembly/assembler.hpp"

namespace nsframe {

// Reports every structure whose stiffness is singular (or, where it may move freely, whose mass and stiffness
// together are), naming the node and direction that move most.
void check_stability(const Model& model, const SparseMatrix& stiffness, Diagnostics& diagnostics);

}  // namespace nsframe
