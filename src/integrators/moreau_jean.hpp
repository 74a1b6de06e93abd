// The paper's scheme (Langlade et al. 2021, Table 2): theta-method on velocities and impulses, Newton-Raphson for the
// internal forces with the contact problem inside, contact at velocity level.
//   R = M (v+ - v) + h [(1 - theta) P(q) + theta P(q+) + C v_theta] - G - H' p,   q+ = q + h v_theta
// With theta = 1, or a linear structure, this is the paper's R; otherwise the trapezoid keeps fiber histories at the
// ends of steps (theory.md).
#pragma once

#include "contact/contact_problem.hpp"
#include "integrators/algorithms.hpp"
#include "integrators/penalty_forces.hpp"
#include "integrators/extrapolation.hpp"
#include "integrators/iteration_matrix.hpp"
#include "integrators/scheme.hpp"

namespace nsframe {

class MoreauJean : public Scheme {
 public:
  MoreauJean(const AnalysisOptions& options, const System& system);
  std::string name() const override { return "moreau-jean"; }
  void step(System& system, const State& committed, State& trial, double h, StepResult& result) override;
  ModeResponse mode_response(double w, double xi, double h) const override;
  long factorizations() const override { return matrix_.factorizations(); }
  StoredEntries factor_entries() const override { return matrix_.entries(); }
  std::vector<Impact> open_contacts(const System& system, const State& state) const override;
  std::vector<std::string> describe() const override { return description_; }
  void save(Snapshot& snapshot) const override;
  void restore(System& system, const Snapshot& snapshot) override;

 private:
  class Step;
  void find_active_pairs(const System& system, const State& committed, double h, StepResult& result);
  // First guess of the velocity: the step solved with the factored stiffness and the departure from it as extrapolated.
  void predict(const System& system, const State& committed, double h, State& trial, StepResult& result);
  // Internal force at the trial velocity; fills free_residual_ = R without the contact impulses.
  void evaluate(System& system, const State& committed, State& trial, double h, bool with_tangent, StateDetermination how);
  bool in_contact() const { return !active_.empty() || forces_.active(); }
  // Changes the velocity as an algorithm commands, then solves the contact problem on the active pairs.
  void update_velocity(const System& system, const VectorX& change, State& trial, StepResult& result);
  // moreau_jean_contact.cpp: what restitution asks of the gap rates of the active pairs at the end of the step (274); the contact
  // problem with friction (275), its impulses, and what both report.
  VectorX target_rates(const System& system, const MatrixX& delassus) const;
  ContactSolution solve_with_friction(const System& system, ContactProblem& problem, const State& trial);
  void add_friction(const Contacts& contacts, double factor, VectorX& momentum) const;
  void add_friction_response(const Contacts& contacts, double factor, VectorX& velocity);
  void report_simultaneous(const System& system, const State& committed, const State& trial, double h, StepResult& result) const;
  void solve_contact(const System& system, State& trial, StepResult& result);
  // Fills residual_ = R with the contact impulses.
  void add_impulses(const System& system);
  // Moves penetrations back to gap 0.
  void project(System& system, const State& committed, State& trial, double h, StepResult& result);
  double force_scale(const State& trial, double h) const;
  void report(const System& system, const State& committed, State& trial, double h, StepResult& result) const;
  [[noreturn]] void fail(const System& system, const State& committed, const StepResult& result) const;

  AnalysisOptions options_;
  IterationMatrix matrix_;
  Ladder ladder_;
  PenaltyForces forces_;              // of the pairs with laws of force; active_ has the others
  double least_scale_;                // force that counts as zero [N]
  std::vector<int> active_;
  VectorX gap_, rate_;                // at the start of the step
  VectorX support_rate_;              // of the gaps, by moved supports at the end of the step; empty where none do
  VectorX impulse_;                   // of the active pairs
  VectorX friction_impulse_;          // two an active pair, along its tangents; empty without friction
  MatrixX delassus_;                  // of the last contact problem; rows of tangents included where there is friction
  VectorX load_, free_residual_, residual_, mid_velocity_, momentum_change_;
  Extrapolation departure_;           // of P(q+) - P(q) - K (q+ - q) with the factored K, step by step [N]
  VectorX rate_force_;                // of rate-dependent elements, at the theta point
  RateEnergy rate_energy_;            // of the step
  double dissipated_ = 0;             // by damping, in the step [J]
  std::vector<std::string> description_;
  VectorX contact_change_;            // of the velocity, by the impulses; empty without
};

}  // namespace nsframe
