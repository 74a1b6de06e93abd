// Motion of a system in its natural modes with located impacts, openings and sustained contact (theory.md, section 15): every mode
// moves in closed form under loads that are linear in time between samples of the motions. The schemes `exact` and `exponential` drive it.
#pragma once

#include "integrators/flight.hpp"
#include "integrators/scheme.hpp"

namespace nsframe {

// Where the motion stands, so that a step can be tried and taken back.
struct FlowState {
  ModalState modal;
  ContactState contact;
  VectorX gap, rate, contact_impulse, step_impulse;
  double largest_approach = 0;
};

// What acts in the modes beside the loads: -(value + slope (t - time)); empty for nothing.
struct ModalForce {
  VectorX value, slope;  // [N/sqrt(kg)], [N/s/sqrt(kg)]
  double time = 0;       // [s]
};

class EventFlow {
 public:
  // With the modes under a symmetric `stiffness`, up to the options' highest frequency.
  EventFlow(const AnalysisOptions& options, const System& system, const SparseMatrix& stiffness);
  EventFlow(const EventFlow&) = delete;
  EventFlow& operator=(const EventFlow&) = delete;

  const ExactModes& modes() const { return modes_; }
  double kinetic_energy() const { return 0.5 * state_.y.squaredNorm(); }  // of the modes [J]
  Scheme::LeftOut left_out() const;
  // w, or 0 when such a mode is left out [rad/s].
  double kept_frequency(double w) const { return w <= highest_ ? w : 0; }
  const ModalState& modal() const { return state_; }
  const VectorX& gap() const { return gap_; }
  void copy_to(FlowState& state) const;
  void go_back(const FlowState& state);

  void set_force(const VectorX& value, const VectorX& slope, double time);
  void set_force_slope(const VectorX& slope) { force_.slope = slope; }
  void clear_force() { force_ = {}; }
  // Takes displacement and velocity of `committed` in anew. Throws InputError where a pair without compliance overlaps.
  void start(const System& system, const State& committed);
  // Moves on by h [s]; adds impacts, jumps and energies to `result`, work against set_force() as strain. `starting`: pairs that touch
  // collide first.
  void travel(const System& system, double time, double h, bool starting, StepResult& result);

  // The modes after h [s], where no pair may touch on the way, into `end`; the flow itself stays where it is. false, and nothing else,
  // where a pair might, or where damping ties modes together.
  bool glide(const System& system, double time, double h, ModalState& end);

  // Adds what the sustained contacts of the last flight did to the modes at its end [N/sqrt(kg)].
  void add_contact_load(VectorX& load) const;

  // Of the pairs since clear_impulse() [N s].
  const VectorX& impulse() const { return step_impulse_; }
  void clear_impulse() { step_impulse_.setZero(); }
  // Displacement and velocity of the free DOFs; what has no mass stands where static loads alone hold it.
  void write(VectorX& displacement, VectorX& velocity);
  std::vector<std::string> describe() const;
  void save(Snapshot& snapshot) const;
  void restore(const Snapshot& snapshot);

 private:
  // The load of the part of the step that begins at `time`.
  void set_load(const System& system, double time, double length);
  void find_load(const System& system, double time, double length, VectorX& f0, VectorX& f1) const;
  // Times in (0, h] after `time` where the step is cut: samples of the motions, and its end. Until asked for others.
  const std::vector<double>& cuts(const System& system, double time, double h);
  void advance(const System& system, double time, double length, StepResult& result);
  [[noreturn]] void refuse_to_go_on(const System& system, double time, double interval) const;
  void add_energy(double time, double s, StepResult& result);
  // Impacts at this time, until no gap that is zero closes any more.
  void collide(const System& system, double time, double remaining, StepResult& result);
  bool collide_once(const System& system, double time, double remaining, bool last, StepResult& result);
  // Which of the touching pairs with no gap rate stay closed.
  void settle(const System& system, double time, StepResult& result);
  void remove_drift();
  void end_contact(int pair, double time, StepResult& result);
  VectorX solve_forces(const System& system, const std::vector<int>& pairs, const VectorX& rhs, StepResult& result) const;
  VectorX accelerations() const;        // of the gaps, without the forces of pairs that have no compliance
  std::vector<int> closed_pairs(bool compliant) const;
  VectorX compliant_forces(const VectorX& gap) const;
  double rate_noise(int pair) const;

  AnalysisOptions options_;
  double highest_;                      // circular frequency of the modes that are kept [rad/s]
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
  ModalForce force_;
  VectorX slope_;                     // room for set_load()
  std::vector<double> cuts_;          // of the step `cut_length_` long from `cut_time_` on
  double cut_time_ = 0, cut_length_ = -1;
  ModalState piece_;                  // room for glide()
  VectorX glide_gap_, glide_rate_;
};

}  // namespace nsframe
