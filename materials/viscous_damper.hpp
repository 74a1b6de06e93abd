// Spring K and nonlinear dashpot Cd, alpha one behind the other (Maxwell; OpenSees' ViscousDamper). Theory.md, 133.
// Solved to rounding by the theta scheme of the step, where OpenSees integrates by Runge-Kutta steps.
#pragma once

#include <limits>

#include "materials/rate.hpp"

namespace nsframe {

struct ViscousDamper {
  static constexpr const char* name = "ViscousDamper";
  double K = 0;      // [Pa], in a spring [N/m]
  double Cd = 0;     // [Pa s^alpha], in a spring [N (s/m)^alpha]
  double alpha = 1;  // [-]
  double LGap = 0;   // [-], in a spring [m]

  template <class Visit, class Law>
  static void visit_parameters(Visit&& visit, Law& law) {
    using namespace parameter;
    visit(required(stress("K", "stiffness of the spring in series with the dashpot", range::positive)), law.K);
    visit(required(number("Cd", "stress of the dashpot at the rate 1/s; in a spring force at 1 m/s", range::positive)), law.Cd);
    visit(required(number("alpha", "exponent of the dashpot's rate", range::positive)), law.alpha);
    visit(number("LGap", "play of the pins: way without force after each change of the force's sign", range::non_negative), law.LGap);
  }

  // strain, stress, and of the pins their side, 0 before they first carry, and the way from there into the play
  int history_size() const { return rate_history_size + 2; }
  void initialize_history(double* history) const { history[0] = history[1] = history[2] = history[3] = 0; }
  double initial_tangent() const { return 0; }
  double yield_strain() const { return std::numeric_limits<double>::infinity(); }
  void respond(const PointArrays& points, Evaluate) const;
  // Throws ConvergenceError when the stress is not found.
  RatePoint respond_rate(double strain, const double* committed, double* trial, const StepSpan& step) const;
};

}  // namespace nsframe
