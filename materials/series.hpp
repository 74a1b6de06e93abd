// Laws one behind the other: one stress, their strains add up (OpenSees' Series). The inner equilibrium is solved to
// rounding in every evaluation; OpenSees makes one iteration and carries the rest into the next, so that it agrees
// only where its own residual has died out.
#pragma once

#include "materials/wrapper.hpp"

namespace nsframe {

struct Series {
  static constexpr const char* name = "Series";
  static constexpr std::size_t most = 8;  // laws in one
  std::vector<InnerLaw> materials = {};

  template <class Visit, class Law>
  static void visit_parameters(Visit&& visit, Law& law) {
    using namespace parameter;
    visit(law_inside("materials", "the laws one behind the other, at most eight"), law.materials);
  }
  void check() const;

  int history_size() const;
  void initialize_history(double* history) const;
  double initial_tangent() const;
  double yield_strain() const;
  // Throws ConvergenceError when no distribution of the strain gives all laws one stress.
  void respond(const PointArrays& points, Evaluate evaluate) const;
};

}  // namespace nsframe
