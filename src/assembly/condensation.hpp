// Which DOFs without mass a scheme that steps in time may do without: those that linear elements alone meet, without dashpots,
// Rayleigh damping, contact or initial values of their own, that no static stage loads or is led by. Statics gives them at every
// instant, also within stages (theory.md, 365-367):
//   K_cc q_c = f_c - K_cm q_m
#pragma once

#include "models/reduction.hpp"

namespace nsframe {

struct Condensation {
  int candidates = 0;             // DOFs that could be condensed
  int condensed = 0;              // DOFs that are
  bool kept_for_arcs = false;     // none, since the arc length of a static stage counts the displacements of all
  // What a solution and a product with the stiffness read: entries of inverses or factors and of stiffnesses, as the model is, and
  // with condensed DOFs taken out.
  long entries_before = 0, entries_after = 0;
  Reduction reduction;            // of no use when `condensed` is 0
};

// DOFs are taken out node by node, those that leave the fewest new entries first, while the stiffness does not fill up by that, and
// only in structures whose factors and stiffness lose a quarter of their entries. Small structures (up to `dense_limit` DOFs), which
// are solved densely, lose all of them.
Condensation find_condensation(const Model& model, int dense_limit = 160);

}  // namespace nsframe
