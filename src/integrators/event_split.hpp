// The scheme `event-split` (theory.md, section 20): a time integration method (flight_method.hpp) between impacts that are located within
// the step, sustained contact at position level. Steps near contact go in parts, all by one factored matrix (part_flow.hpp).
#pragma once

#include "integrators/flight_method.hpp"
#include "integrators/part_problem.hpp"

namespace nsframe {

class EventSplit : public Scheme {
 public:
  EventSplit(const AnalysisOptions& options, const System& system);
  std::string name() const override { return "event-split"; }
  void step(System& system, const State& committed, State& trial, double h, StepResult& result) override;
  ModeResponse mode_response(double w, double xi, double h) const override { return method_->mode_response(w, xi, h); }
  StoredEntries factor_entries() const override { return parts_.matrix.entries(); }
  long factorizations() const override { return method_->factorizations() + parts_.matrix.factorizations() + tangent_.own.matrix.factorizations(); }
  double struck_frequency() const override { return struck_; }
  std::vector<std::string> describe() const override;
  void save(Snapshot& snapshot) const override;
  void restore(System& system, const Snapshot& snapshot) override;

 private:
  struct Event {
    double time = 0;  // since the start of the part [s]
    enum class Kind { none, closes, opens, probe } kind = Kind::none;
    int pair = -1;
  };
  // A whole step without contact; false, with everything as before, where a pair might close in it.
  bool fly(System& system, double time, double h, StepResult& result);
  // Far from contact: the gaps at one end are larger than what their rates there could do in the whole step.
  bool clear(const System& system, const Motion& motion, double h) const;
  Event find_event(double length) const;
  // Moves on to the next event, at most by `length`; returns by how much.
  double advance(System& system, double time, double length, StepResult& result);
  // Throws ConvergenceError where a pair overlaps.
  void check_gaps(const System& system, double time, double h) const;
  void find_gaps(const System& system);
  double gap_tolerance(const System& system, int pair) const;
  double rate_tolerance() const;
  // How much later what touches without rate must be open, with `remaining` of the part left [s].
  double look_ahead(double remaining) const;

  // Motion over parts of a step (event_split_parts.cpp). Contact at the start of a run, or after another scheme's step:
  void start(System& system, const State& committed);
  double start_tolerance(const System& system, int pair) const;  // of a gap that is zero [m]
  // In how many parts a step h near contact goes: as many as what a struck point does by itself asks for.
  int parts_of(double h) const;
  void prepare_parts(const System& system, double h);
  // Moves what has no mass to where it rests.
  void rest_massless(System& system);
  PartLoad part_load(const System& system, double time, double length) const;
  void begin_flow(const System& system, double time, double length, const std::vector<int>& held);
  // Bends the flow as nonlinear members ask for, and finds its next event.
  Event solve_part(System& system, double time, double length, StepResult& result);
  void evaluate(System& system, double s, double time, StepResult& result);
  // Energies of a part or step of length s that began with `start`; `dissipated` [J] where its formulas tell.
  void account(const System& system, const Motion& start, double time, double s, std::optional<double> dissipated, StepResult& result);

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
    VectorX momentum, jump;
    VectorX second_rates;           // H J^-1 (M + a C) J^-1 H', of all pairs
  };
  const Contact& contact(const System& system, int pair);
  MatrixX delassus(const System& system, const std::vector<int>& pairs);  // momentum' jump [1/kg]
  // What constant forces between the pairs add to their gaps over a part of length s.
  MatrixX opening(const System& system, const std::vector<int>& pairs, double s);

  AnalysisOptions options_;
  std::unique_ptr<FlightMethod> method_;
  ImpactMatrix impact_;
  FactoredStiffness parts_;             // with the stiffness at rest
  PartFlow flow_;
  TangentFactors tangent_;
  Ladder ladder_;                       // of nonlinear parts
  std::vector<bool> massless_;
  double struck_ = 0;                   // circular frequency of a struck point by itself, the highest [rad/s]
  double last_contact_ = -1e300;        // [s]
  double part_length_ = 0;              // longest part of the step [s]
  // where the motion stands
  Motion now_;
  std::vector<int> closed_;             // pairs in sustained contact, ascending
  std::vector<bool> touching_;          // open pairs whose gap is zero
  VectorX offset_;                      // rounding taken out of gaps that are zero [m]
  VectorX gap_, rate_;                  // rates only of pairs that touch, as the flow begins with them
  std::vector<Contact> contacts_;       // of the factorization
  long contacts_factored_ = -1;
  MatrixX delassus_;                    // of all pairs; NaN where not known yet
  VectorX contact_impulse_, step_impulse_;  // of sustained contacts since they closed; of all pairs in the step [N s]
  double largest_approach_ = 0;         // [m/s]
  // work space
  Motion next_;
  VectorX history_;
  GapCoefficients path_;                // of the gaps in the flow
  const VectorX* from_ = nullptr;       // histories at the start of the part, and where its end goes
  VectorX *to_ = nullptr, *other_ = nullptr;
};

}  // namespace nsframe
