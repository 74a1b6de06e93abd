// The scheme `exact` for linear scenes (theory.md, section 15): every mode moves in closed form under the piecewise linear loads, impacts
// and openings of contacts are located to rounding, with a proof that none is skipped; dt only says when results are kept.
// Newton's impact law; impacts that accumulate end in sustained contact, whose forces are found by collocation.
#pragma once

#include "integrators/flight.hpp"
#include "integrators/scheme.hpp"

namespace nsframe {

class Exact : public Scheme {
 public:
  // Throws InputError for nonlinear elements and for damping that couples modes.
  Exact(const AnalysisOptions& options, const System& system);
  std::string name() const override { return "exact"; }
  void step(System& system, const State& committed, State& trial, double h, StepResult& result) override;
  ModeResponse mode_response(double w, double xi, double) const override { return {w > 0 ? xi : 0, w}; }
  long factorizations() const override { return 0; }
  bool shorter_steps_help() const override { return false; }
  void save(Snapshot& snapshot) const override;
  void restore(System& system, const Snapshot& snapshot) override;
  std::vector<std::string> describe() const override;

 private:
  void start(const System& system, const State& committed);
  // The load of the part of the step that begins at `time`.
  void set_load(const System& system, double time, double length);
  // Times in (0, h] after `time` where the step is cut: samples of the motions, and its end.
  std::vector<double> cuts(const System& system, double time, double h) const;
  void advance(const System& system, double time, double length, StepResult& result);
  [[noreturn]] void refuse_to_go_on(const System& system, double time, double interval) const;
  void add_energy(double s, StepResult& result);
  // Impacts at this time, until no gap that is zero closes any more.
  void collide(const System& system, double time, double remaining, StepResult& result);
  bool collide_once(const System& system, double time, double remaining, bool last, StepResult& result);
  // Whether the gap rates of what touches are those of some rounds ago, all times one factor below 1.
  bool shrinks(const VectorX& before) const;
  // Which of the touching pairs with no gap rate stay closed.
  void settle(const System& system, double time, StepResult& result);
  void remove_drift();
  void end_contact(int pair, double time, StepResult& result);
  VectorX solve_forces(const System& system, const std::vector<int>& pairs, const VectorX& rhs, StepResult& result) const;
  VectorX accelerations() const;        // of the gaps, without the forces of pairs that have no compliance
  std::vector<int> closed_pairs(bool compliant) const;
  VectorX compliant_forces(const VectorX& gap) const;
  double rate_noise(int pair) const;
  void write_state(State& trial) const;

  AnalysisOptions options_;
  ExactModes modes_;
  Propagator propagator_;
  SustainedContact sustained_;
  Flight flight_;
  ModalState state_;
  ContactState contact_;
  VectorX gap_, rate_;                  // of the pairs now
  VectorX contact_impulse_;             // of sustained contacts since they closed [N s]
  VectorX step_impulse_;
  double largest_approach_ = 0;         // [m/s]
  bool disturbed_ = true;
  VectorX last_displacement_, last_velocity_;  // as written; another state is taken in anew
};

}  // namespace nsframe
