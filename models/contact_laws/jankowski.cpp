// Nonlinear viscoelastic (Jankowski 2005, 2006): k d^1.5 + c d' with c = 2 xi sqrt(k sqrt(d) m*) while closing, k d^1.5
// after; xi = (9 sqrt 5 / 2) (1 - e^2) / (e (e (9 pi - 16) + 16)), an approximation: theory.md (257) has the e that comes out.
#include <cmath>
#include <numbers>

#include "models/contact_laws/laws.hpp"

namespace nsframe {

ContactForce contact_laws::nonlinear_viscoelastic_force(double stiffness, double damping, double penetration, double rate, double) {
  const double root = std::sqrt(penetration);
  ContactForce out{stiffness * penetration * root, 1.5 * stiffness * root, 0};
  if (rate <= 0) return out;
  const double c = damping * std::sqrt(root);
  out.value += c * rate;
  out.by_penetration += 0.25 * c * rate / penetration;
  out.by_rate = c;
  return out;
}

namespace {

double coefficient(double e) { return 4.5 * std::sqrt(5.0) * (1 - e * e) / (e * (e * (9 * std::numbers::pi - 16) + 16)); }

}  // namespace

const ContactForceLaw jankowski_law{"jankowski", ContactStiffness::hertz, true, 1e-6, coefficient,
                                    contact_laws::nonlinear_viscoelastic_force};

}  // namespace nsframe
