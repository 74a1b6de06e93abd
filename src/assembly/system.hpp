// What an integrator sees of a model: residual terms, tangent, mass, damping, loads and gaps, in free DOFs.
#pragma once

#include "assembly/assembler.hpp"

namespace nsframe {

// C = viscous + U U' block by block: dashpots and Rayleigh damping sparse, modal damping as a low-rank factor; and what
// follows the tangent, C += a1 K with K of the last step's end or of the present iteration (theory.md, 95).
struct Damping {
  SparseMatrix viscous;             // [N s/m]
  SparseMatrix tangent;             // the part that follows the tangent, as formed last; pattern of the stiffness, or empty
  VectorX committed_factor, current_factor;  // a1 of every free DOF [s]; empty when no structure asks
  std::vector<MatrixX> modal;       // one factor U a structure (its DOFs x modes); may have no columns

  bool follows_tangent() const { return committed_factor.size() > 0; }
  // Forms `tangent` from the entries of both stiffnesses.
  void form_tangent(const VectorX& committed, const SparseMatrix& current);

  // force += factor * C velocity; returns factor * velocity' C velocity.
  double add_force(const std::vector<BlockRange>& blocks, double factor, const VectorX& velocity, VectorX& force) const;
};

// Accelerations below this count as zero when residuals are judged [m/s2].
inline constexpr double negligible_acceleration = 1e-3;

class System {
 public:
  System(const Model& model, int threads);

  const Model& model;
  Assembler assembler;
  Damping damping;
  VectorX static_load;              // acts throughout [N]
  double member_load = 0;           // norm of what the loads on nonlinear members, which stand in P(q), give to the nodes [N]
  SparseMatrix initial_stiffness;   // tangent at the first rest, for algorithms that keep it

  const Contacts& contacts() const { return model.contacts; }
  const SparseMatrix& mass() const { return model.mass; }
  bool linear() const { return assembler.linear(); }
  double negligible_force() const;  // what residuals are measured by at least [N]

  // Gaps and their rates, with what moved supports add to them [m], [m/s].
  void gaps(const VectorX& displacement, double time, VectorX& gap) const;
  void gap_rates(const VectorX& velocity, double time, VectorX& rate) const;
  // Sets the supports where they are at `time`, for the internal forces to come.
  void place_supports(double time);
  // What the elements do to moved supports along each motion, s_k' P [N], at the displacement of the last internal_force().
  VectorX support_forces(const VectorX& displacement, double time) const;
  // 1/2 (v + sum s_k d_k')' M (v + sum s_k d_k') less 1/2 v' M v [J].
  double support_kinetic_energy(const VectorX& velocity, double time) const;

  // 1/2 v' M v [J].
  double kinetic_energy(const VectorX& velocity) const;

  // Integral of the loads over [start, end], exact for the piecewise linear ground motion [N s].
  void load_impulse(double start, double end, VectorX& impulse) const;

 private:
  struct MassCoupling {
    int i, j;
    double value;
  };
  VectorX half_mass_;                      // half the diagonal of M
  std::vector<MassCoupling> mass_couplings_;  // below it
};

}  // namespace nsframe
