// Pushover by a prescribed displacement, for tests.
#pragma once

#include <doctest/doctest.h>

#include "base/decompositions.hpp"
#include "integrators/static_analysis.hpp"

namespace nsframe::test {

// Newton with one displacement prescribed: load = dead + factor * pattern, displacement[dof] = target.
class DisplacementControl {
 public:
  DisplacementControl(System& system, VectorX dead, int dof) : system_(system), dead_(std::move(dead)), dof_(dof) {}

  double factor = 0;
  void reach(double target, State& state) {
    State trial = state;
    system_.assembler.start_step(state.history, trial.history);
    const VectorX pattern = VectorX::Unit(dead_.size(), dof_);
    for (int i = 0; i < 100; ++i) {
      system_.assembler.internal_force(trial.displacement, state.history, trial.history, trial.internal_force);
      const VectorX residual = dead_ + factor * pattern - trial.internal_force;
      const double miss = target - trial.displacement[dof_];
      if (residual.norm() < 1e-6 && std::abs(miss) < 1e-15) {
        std::swap(state, trial);
        return;
      }
      const Eigen::PartialPivLU<MatrixX> K{MatrixX(system_.assembler.tangent())};
      const VectorX by_residual = K.solve(residual), by_pattern = K.solve(pattern);
      const double change = (miss - by_residual[dof_]) / by_pattern[dof_];
      factor += change;
      trial.displacement += by_residual + change * by_pattern;
    }
    FAIL("displacement control did not converge at " << target);
  }

 private:
  System& system_;
  VectorX dead_;
  int dof_;
};

}  // namespace nsframe::test
