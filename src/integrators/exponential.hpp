// The scheme `exponential` for nonlinear scenes (theory.md, section 16): the structure with its stiffness K at rest moves exactly, with
// located impacts and sustained contact; what the internal force differs by, r = P(q) - K q, is a load that is linear over a step and
// known from one evaluation of the elements. No iterations, nothing is factored. Second order, also across impacts. Of modes too fast for the
// step the elements see the static part.
#pragma once

#include "integrators/event_flow.hpp"

namespace nsframe {

inline constexpr int exponential_levels = 20;      // parts of a step down to dt / 2^20
inline constexpr int exponential_steps = 64;       // that a part is over at most, with `accuracy`
inline constexpr double farthest_turn = 3;         // [rad] of a mode between two evaluations, that elements can follow (theory.md, 236)
inline constexpr double exponential_rest = 1e-8;   // of the largest displacement, that counts as none

class Exponential : public Scheme {
 public:
  // Throws InputError for what it cannot take: rate-dependent elements, damping that follows the tangent, contact or
  // dashpots at DOFs without mass.
  Exponential(const AnalysisOptions& options, const System& system);
  std::string name() const override { return "exponential"; }
  bool condenses_massless() const override { return true; }
  void begin_anew(const System& system, const State& committed) override {
    Scheme::begin_anew(system, committed);
    begins_ = true;
  }
  bool leaves_histories_behind() const override { return options_.accuracy > 0; }
  void histories_wanted_after(int steps) override { span_.most = steps; }
  void step(System& system, const State& committed, State& trial, double h, StepResult& result) override;
  ModeResponse mode_response(double w, double xi, double) const override { return {w > 0 ? xi : 0, flow_.kept_frequency(w)}; }
  LeftOut left_out() const override { return flow_.left_out(); }
  ModeResponse complex_mode(int structure, int mode) const override {
    const auto [ratio, frequency] = flow_.modes().complex_mode(structure, mode);
    return {ratio, frequency};
  }
  double resting_frequency() const override { return options_.accuracy == 0 && fastest_ * options_.dt > farthest_turn ? farthest_turn / options_.dt : 0; }
  long factorizations() const override { return 0; }
  // Within a part over several steps, shorter ones would lack the histories to begin from.
  bool shorter_steps_help() const override { return span_.steps == 0; }
  void save(Snapshot& snapshot) const override;
  void restore(System& system, const Snapshot& snapshot) override;
  std::vector<std::string> describe() const override;

 private:
  // r with what it does to the modes and to what has no mass.
  struct Residual {
    VectorX force, modal, massless;     // r [N], Phi' r, F r
  };
  void project(Residual& r);  // fills r.modal from r.force
  void find_modes(const System& system);
  void start(System& system, const State& committed);
  // What the elements are shown of the modes at the end of a part of length s: of those that turn too far, where they would rest.
  void show(const ModalState& end, double s, bool in_contact, VectorX& shown);
  // Evaluates the elements where the modes are at x, with histories; what has no mass stands where `massless` = F r wants it, and is
  // followed until it rests: by K, or by a tangent where K does not lead there quickly. Fills next_.
  void evaluate(System& system, const VectorX& x, const VectorX& massless, const VectorX& committed, VectorX& trial);
  // The error of a part of length s if the residual goes on as it did, from one evaluation at its end, which fills next_ and `to`.
  double foresee(System& system, double time, double s, bool starting, const VectorX& from, VectorX& to);
  // What was found at the end of a part of length s: the rates over it.
  void take_rates(double s);
  // The work that the residual does on what rests, over that part of its change from now_ to next_.
  void add_rest_work(double part, StepResult& result) const;
  // A part over several steps, where its error allows it.
  void begin_span(System& system, const State& committed, double h, StepResult& result);
  void go_on_in_span(System& system, const State& committed, State& trial, double h, StepResult& result);
  void make_parts(System& system, const State& committed, State& trial, double h, bool fresh, StepResult& result);
  // One part of a step; false, with everything as before, when its error is too large.
  bool advance(System& system, double time, double s, bool starting, const VectorX& committed, VectorX& trial, StepResult& result);
  // Over how many steps the next part may go after one over `steps` with this error_ratio().
  int steps_after(int steps, double error) const;
  // Error of a part of length s, from the modal r that was not expected, relative to what the options allow.
  double error_ratio(const VectorX& unexpected, double s);

  AnalysisOptions options_;
  EventFlow flow_;
  BlockOperator stiffness_;             // K
  BlockOperator nonlinear_stiffness_;   // its part of nonlinear elements
  VectorX flexibility_;                 // 1 / w^2 of oscillators [s2]
  VectorX inverse_frequency_;           // 1 / w of oscillators, at most 1 s
  VectorX mode_size_;                   // largest entry of every mode
  double fastest_ = 0;                  // frequency of a mode of which nonlinear elements have a share [rad/s]
  VectorX mode_share_;                  // of nonlinear elements in the stiffness of every mode
  double scale_ = 0;                    // displacement under static loads and peak ground accelerations, statically [m]
  bool begins_ = true;                  // with the next step, from the internal force of its state
  VectorX start_force_;                 // now_.force at the start of the step, should it fail
  // at the end of the last part
  Residual now_;
  VectorX modal_rate_, massless_rate_;  // of now_, over the last part
  double memory_ = 1;                   // part of an error of F r that one evaluation leaves
  MatrixX massless_stiffness_;          // N' K_t N, once it was wanted
  Eigen::PartialPivLU<MatrixX> massless_tangent_;
  double peak_ = 0;                     // largest displacement so far [m]
  int level_ = 0;                       // parts of h / 2^level_
  struct {
    int steps = 0, done = 0;            // of the part over several steps, 0 where there is none; those made
    int wanted = 1;                     // of the next part, where level_ is 0
    int most = 1;                       // steps until somebody wants histories
  } span_;                              // its end is in next_ and history_
  // work space
  Residual next_;
  VectorX shown_, load_, massless_, expected_massless_, follow_, history_, displacement_, nonlinear_force_, internal_;
  FlowState before_;
  ModalState expected_;
  StepResult tried_;
  int evaluations_ = 0;
};

}  // namespace nsframe
