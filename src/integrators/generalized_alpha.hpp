// The generalized-alpha method (Chung and Hulbert, J. Appl. Mech. 60, 1993, 371-375) over a whole step (theory.md, 300-303):
//   (1 - alpha_m) M a+ + alpha_m M a + (1 - alpha_f) (P+ + C v+) + alpha_f (P + C v) = F,
//   q+ = q + h v + h^2 [(1/2 - beta) a + beta a+],  v+ = v + h [(1 - gamma) a + gamma a+]
// with F the mean load over the h around t + (1 - alpha_f) h. alpha_m = 0 is Hilber, Hughes and Taylor's method.
#pragma once

#include "integrators/flight_method.hpp"

namespace nsframe {

struct GeneralizedAlphaParameters {
  double alpha_m, alpha_f, beta, gamma;

  // Second order, unconditionally stable; waves far above what the step resolves shrink by rho_infinity a step.
  static GeneralizedAlphaParameters chung_hulbert(double rho_infinity);  // [0, 1]
  static GeneralizedAlphaParameters hilber_hughes_taylor(double rho_infinity);  // [1/2, 1]; alpha = -alpha_f
  // J / (1 - alpha_m) = M + damping C + stiffness K of a step h
  double damping(double h) const { return (1 - alpha_f) * gamma * h / (1 - alpha_m); }
  double stiffness(double h) const { return (1 - alpha_f) * beta * h * h / (1 - alpha_m); }
};

// (q, h v, h^2 a) of one mode over a step h.
Eigen::Matrix3d amplification(const GeneralizedAlphaParameters& p, double w, double xi, double h);
Scheme::ModeResponse generalized_alpha_response(const GeneralizedAlphaParameters& p, double w, double xi, double h);

class GeneralizedAlpha : public FlightMethod {
 public:
  // `name`: of its arrays in snapshots.
  GeneralizedAlpha(const AnalysisOptions& options, const System& system, const GeneralizedAlphaParameters& parameters, std::string name);
  void step(System& system, const FlightStep& step, Motion& end, StepResult& result) override;
  Scheme::ModeResponse mode_response(double w, double xi, double h) const override { return generalized_alpha_response(p_, w, xi, h); }
  PartRule part_rule() const override { return {0.5, options_.rho_infinity}; }
  long factorizations() const override { return own_.matrix.factorizations(); }
  std::string describe() const override;
  void save(Snapshot& snapshot) const override { own_.save(snapshot, name_); }
  void restore(System& system, const Snapshot& snapshot) override { own_.restore(system, snapshot, name_); }

 protected:
  // What is known before the step's end: a; q+ and v+ without a+; the terms of R without a+, P+ and v+.
  struct Start {
    VectorX a, q, v, known;  // known: alpha_m M a + alpha_f (P + C v) - F [N]
  };
  // Fills `a` where something else has moved: what the factors make of the residual force, so that waves that the step does not resolve
  // gain nothing (theory.md, 303).
  Start begin(const System& system, const FlightStep& step, VectorX& a);
  // a+ from P+ = force + K (q+ - q~) with K in the factors, q~ = start.q.
  VectorX solve_linearised(const System& system, const Start& start, const VectorX& force);
  void finish(const FlightStep& step, const Start& start, const VectorX& a, Motion& end) const;
  void make_ready(const System& system, double h);

  const GeneralizedAlphaParameters p_;
  FactoredStiffness own_;
  std::vector<Eigen::Index> massless_;

 private:
  class Step;
  const AnalysisOptions options_;
  const std::string name_;
  Ladder ladder_;
  double least_scale_;  // force that counts as zero [N]
};

}  // namespace nsframe
