// Low-cycle fatigue by Coffin-Manson and Miner (Uriz, Mahin 2008; OpenSees' Fatigue): a cycle of strain range X costs
// (X/E0)^(-1/m) of the life, cycles are counted by rainflow with at most three open reversals, and the law breaks
// when the sum reaches 1: at a reversal, or in tension while the half cycle at hand is counted as if it ended here.
// Ranges below 1e-10 cost nothing. Broken, it has no stress (OpenSees leaves 1e-8 of it).
#pragma once

#include "materials/wrapper.hpp"

namespace nsframe {

struct Fatigue {
  static constexpr const char* name = "Fatigue";
  InnerLaw material = {};
  double E0 = 0.191;               // strain range that fails in one cycle [-]
  double m = -0.458;               // slope of the Coffin-Manson line in log-log [-]
  std::optional<double> min = {}, max = {};  // strains at which it breaks at once [-]

  template <class Visit, class Law>
  static void visit_parameters(Visit&& visit, Law& law) {
    using namespace parameter;
    visit(law_inside("material", "the law that tires"), law.material);
    visit(strain("E0", "strain range that fails in one cycle", range::positive), law.E0);
    visit(number("m", "slope of the Coffin-Manson line in log-log", {-range::infinity, 0, false, true}), law.m);
    visit(with_default(strain("min", "strain at which it breaks in compression"), "none"), law.min);
    visit(with_default(strain("max", "strain at which it breaks in tension"), "none"), law.max);
  }
  void check() const;

  int history_size() const;
  void initialize_history(double* history) const;
  double initial_tangent() const;
  double yield_strain() const;
  bool has_yielded(double strain, double stress) const;
  void respond(const PointArrays& points, Evaluate evaluate) const;
};

}  // namespace nsframe
