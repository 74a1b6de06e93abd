// k d^1.5, elastic: two free masses part as fast as they met.
#include <cmath>

#include "models/contact_laws/laws.hpp"

namespace nsframe {

namespace {

ContactForce force(double stiffness, double, double penetration, double, double) {
  const double root = std::sqrt(penetration);
  return {stiffness * penetration * root, 1.5 * stiffness * root, 0};
}

}  // namespace

const ContactForceLaw hertz_law{"hertz", ContactStiffness::hertz, false, -1, nullptr, force};

}  // namespace nsframe
