// A motion of the scheme `exact` between two events, without impulses: which gap closes first, or which sustained contact opens
// first, with a proof that nothing was skipped (theory.md, 154, 158).
#pragma once

#include "integrators/gap_roots.hpp"
#include "integrators/sustained_contact.hpp"

namespace nsframe {

struct FlightEvent {
  enum class Kind { none, closes, opens };
  double time = 0;  // since the start of the flight [s]
  Kind kind = Kind::none;
  int pair = -1;
  bool far = false;  // no pair came near: gaps are large against rounding
};

// What contact is at the start of a flight.
struct ContactState {
  std::vector<int> closed;       // pairs in sustained contact, ascending
  std::vector<bool> touching;    // open pairs whose gap is zero now
  VectorX constant;              // g0, what static loads do without mass, and rounding taken out [m]
};

class Flight {
 public:
  Flight(const ExactModes& modes, Propagator& propagator, SustainedContact& sustained);

  // The first event after `state`, where gaps and their rates are these, within `length`, and the state there in end(). Without one,
  // the flight may also be cut short: `time` says where. `regular`: the length is one of few that come again and again. `disturbed`:
  // impulses or loads have changed the motion since the last flight ended.
  FlightEvent find(const ModalState& state, const ContactState& contact, const VectorX& gap, const VectorX& rate, double length, bool regular,
                   bool disturbed);

  ModalState& end() { return end_; }
  double end_time() const { return finish_.time; }  // since the start of the flight [s]
  const VectorX& end_gap() const { return finish_.gap; }
  const VectorX& end_rate() const { return finish_.rate; }
  const ContactForces& forces() const { return forces_; }
  // That of all loads over the flight, from Propagator::energy().
  FlightEnergy energy(double length) { return have_energy_ ? sums_.energy : propagator_.energy(state_->f0, state_->f1, *state_, end_, length); }
  // Gap rounding counts as zero up to here [m], of a flight that was not far.
  double tolerance(int pair) const { return tolerance_[pair]; }
  long evaluations() const { return evaluations_; }

  // Derivatives n = 0..6 of the gap of a pair at the start of the flight; n = 0 without the constant.
  Eigen::Matrix<double, 7, 1> derivatives(int pair);

 private:
  struct Sample {
    double time = 0;
    VectorX gap, rate;
  };
  // Whether no pair can have come near on the way from these gaps to those of finish_, by bounds that cost one pass over the modes.
  bool stays_far(const VectorX& gap, const VectorX& rate, double length, const ModalSize& size) const;
  void bound(double length, bool disturbed);
  void evaluate(double s, Sample& sample);
  void add_compliance(double s, VectorX& gap, VectorX& rate) const;
  void find_openings(FlightEvent& event) const;
  void follow_touching(FlightEvent& event);
  // First crossing between two samples; time negative when there is none.
  FlightEvent search(const Sample& a, const Sample& b, int depth);
  GapPiece piece(int pair, const Sample& a, const Sample& b) const;
  double refine(int pair, const Sample& a, const Sample& b);

  const ExactModes& modes_;
  Propagator& propagator_;
  SustainedContact& sustained_;
  const ModalState* state_ = nullptr;
  const ContactState* contact_ = nullptr;
  ContactForces forces_;
  ModalState end_, probe_;
  Sample start_, finish_;
  VectorX fourth_, tolerance_, rounding_, rate_rounding_, size_, rate_size_;
  VectorX far_factor_, row_size_;  // of a pair's gap: fourth derivative by sqrt(energy), its size by |x|; none where stays_far() can't tell
  std::vector<bool> skip_;        // closed, or certain to stay open
  Eigen::Matrix<double, Eigen::Dynamic, 7> mode_derivatives_;
  bool have_derivatives_ = false;
  bool bound_holds_ = false;
  FlightSums sums_;
  bool have_energy_ = false;      // in sums_
  long evaluations_ = 0;
};

}  // namespace nsframe
