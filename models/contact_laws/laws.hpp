// The laws of force, one a file of this folder; ../contact_laws.cpp registers them.
#pragma once

#include "models/contact_law.hpp"

namespace nsframe {

extern const ContactForceLaw linear_viscoelastic_law, modified_linear_viscoelastic_law, anagnostopoulos_law, hertz_law,
    hertz_damped_law, jankowski_law, khatami_law;

// Parts that several laws share.
namespace contact_laws {

// xi = -ln e / sqrt(pi^2 + ln^2 e), 1 at e = 0 (theory.md, 252).
double kelvin_voigt_ratio(double restitution);
// k d + c d'; it pulls at the end of the contact, where d' < -k d / c.
ContactForce kelvin_voigt_force(double stiffness, double damping, double penetration, double rate, double approach);
// xi of a linear dashpot that acts while closing only: ln e = -xi arccos(xi) / sqrt(1 - xi^2) (theory.md, 253).
double closing_dashpot_ratio(double restitution);
// k d^1.5 + c d^0.25 d' while closing, k d^1.5 after (theory.md, 256).
ContactForce nonlinear_viscoelastic_force(double stiffness, double damping, double penetration, double rate, double approach);

}  // namespace contact_laws
}  // namespace nsframe
