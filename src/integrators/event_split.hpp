// The scheme `event-split` (theory.md, section 20): the theta-method between impacts that are located within the step, sustained contact at
// position level. Parts of a step keep the factored matrix of the whole step (part_flow.hpp).
#pragma once

#include "integrators/algorithms.hpp"
#include "integrators/impact_matrix.hpp"
#include "integrators/part_flow.hpp"
#include "integrators/scheme.hpp"

namespace nsframe {

class EventSplit : public Scheme {
 public:
  EventSplit(const AnalysisOptions& options, const System& system);
  std::string name() const override { return "event-split"; }
  void step(System& system, const State& committed, State& trial, double h, StepResult& result) override;
  ModeResponse mode_response(double w, double xi, double h) const override;
  long factorizations() const override { return matrix_.factorizations(); }
  void save(Snapshot& snapshot) const override;
  void restore(System& system, const Snapshot& snapshot) override;

 private:
  struct Event {
    double time = 0;  // since the start of the part [s]
    enum class Kind { none, closes, opens } kind = Kind::none;
    int pair = -1;
  };
  // Contact at the start of a run, or after another scheme's step.
  void start(System& system, const State& committed);
  // Moves what has no mass to where it rests.
  void rest_massless(System& system, double sufficient);
  PartLoad part_load(const System& system, double time, double length) const;
  void begin_flow(const System& system, double time, double length, const std::vector<int>& held);
  bool clear(const System& system, double h);
  class WholeStep;
  // A step without contact, which begin_whole() has begun; by the solution algorithms where something is nonlinear.
  void take_whole(System& system, double time, StepResult& result);
  // Ends a part of length s that moved by `change` at the mean velocity `mean`: energies, and histories where they have been written.
  void account(const System& system, double time, double s, const VectorX& change, const VectorX& old_velocity, const VectorX& old_force,
               StepResult& result);
  // Throws ConvergenceError where a pair overlaps.
  void check_gaps(const System& system, double time) const;
  Event find_event(double length);
  // Moves on to the next event, at most by `length`; returns by how much.
  double advance(System& system, double time, double length, StepResult& result);
  void evaluate(System& system, double s, double time, StepResult& result);
  void find_gaps(const System& system);
  double gap_tolerance(const System& system, int pair) const;
  double rate_tolerance() const;
  // How much later what touches without rate must be open, with `remaining` of the step left [s].
  double look_ahead(double remaining) const;

  // Impacts at this time, until no gap that is zero closes any more; then which pairs stay closed (event_split_contact.cpp).
  void collide(const System& system, double time, double remaining, StepResult& result);
  bool collide_once(const System& system, double time, double remaining, bool last, StepResult& result);
  // Touching pairs that a law with restitution would let bounce ever faster from here on, too fast for the step.
  std::vector<int> accumulating(const System& system, const std::vector<int>& pairs) const;
  void settle(const System& system, double time, double remaining, StepResult& result);
  void end_contact(int pair, double time, StepResult& result);
  void remove_drift(const System& system);
  VectorX solve_forces(const System& system, const MatrixX& W, const std::vector<int>& pairs, const VectorX& rhs, StepResult& result) const;
  bool is_closed(int pair) const;
  // A pair as the flow sees it: its gap begins with the rate momentum' v, and a unit impulse changes v by `jump` = M^-1 momentum.
  struct Contact {
    VectorX momentum, jump, first;  // first: (M + a C) J^-1 H'
  };
  const Contact& contact(const System& system, int pair);
  // Entries of matrices pair by pair, computed once a factorization: `entry` of what is not known yet.
  template <class Entry>
  MatrixX gather(MatrixX& known, const std::vector<int>& pairs, const Entry& entry);
  MatrixX delassus(const System& system, const std::vector<int>& pairs);  // momentum' jump [1/kg]
  // What constant forces between the pairs add to their gaps over a part of length s.
  MatrixX opening(const System& system, const std::vector<int>& pairs, double s);

  AnalysisOptions options_;
  IterationMatrix matrix_;
  ImpactMatrix impact_;
  Ladder ladder_;
  double least_scale_;                  // force that counts as zero [N]
  PartFlow flow_;
  SparseMatrix stiffness_;              // in the factors
  std::vector<bool> massless_;
  double step_length_ = 0;
  // where the motion stands
  VectorX q_, v_, force_;               // displacement, velocity, internal force
  std::vector<int> closed_;             // pairs in sustained contact, ascending
  std::vector<bool> touching_;          // open pairs whose gap is zero
  VectorX offset_;                      // rounding taken out of gaps that are zero [m]
  VectorX gap_, rate_;                  // rates only of pairs that touch, as the flow begins with them
  std::vector<Contact> contacts_;       // of the factorization
  long contacts_factored_ = -1;
  MatrixX delassus_, response_, second_response_;  // of gather(): momentum' jump, H J^-1 H', H J^-1 (M + a C) J^-1 H'
  VectorX contact_impulse_, step_impulse_;  // of sustained contacts since they closed; of all pairs in the step [N s]
  double largest_approach_ = 0;         // [m/s]
  VectorX last_displacement_, last_velocity_;
  // work space
  VectorX history_;
  GapCoefficients path_;                // of the gaps in the flow
  const VectorX* from_ = nullptr;       // histories at the start of the part, and where its end goes
  VectorX *to_ = nullptr, *other_ = nullptr;
};

}  // namespace nsframe
