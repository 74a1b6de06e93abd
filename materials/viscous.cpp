#include "materials/viscous.hpp"

#include <cmath>

namespace nsframe {

RatePoint Viscous::respond_rate(double strain, const double* committed, double* trial, const StepSpan& step) const {
  const double change = strain - committed[0], rate = change / step.duration, speed = std::abs(rate);
  RatePoint point;
  if (alpha < 1 && speed < minVel) {
    const double slope = C * std::pow(minVel, alpha - 1);
    point.stress = slope * rate;
    point.tangent = slope / step.duration;
  } else {
    const double power = std::pow(speed, alpha - 1);  // 0^0 = 1: alpha = 1 is the linear dashpot also at rest
    point.stress = C * power * rate;
    point.tangent = alpha * C * power / step.duration;
  }
  point.energy.dissipated = point.stress * change;
  trial[0] = strain;
  trial[1] = point.stress;
  return point;
}

}  // namespace nsframe
