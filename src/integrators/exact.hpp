// The scheme `exact` for linear scenes (theory.md, section 15): every mode moves in closed form under the piecewise linear loads, impacts
// and openings of contacts are located to rounding, with a proof that none is skipped; dt only says when results are kept.
// Newton's impact law; impacts that accumulate end in sustained contact, whose forces are found by collocation.
#pragma once

#include "integrators/event_flow.hpp"

namespace nsframe {

class Exact : public Scheme {
 public:
  // Throws InputError for nonlinear elements, and as exact_modes() does.
  Exact(const AnalysisOptions& options, const System& system);
  std::string name() const override { return "exact"; }
  bool condenses_massless() const override { return true; }
  void begin_anew(const System& system, const State& committed) override;
  void step(System& system, const State& committed, State& trial, double h, StepResult& result) override;
  ModeResponse mode_response(double w, double xi, double) const override { return {w > 0 ? xi : 0, flow_.kept_frequency(w)}; }
  LeftOut left_out() const override { return flow_.left_out(); }
  ModeResponse complex_mode(int structure, int mode) const override {
    const auto [ratio, frequency] = flow_.modes().complex_mode(structure, mode);
    return {ratio, frequency};
  }
  long factorizations() const override { return 0; }
  bool shorter_steps_help() const override { return false; }
  void save(Snapshot& snapshot) const override;
  void restore(System& system, const Snapshot& snapshot) override;
  std::vector<std::string> describe() const override;

 private:
  EventFlow flow_;
  bool begins_ = true;  // with the next step
};

}  // namespace nsframe
