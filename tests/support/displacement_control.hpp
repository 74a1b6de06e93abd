// Pushover by a prescribed displacement, for tests.
#pragma once

#include <doctest/doctest.h>

#include "base/decompositions.hpp"
#include "integrators/static_analysis.hpp"

namespace nsframe::test {

// Newton with one displacement prescribed: load = dead + factor * pattern, displacement[dof] = target. The pattern is a unit
// force on that displacement if none is given.
class DisplacementControl {
 public:
  DisplacementControl(System& system, VectorX dead, int dof, VectorX pattern = {})
      : system_(system), dead_(std::move(dead)), dof_(dof), pattern_(std::move(pattern)) {
    if (pattern_.size() == 0) pattern_ = VectorX::Unit(dead_.size(), dof_);
  }

  double factor = 0;
  void reach(double target, State& state) {
    State trial = state;
    system_.assembler.start_step(state.history, trial.history);
    for (int i = 0; i < 100; ++i) {
      system_.assembler.internal_force(trial.displacement, state.history, trial.history, trial.internal_force);
      const VectorX residual = dead_ + factor * pattern_ - trial.internal_force;
      const double miss = target - trial.displacement[dof_];
      if (residual.norm() < 1e-6 && std::abs(miss) < 1e-15) {
        std::swap(state, trial);
        return;
      }
      const Eigen::PartialPivLU<MatrixX> K{MatrixX(system_.assembler.tangent())};
      const VectorX by_residual = K.solve(residual), by_pattern = K.solve(pattern_);
      const double length = i >= 30 && i < 40 ? 0.5 : 1;  // out of circles that corners of laws send Newton into
      const double change = length * (miss - by_residual[dof_]) / by_pattern[dof_];
      factor += change;
      trial.displacement += length * by_residual + change * by_pattern;
    }
    FAIL("displacement control did not converge at " << target);
  }

 private:
  System& system_;
  VectorX dead_;
  int dof_;
  VectorX pattern_;
};

}  // namespace nsframe::test
