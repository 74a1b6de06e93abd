// The laws of contact force by themselves: tangents, what they do at the ends of a contact, and the restitution of two free
// masses, from an integration that knows nothing of the program, against closed forms (theory.md, 250-258).
#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <random>

#include "models/contact_law.hpp"
#include "tests/support/free_masses.hpp"
#include "tests/support/small_models.hpp"

using namespace nsframe;
using namespace nsframe::test;

namespace {

std::vector<const ContactForceLaw*> all_laws() {
  std::vector<const ContactForceLaw*> laws;
  for (const std::string& name : contact_law_names()) {
    if (name != "newton") laws.push_back(contact_force_law(name));
  }
  return laws;
}

double parted_with(std::string_view name, double e, double stiffness = 3e5, double mass = 2, double speed = 0.7) {
  const ContactForceLaw& law = *contact_force_law(name);
  const double c = damping_constant(law, stiffness, mass, e, {});
  return collide_free_masses(mass, speed, [&](double d, double rate) { return law.force(stiffness, c, d, rate, speed).value; }).restitution;
}

// ln e of a dashpot that acts while closing only.
double closing_dashpot_restitution(double xi) { return std::exp(-xi * std::acos(xi) / std::sqrt(1 - xi * xi)); }

// d - ln(1 + d) = -y - ln(1 - y), e = y / d; both sides rise.
double hertz_damped_restitution(double e) {
  const double d = 1.6 * (1 - e) / e, left = d - std::log1p(d);
  double low = 0, high = 1;
  for (int i = 0; i < 200; ++i) {
    const double y = 0.5 * (low + high);
    (-y - std::log1p(-y) < left ? low : high) = y;
  }
  return 0.5 * (low + high) / d;
}

std::string fault_of(const ContactLawChoice& choice, const std::vector<double>& restitutions = {}) {
  const auto found = faults(choice, restitutions);
  return found.size() == 1 ? found[0].key + ": " + found[0].message : std::to_string(found.size()) + " faults";
}

}  // namespace

TEST_CASE("tangents of the laws of contact force are the finite differences of their forces") {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> part(0.1, 1);
  for (const ContactForceLaw* law : all_laws()) {
    CAPTURE(law->name);
    for (int i = 0; i < 40; ++i) {
      const double k = 1e5 * part(random), c = damping_constant(*law, k, 3, 0.4 + 0.5 * part(random), {});
      const double d = 0.02 * part(random), rate = (i % 2 == 0 ? 1 : -1) * 0.3 * part(random), v = part(random), s = 1e-7;
      const ContactForce at = law->force(k, c, d, rate, v);
      const auto value = [&](double penetration, double speed) { return law->force(k, c, penetration, speed, v).value; };
      // central differences: s^2 of the third derivative, and rounding over s
      const double scale = std::abs(at.value) + k * d;
      CHECK(at.by_penetration == doctest::Approx((value(d + s * d, rate) - value(d - s * d, rate)) / (2 * s * d)).epsilon(1e-7).scale(scale));
      CHECK(at.by_rate == doctest::Approx((value(d, rate + s) - value(d, rate - s)) / (2 * s)).epsilon(1e-7).scale(scale));
    }
  }
}

TEST_CASE("contact forces begin and end at zero and never pull, but for Kelvin-Voigt's") {
  const double tiny = 1e-24, k = 1e6, m = 5, v = 0.4;
  for (const ContactForceLaw* law : all_laws()) {
    CAPTURE(law->name);
    const bool kelvin_voigt = law->force == contact_force_law("linear-viscoelastic")->force;
    const double c = damping_constant(*law, k, m, 0.6, {});
    const double begins = law->force(k, c, tiny, v, v).value;
    // the dashpot of the modified law begins with a jump too
    if (law->stiffness == ContactStiffness::linear || kelvin_voigt) CHECK(begins == doctest::Approx(c * v));
    if (law->stiffness == ContactStiffness::hertz) CHECK(begins < 2 * c * v * std::pow(tiny, 0.25) + 1e-12);
    CHECK(law->force(k, c, 0.01, 0, v).value == doctest::Approx(law->force(k, c, 0.01, 1e-13, v).value).epsilon(1e-11));
    CHECK(law->force(k, c, 0.01, 0, v).value == doctest::Approx(law->force(k, c, 0.01, -1e-13, v).value).epsilon(1e-11));
    if (kelvin_voigt) {
      CHECK(law->force(k, c, 1e-6, -v, v).value < 0);
    } else {
      for (double d = 0; d < 0.02; d += 1e-3) CHECK(law->force(k, c, d, -10 * v, v).value >= 0);
    }
    // more penetration and more closing never push less: what the solver of the step builds on
    for (double rate = -2 * v; rate < 2 * v; rate += 0.1 * v) {
      const ContactForce at = law->force(k, c, 0.01, rate, v);
      CHECK(at.by_penetration >= 0);
      CHECK(at.by_rate >= 0);
    }
  }
}

TEST_CASE("two free masses part with the restitution asked for under Kelvin-Voigt, its modified form and Khatami's ratio") {
  for (const double e : {0.05, 0.2, 0.4, 0.65, 0.9, 1.0}) {
    CAPTURE(e);
    for (const char* law : {"linear-viscoelastic", "modified-linear-viscoelastic", "khatami", "anagnostopoulos"}) {
      CAPTURE(law);
      CHECK(parted_with(law, e) == doctest::Approx(e).epsilon(1e-7));            // of the reference
      CHECK(parted_with(law, e, 4e8, 3000, 0.02) == doctest::Approx(e).epsilon(1e-7));  // whatever masses and speeds
    }
  }
  CHECK(parted_with("hertz", 1) == doctest::Approx(1).epsilon(1e-7));
}

