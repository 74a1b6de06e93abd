// Anagnostopoulos (1988): Kelvin-Voigt with k_s as a multiple of the stiffness of the stiffer body.
#include "models/contact_laws/laws.hpp"

namespace nsframe {

const ContactForceLaw anagnostopoulos_law{"anagnostopoulos", ContactStiffness::relative, true, -1,
                                          contact_laws::kelvin_voigt_ratio, contact_laws::kelvin_voigt_force};

}  // namespace nsframe
