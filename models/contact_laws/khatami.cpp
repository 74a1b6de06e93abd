// Khatami et al. (2019): Jankowski's force with another xi(e). Its formula is damaged in the paper's print; here xi is the one
// that gives two free masses exactly the restitution e (theory.md, 257), which such formulas approximate.
#include <cmath>

#include "models/contact_laws/laws.hpp"

namespace nsframe {

namespace {

// In d^1.25 the closing phase is that of the linear dashpot, with xi sqrt(4/5).
double coefficient(double restitution) { return contact_laws::closing_dashpot_ratio(restitution) / std::sqrt(0.8); }

}  // namespace

const ContactForceLaw khatami_law{"khatami", ContactStiffness::hertz, true, 1e-6, coefficient,
                                  contact_laws::nonlinear_viscoelastic_force};

}  // namespace nsframe
