#include "materials/viscous_damper.hpp"

#include <cmath>

#include "base/errors.hpp"

namespace nsframe {

namespace {

struct DashpotState {
  double stress, rate, slope;  // [Pa], [1/s], rate by stress [1/(s Pa)]
};

// The stress s >= 0 with s + a g(s) = reach, g(s) = (s/C)^(1/alpha) the dashpot's rate, a [Pa s]. Newton on whichever of
// stress and rate makes the equation convex, from above, so that it comes down without overshoot.
DashpotState find_dashpot(double C, double alpha, double a, double reach) {
  constexpr int most = 100;
  constexpr double tolerance = 1e-15;
  const bool by_stress = alpha <= 1;
  const double p = by_stress ? 1 / alpha : alpha;
  // x + scale x^p = target
  const double scale = by_stress ? a * std::pow(C, -p) : C / a, target = by_stress ? reach : reach / a;
  double x = std::min(target, std::pow(target / scale, 1 / p));
  for (int i = 0; x > 0 && i < most; ++i) {
    const double power = scale * std::pow(x, p - 1);
    const double change = (x + power * x - target) / (1 + p * power);
    x -= change;
    if (!(std::abs(change) > tolerance * x)) {
      const double last = std::pow(x, p - 1);
      if (by_stress) return {x, std::pow(C, -p) * last * x, p * std::pow(C, -p) * last};
      return {C * last * x, x, 1 / (p * C * last)};
    }
  }
  if (x > 0 || !std::isfinite(reach)) throw ConvergenceError("a ViscousDamper does not find its stress");
  // at rest: slope of a power law at zero
  return {0, 0, alpha < 1 ? 0 : alpha > 1 ? std::numeric_limits<double>::infinity() : 1 / C};
}

}  // namespace

// With the stress s at the theta point, s_+ = s_i + K (change - h g(s)) and s = (1 - theta) s_i + theta s_+.
RatePoint ViscousDamper::respond_rate(double strain, const double* committed, double* trial, const StepSpan& step) const {
  const double before = committed[1], change = strain - committed[0], a = step.theta * step.duration * K;
  const double reach = before + step.theta * K * change;
  const DashpotState dashpot = find_dashpot(Cd, alpha, a, std::abs(reach));
  RatePoint point;
  point.stress = std::copysign(dashpot.stress, reach);
  point.tangent = step.theta * K / (1 + a * dashpot.slope);
  const double after = before + (point.stress - before) / step.theta;
  point.energy.dissipated = step.duration * dashpot.rate * dashpot.stress;
  point.energy.stored = (after - before) * (after + before) / (2 * K);
  trial[0] = strain;
  trial[1] = after;
  return point;
}

}  // namespace nsframe