TEST_CASE("Jankowski's ratio gives another restitution than asked for: that of a closing dashpot with xi sqrt(4/5)") {
  double worst = 0;
  for (const double e : {0.2, 0.3, 0.4, 0.5, 0.6, 0.65, 0.7, 0.8, 0.9}) {
    CAPTURE(e);
    const double xi = contact_force_law("jankowski")->coefficient(e), parted = parted_with("jankowski", e);
    if (xi * std::sqrt(0.8) < 1) CHECK(parted == doctest::Approx(closing_dashpot_restitution(std::sqrt(0.8) * xi)).epsilon(1e-7));
    if (e >= 0.4) worst = std::max(worst, std::abs(parted - e));
  }
  CHECK(parted_with("jankowski", 1) == doctest::Approx(1).epsilon(1e-7));
  CHECK(contact_force_law("jankowski")->coefficient(0.65) == doctest::Approx(0.3729).epsilon(1e-3));
  CHECK(worst == doctest::Approx(0.0070).epsilon(0.02));
}

TEST_CASE("the Hertz-damped law as printed parts with less than e: 0.58 for 0.6, 0.16 for 0.2") {
  for (const double e : {0.1, 0.2, 0.4, 0.6, 0.8, 0.95}) {
    CAPTURE(e);
    const double parted = parted_with("hertz-damped", e);
    CHECK(parted == doctest::Approx(hertz_damped_restitution(e)).epsilon(1e-7));
    CHECK(parted == doctest::Approx(parted_with("hertz-damped", e, 1e9, 4000, 3)).epsilon(1e-6));
  }
  CHECK(parted_with("hertz-damped", 0.6) == doctest::Approx(0.5773).epsilon(1e-4));
  CHECK(parted_with("hertz-damped", 0.2) == doctest::Approx(0.1555).epsilon(1e-3));
}

TEST_CASE("a damping ratio is turned back into the restitution that it stands for") {
  for (const ContactForceLaw* law : all_laws()) {
    if (!law->has_damping_ratio) continue;
    CAPTURE(law->name);
    for (const double e : {0.1, 0.5, 0.9, 1.0}) CHECK(restitution_of(*law, law->coefficient(e)) == doctest::Approx(e).epsilon(1e-12));
    CHECK(damping_constant(*law, 100, 4, 0.3, 0.25) == doctest::Approx(2 * 0.25 * 20));
  }
  CHECK(restitution_of(*contact_force_law("hertz"), 0.3) == 1);
  CHECK(restitution_of(*contact_force_law("linear-viscoelastic"), 1.5) == 0);
}

TEST_CASE("energy stored in a contact is the integral of its elastic force") {
  for (const ContactForceLaw* law : all_laws()) {
    double sum = 0;
    const int n = 20000;
    for (int i = 0; i < n; ++i) sum += law->force(2e5, 0, 0.03 * (i + 0.5) / n, 0.1, 1).value * 0.03 / n;
    CHECK(stored_energy(*law, 2e5, 0.03) == doctest::Approx(sum).epsilon(1e-6));  // midpoint rule
  }
}

TEST_CASE("wrong keys of a contact law are told with the law's name") {
  CHECK(fault_of({.name = "newton", .stiffness = 1e6}) == "stiffness: law 'newton' has no stiffness");
  CHECK(fault_of({.name = "jankovski", .hertz_stiffness = 1e6}).find("did you mean 'jankowski'") != std::string::npos);
  CHECK(fault_of({.name = "jankowski"}) == "hertz_stiffness: law 'jankowski' needs hertz_stiffness");
  CHECK(fault_of({.name = "jankowski", .stiffness = 1, .hertz_stiffness = 1e6}) == "stiffness: law 'jankowski' has no stiffness");
  CHECK(fault_of({.name = "linear-viscoelastic"}) == "stiffness: law 'linear-viscoelastic' needs either stiffness or stiffness_ratio");
  CHECK(fault_of({.name = "linear-viscoelastic", .stiffness = 1e6, .stiffness_ratio = 2}).find("either") != std::string::npos);
  CHECK(fault_of({.name = "anagnostopoulos", .stiffness_ratio = 2}) == "0 faults");
  CHECK(fault_of({.name = "anagnostopoulos"}) == "stiffness_ratio: law 'anagnostopoulos' needs stiffness_ratio");
  CHECK(fault_of({.name = "hertz", .hertz_stiffness = 1e6}, {0.6}) == "restitution: law 'hertz' is elastic: it has no restitution");
  CHECK(fault_of({.name = "hertz-damped", .hertz_stiffness = 1e6, .damping_ratio = 0.1}) == "damping_ratio: law 'hertz-damped' has no damping_ratio");
  CHECK(fault_of({.name = "khatami", .hertz_stiffness = 1e6, .damping_ratio = 0.1}, {0.6}).find("either restitution or damping_ratio") != std::string::npos);
  CHECK(fault_of({.name = "khatami", .hertz_stiffness = 1e6}, {0.0}).find("needs at least 1e-06") != std::string::npos);
  CHECK(fault_of({.name = "linear-viscoelastic", .stiffness = 1e6}, {0.0}) == "0 faults");
}
