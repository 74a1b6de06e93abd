// k d^1.5 (1 + 8 (1 - e) / (5 e v) d') with the approach velocity v of this contact, as the paper prints it (Muthukumar and
// DesRoches 2006 with the factor of Ye et al. 2009). The e that comes out is that of theory.md (255), not e itself. Where the
// bracket is negative the sides part without a force.
#include <cmath>

#include "models/contact_laws/laws.hpp"

namespace nsframe {

namespace {

double coefficient(double restitution) { return 1.6 * (1 - restitution) / restitution; }

ContactForce force(double stiffness, double damping, double penetration, double rate, double approach) {
  const double root = std::sqrt(penetration), elastic = stiffness * penetration * root;
  const double per_rate = approach > 0 ? damping / approach : 0;  // a contact that began at rest is elastic
  const double bracket = 1 + per_rate * rate;
  if (bracket <= 0) return {};
  return {elastic * bracket, 1.5 * stiffness * root * bracket, elastic * per_rate};
}

}  // namespace

const ContactForceLaw hertz_damped_law{"hertz-damped", ContactStiffness::hertz, false, 1e-6, coefficient, force};

}  // namespace nsframe
