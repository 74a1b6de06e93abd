// Nonlinear dashpot, stress = C |rate|^alpha sign(rate) (OpenSees' Viscous). Theory.md, 132.
// Below the rate minVel a law with alpha < 1 is linear, because its slope has no bound there; OpenSees holds the stress
// constant, which jumps at rest.
#pragma once

#include <limits>

#include "materials/rate.hpp"

namespace nsframe {

struct Viscous {
  static constexpr const char* name = "Viscous";
  double C = 0;           // [Pa s^alpha], in a spring [N (s/m)^alpha]
  double alpha = 1;       // [-]
  double minVel = 1e-6;   // [1/s], in a spring [m/s]

  template <class Visit, class Law>
  static void visit_parameters(Visit&& visit, Law& law) {
    using namespace parameter;
    visit(required(number("C", "stress at the strain rate 1/s; in a spring force at the velocity 1 m/s", range::positive)), law.C);
    visit(required(number("alpha", "exponent of the rate", range::positive)), law.alpha);
    visit(number("minVel", "rate below which a law with alpha < 1 is linear", range::positive), law.minVel);
  }

  int history_size() const { return rate_history_size; }
  void initialize_history(double* history) const { history[0] = history[1] = 0; }
  double initial_tangent() const { return 0; }
  double yield_strain() const { return std::numeric_limits<double>::infinity(); }
  void respond(const PointArrays& points, Evaluate) const { respond_at_rest(points); }
  RatePoint respond_rate(double strain, const double* committed, double* trial, const StepSpan& step) const;
};

}  // namespace nsframe
