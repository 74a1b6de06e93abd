// k d + c d' while closing, k d after: never pulls (the paper's MLVE; Mahmoud and Jankowski 2011). Its xi is solved from the
// e of two free masses; beyond xi = 1 arcosh and sqrt(xi^2 - 1) stand in (253).
#include <cmath>

#include "models/contact_laws/laws.hpp"

namespace nsframe {

namespace {

// Falls from 0 at xi = 0 without bound.
double log_restitution(double xi) {
  if (std::abs(xi - 1) < 1e-6) return -1 + (1 - xi) * 2 / 3;  // the next term is below rounding's square root
  const double root = std::sqrt(std::abs(1 - xi * xi));
  return -xi * (xi < 1 ? std::acos(xi) : std::acosh(xi)) / root;
}

ContactForce force(double stiffness, double damping, double penetration, double rate, double) {
  if (rate <= 0) return {stiffness * penetration, stiffness, 0};
  return {stiffness * penetration + damping * rate, stiffness, damping};
}

}  // namespace

double contact_laws::closing_dashpot_ratio(double restitution) {
  const double wanted = std::log(restitution);
  double low = 0, high = 1;
  while (log_restitution(high) > wanted) high *= 2;
  for (int i = 0; i < 200 && high - low > 1e-16 * high; ++i) {
    const double middle = 0.5 * (low + high);
    (log_restitution(middle) > wanted ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

const ContactForceLaw modified_linear_viscoelastic_law{"modified-linear-viscoelastic", ContactStiffness::linear, true, 1e-6,
                                                       contact_laws::closing_dashpot_ratio, force};

}  // namespace nsframe
