// The theta-method over a part of a step with nonlinear members: by how much its end is off what the flow of the stiffness at rest tells
// (theory.md, 351-353). x is that shift of q(s), R its force residual,
//   R(x) = (M + a C) x / a^2 + P(q + d + x) - P(q) - K d,  a = theta s,  d = q(s) - q of the flow,  dR/dx = J_t / a^2,
// with the gaps of held pairs as they are. First by the factors of the parts (K at rest), then by those of the tangent.
#pragma once

#include "integrators/flight_method.hpp"
#include "integrators/impact_matrix.hpp"
#include "integrators/part_flow.hpp"

namespace nsframe {

// Factors of parts in which members are far from what they are at rest.
struct TangentFactors {
  FactoredStiffness own;
  HeldSolution held;
  bool in_use = false;  // by the last part

  explicit TangentFactors(const System& system) : own{IterationMatrix(system), system.initial_stiffness}, held(own.matrix) {}
};

class PartProblem : public NonlinearStep {
 public:
  struct Tools {
    System& system;
    const ImpactMatrix& impact;
    PartFlow& flow;                      // holding the closed pairs
    const FactoredStiffness& rest;       // of the flow
    TangentFactors& tangent;
    const AnalysisOptions& options;
  };
  // A part of length s from `start`; histories from `committed` to `trial`. First guess: how the flow is bent.
  PartProblem(const Tools& tools, double s, const Motion& start, const VectorX& committed, VectorX& trial, StepResult& result);

  void restart() override;
  const VectorX& residual() const override { return residual_; }
  double error() const override { return result_.residual / tools_.options.newton_tolerance; }
  void factor(Tangent which) override;
  void solve(const VectorX& rhs, VectorX& solution) override;
  void move(const VectorX& change) override;
  void settle() override;
  bool guess_may_stand() const override { return true; }
  bool has_factors() const override { return true; }
  double slow_reduction() const override { return 0.1; }

  VectorX x;
  VectorX forces;  // of the held pairs at the end of the part [N]
  VectorX P;       // at the end of the part

 private:
  void evaluate(bool with_tangent, StateDetermination how);
  void solve_at_rest(const VectorX& rhs, VectorX& solution);

  const Tools tools_;
  const double s_, a_;
  const VectorX& committed_;
  VectorX& trial_;
  StepResult& result_;
  VectorX guess_, reached_, known_;  // known_: P(q) + K d
  VectorX residual_, correction_;
  bool corrected_ = false;           // correction_ is J^-1 a^2 residual_
  double scale_ = 0;                 // of a x'J x: motion of the part [m kg^(1/2)]
};

}  // namespace nsframe
