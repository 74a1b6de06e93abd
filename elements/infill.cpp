#include "elements/infill.hpp"

#include <cmath>

namespace nsframe {

// Theory.md, 135.
double relative_stiffness(const InfillPanel& p) {
  const double angle = std::atan2(p.height, p.length);
  const double lambda = std::pow(p.E * p.thickness * std::sin(2 * angle) / (4 * p.column_EI * p.height), 0.25);
  return lambda * p.column_height;
}

double strut_width(const InfillPanel& p) {
  return 0.175 * std::pow(relative_stiffness(p), -0.4) * std::hypot(p.height, p.length);
}

}  // namespace nsframe
