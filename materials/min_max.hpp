// A law that breaks for ever when its strain reaches a bound (OpenSees' MinMax): no stress from then on. OpenSees
// leaves 1e-8 of the initial tangent; here the tangent is the derivative, zero.
#pragma once

#include "materials/wrapper.hpp"

namespace nsframe {

struct MinMax {
  static constexpr const char* name = "MinMax";
  InnerLaw material = {};
  std::optional<double> min = {}, max = {};  // [-]

  template <class Visit, class Law>
  static void visit_parameters(Visit&& visit, Law& law) {
    using namespace parameter;
    visit(law_inside("material", "the law that breaks"), law.material);
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
