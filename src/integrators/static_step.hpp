// One static step: equilibrium P(q) = dead + factor * pattern together with one equation c(q, factor) = 0 that a control
// adds, solved as one bordered system so that it stays regular at limit points and on plastic plateaus (theory.md, 91):
//   [ K    -pattern ] [ dq      ]     [ P - dead - factor pattern ]
//   [ c_q'  c_f     ] [ dfactor ] = - [ c                         ]
#pragma once

#include <functional>
#include <optional>

#include "assembly/system.hpp"
#include "base/decompositions.hpp"
#include "integrators/nonlinear_step.hpp"

namespace nsframe {

// A state of equilibrium and the load factor there.
struct StaticPoint {
  State state;
  double factor = 0;
};

// The equation of a control at a trial: its value, and its derivatives.
struct StaticConstraint {
  double value = 0, tolerance = 0;
  VectorX by_displacement;
  double by_factor = 0;
};

// Writes the constraint at displacement q and load factor.
using ConstraintFunction = std::function<void(const VectorX& q, double factor, StaticConstraint& constraint)>;

struct StaticTolerance {
  double residual = 1e-10;  // relative to the loads and the internal forces
  double least_force = 0;   // below which relative makes no sense: the largest of the stage so far [N]
};

class StaticStep : public NonlinearStep {
 public:
  // `factor_scale`: load factor that moves the structure by about 1 m.
  StaticStep(System& system, const VectorX& dead, const VectorX& pattern, double factor_scale);

  // The step from `committed` with the first guess `committed` + (change, factor_change).
  void prepare(const StaticPoint& committed, ConstraintFunction constraint, const VectorX& change, double factor_change,
               const StaticTolerance& tolerance);
  // The part of the loads on members that acts at the end of the step; without, that at its start.
  void set_member_loads(double part) { member_loads_ = part; }
  StaticPoint& trial() { return trial_; }
  const StaticPoint& trial() const { return trial_; }
  double largest_force() const { return scale_; }
  double relative_residual() const;
  // The element that carries the largest part of the residual.
  std::string worst_element() const;

  void restart() override;
  const VectorX& residual() const override { return residual_; }
  double error() const override { return error_; }
  void factor(Tangent which) override;
  void solve(const VectorX& rhs, VectorX& x) override;
  void move(const VectorX& change) override;
  void settle() override;
  long factorizations() const { return factorizations_; }

 private:
  void evaluate(StateDetermination how);

  System& system_;
  VectorX dead_, pattern_;
  double factor_scale_;
  const StaticPoint* committed_ = nullptr;
  StaticPoint trial_;
  ConstraintFunction constraint_function_;
  VectorX first_change_;
  double first_factor_change_ = 0;
  StaticTolerance tolerance_;
  std::optional<double> member_loads_;
  StaticConstraint constraint_;
  double row_scale_ = 0;              // of the constraint's equation, to the size of the stiffness; 0: not known yet
  double scale_ = 0, error_ = 0;
  VectorX residual_;                  // P - dead - factor pattern, then the scaled constraint
  bool dense_;
  Eigen::PartialPivLU<MatrixX> dense_factor_;
  Eigen::SparseLU<SparseMatrix> sparse_factor_;
  long factorizations_ = 0;
};

}  // namespace nsframe
