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

// One step of the Maxwell element alone. With the stress s at the theta point, s_+ = s_i + K (change - h g(s)) and
// s = (1 - theta) s_i + theta s_+.
struct MaxwellStep {
  double theta_stress, tangent, dissipated, after;
};

MaxwellStep maxwell(const ViscousDamper& law, double before, double change, const StepSpan& step) {
  const double a = step.theta * step.duration * law.K, reach = before + step.theta * law.K * change;
  const DashpotState dashpot = find_dashpot(law.Cd, law.alpha, a, std::abs(reach));
  const double stress = std::copysign(dashpot.stress, reach);
  return {stress, step.theta * law.K / (1 + a * dashpot.slope), step.duration * dashpot.rate * dashpot.stress,
          before + (stress - before) / step.theta};
}

// The step that ends without stress.
MaxwellStep come_to_rest(const ViscousDamper& law, double before, const StepSpan& step) {
  const double stress = (1 - step.theta) * before;
  return {stress, 0, step.duration * std::pow(std::abs(stress) / law.Cd, 1 / law.alpha) * std::abs(stress), 0};
}

}  // namespace

void ViscousDamper::respond(const PointArrays& points, Evaluate) const {
  respond_at_rest(points);
  for (int k = rate_history_size; k < history_size(); ++k) {
    for (int i = 0; i < points.count; ++i) points.trial[k * points.stride + i] = points.committed[k * points.stride + i];
  }
}

// The pins carry on one side (+1: the damper is in tension) or stand in their play, `way` from where they let go. The element behind
// them gets what of the change of strain the play does not take up (theory.md, 376).
RatePoint ViscousDamper::respond_rate(double strain, const double* committed, double* trial, const StepSpan& step) const {
  const double before = committed[1], change = strain - committed[0];
  double side = committed[2], way = committed[3];
  if (side == 0) side = before + change >= 0 ? 1 : -1;
  MaxwellStep end{0, 0, 0, 0};
  if (LGap == 0) {
    end = maxwell(*this, before, change, step);
  } else if (way == 0 && side * (end = maxwell(*this, before, change, step)).after >= 0) {
    // carries on
  } else {
    // to where the stress is gone, through the play, and on from there
    const MaxwellStep rest = come_to_rest(*this, before, step);
    const double to_rest = (rest.theta_stress - before) / (step.theta * K) +
                           std::copysign(step.duration * std::pow(std::abs(rest.theta_stress) / Cd, 1 / alpha), rest.theta_stress);
    const double reached = way - side * (change - to_rest);
    if (reached >= 0 && reached <= LGap) {
      way = reached;
      end = rest;
    } else if (reached > LGap) {
      end = maxwell(*this, before, change + side * (LGap - way), step);
      side = -side;
      way = 0;
    } else {
      end = maxwell(*this, before, change - side * way, step);
      way = 0;
    }
  }
  RatePoint point;
  point.stress = end.theta_stress;
  point.tangent = end.tangent;
  point.energy.dissipated = end.dissipated;
  point.energy.stored = (end.after - before) * (end.after + before) / (2 * K);
  trial[0] = strain;
  trial[1] = end.after;
  trial[2] = LGap == 0 || (committed[2] == 0 && end.after == 0) ? 0 : side;
  trial[3] = way;
  return point;
}

}  // namespace nsframe
