// Supports that move by prescribed histories d_k(t) relative to the base, taken out of a model (theory.md, 370-375):
//   q = p + sum s_k d_k,   s_k = -K^-1 K_s b_k at the DOFs that are free, b_k at the driven ones,
// with the stiffness K at the unloaded state. p is then loaded by -M s_k d_k'' as by a motion of the base.
#pragma once

#include "models/reduction.hpp"

namespace nsframe {

// The model without its driven DOFs, and in `reduction` the way back. Throws InputError where the structures on moved supports may
// move freely.
Model without_moved_supports(const Model& model, Reduction& reduction);

// The same where nobody asks for the way back; `model` itself when no support of it moves.
Model held_supports(Model model);

}  // namespace nsframe
