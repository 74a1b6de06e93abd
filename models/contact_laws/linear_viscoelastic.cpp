// Kelvin-Voigt: k d + c d' while d > 0 (the paper's LVE; Anagnostopoulos 1988). Two free masses part with exactly e, because
// the force pulls towards the end of the contact; it jumps by c d' where the contact begins.
#include <cmath>
#include <numbers>

#include "models/contact_laws/laws.hpp"

namespace nsframe {

namespace contact_laws {

double kelvin_voigt_ratio(double restitution) {
  if (restitution == 0) return 1;
  const double log_e = std::log(restitution);
  return -log_e / std::hypot(std::numbers::pi, log_e);
}

ContactForce kelvin_voigt_force(double stiffness, double damping, double penetration, double rate, double) {
  return {stiffness * penetration + damping * rate, stiffness, damping};
}

}  // namespace contact_laws

const ContactForceLaw linear_viscoelastic_law{"linear-viscoelastic", ContactStiffness::linear, true, -1,
                                              contact_laws::kelvin_voigt_ratio, contact_laws::kelvin_voigt_force};

}  // namespace nsframe
