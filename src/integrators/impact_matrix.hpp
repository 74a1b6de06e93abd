// The mass as impacts see it: an impulse changes velocities by M^-1 H' p, and DOFs without mass follow by the stiffness (theory.md, 295).
#pragma once

#include <vector>

#include "assembly/system.hpp"

namespace nsframe {

class ImpactMatrix {
 public:
  // Factors M + eps K, with eps so small that K rules only where there is no mass.
  explicit ImpactMatrix(const System& system);

  // M^-1 of a change of momentum.
  VectorX velocity_change(const VectorX& momentum) const { return factor_.solve(momentum); }
  // The displacement by which DOFs without mass yield to a residual force on them; the others do not move.
  VectorX follow(const VectorX& residual) const;
  // The same with the gaps of those of the pairs `held` that are at such DOFs as they are, by `forces` [N]: zero of the others.
  VectorX follow(const Contacts& contacts, const std::vector<int>& held, const VectorX& residual, VectorX* forces = nullptr) const;

  bool massless(Eigen::Index dof) const { return massless_[static_cast<std::size_t>(dof)]; }
  bool any_massless() const { return any_massless_; }
  // Reached through DOFs without mass: no impulse.
  bool compliant(int pair) const { return compliant_[static_cast<std::size_t>(pair)]; }

 private:
  Eigen::SimplicialLDLT<SparseMatrix> factor_;
  double eps_ = 0;
  std::vector<bool> massless_, compliant_;
  bool any_massless_ = false;
};

}  // namespace nsframe
