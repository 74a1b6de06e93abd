// A model with fewer free DOFs than the one that a scene describes, and the way back:
//   q = A p + q0 + sum s_k d_k(t),   p the DOFs that are kept
// with A' on the left of everything that acts on q (theory.md, 365). DOFs that statics alone rules are condensed so, and supports
// that move by prescribed histories d_k taken out. Who watches a run is shown q (src/integrators/shown_states.hpp).
#pragma once

#include "models/model.hpp"
#include "models/state.hpp"

namespace nsframe {

struct Reduction {
  std::vector<int> kept;          // free DOFs of the larger model that p stands for, rising
  SparseRows map;                 // A (q x p); rows of `kept` are those of the identity
  VectorX rest;                   // q0, what static loads do at DOFs that are not kept
  std::vector<VectorX> shapes;    // s_k, one a motion; empty ones where none

  // Time, displacements, velocities and accelerations of a state of the smaller model, as the larger one's; leaves the rest of `larger`.
  void expand(const State& state, const std::vector<GroundMotion>& motions, State& larger) const;
  VectorX expand_change(const VectorX& change) const { return map * change; }
  // The way back from a model that `inner` makes smaller still.
  Reduction then(const Reduction& inner) const;
};

// The smaller model: elements, nodes and the numbering of pairs are those of `model`. Fills support_effects where there are shapes;
// `linear_force` is then what linear elements answer to each, free DOFs of `model` [N/m].
Model reduced_model(const Model& model, const Reduction& reduction, const std::vector<VectorX>& linear_force = {});

}  // namespace nsframe
