// What an integrator sees of a model: residual terms, tangent, mass, damping, loads and gaps, in free DOFs.
#pragma once

#include "assembly/assembler.hpp"

namespace nsframe {

// C = viscous + U U' block by block: dashpots and Rayleigh damping sparse, modal damping as a low-rank factor.
struct Damping {
  SparseMatrix viscous;             // [N s/m]
  std::vector<MatrixX> modal;       // one factor U a structure (its DOFs x modes); may have no columns

  // force += factor * C velocity
  void add_force(const std::vector<BlockRange>& blocks, double factor, const VectorX& velocity, VectorX& force) const;
};

class System {
 public:
  System(const Model& model, int threads);

  const Model& model;
  Assembler assembler;
  Damping damping;
  VectorX static_load;              // acts throughout [N]

  const Contacts& contacts() const { return model.contacts; }
  const SparseMatrix& mass() const { return model.mass; }
  bool linear() const { return assembler.linear(); }

  // Integral of the loads over [start, end], exact for the piecewise linear ground motion [N s].
  void load_impulse(double start, double end, VectorX& impulse) const;
};

}  // namespace nsframe
