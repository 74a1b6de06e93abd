// Uniaxial laws: closed forms, OpenSees histories (tests/reference/README.md), and properties over random histories.
#include "materials/uniaxial.hpp"

#include <doctest/doctest.h>
#include <rapidcheck.h>

#include <cmath>
#include <limits>

#include "tests/support/reference_data.hpp"

using namespace nsframe;

namespace {

constexpr double epsilon = std::numeric_limits<double>::epsilon();
constexpr double fy = 235e6, E = 210e9, b = 0.01, yield = fy / E;  // [Pa], [Pa], [-], [-]

// A material point that commits every strain it is given.
class Point {
 public:
  explicit Point(UniaxialLaw law) : law_(std::move(law)), committed_(history()), trial_(history()) {
    initialize_history(law_, committed_.data());
  }
  // Response at a trial strain; nothing is committed.
  UniaxialPoint probe(double strain) const {
    std::vector<double> scratch(committed_.size());
    return respond(law_, strain, committed_.data(), scratch.data());
  }
  UniaxialPoint move(double strain) {
    const UniaxialPoint point = respond(law_, strain, committed_.data(), trial_.data());
    std::swap(committed_, trial_);
    return point;
  }
  const std::vector<double>& committed() const { return committed_; }

 private:
  std::vector<double> history() const { return std::vector<double>(static_cast<std::size_t>(history_size(law_))); }
  UniaxialLaw law_;
  std::vector<double> committed_, trial_;
};

struct NamedLaw {
  const char* name;
  UniaxialLaw law;
};

const Steel02 isotropic_steel{fy, E, b, 18.5, 0.925, 0.15, 0.04, 1, 0.02, 1, 0};

const std::vector<NamedLaw>& laws() {
  static const std::vector<NamedLaw> all = {
      {"Elastic", Elastic{E}},
      {"ElasticPP", ElasticPP{E, yield, 0, 0}},
      {"ElasticPP, uneven", ElasticPP{E, yield, -2 * yield, 0.3 * yield}},
      {"Steel01", Steel01{fy, E, b}},
      {"Steel01, softening", Steel01{fy, E, -0.02}},
      {"Steel02", Steel02{fy, E, b}},
      {"Steel02, isotropic", isotropic_steel},
      {"Steel02, initial stress", Steel02{fy, E, b, 20, 0.925, 0.15, 0, 1, 0, 1, 0.2 * fy}},
  };
  return all;
}

// Strains in steps of yield/100, up to 20 yield strains to either side.
rc::Gen<std::vector<int>> history_of(std::size_t points) {
  return rc::gen::container<std::vector<int>>(points, rc::gen::inRange(-2000, 2001));
}
double strain_of(int hundredths) { return hundredths * yield / 100; }

// The property must hold for every law and every random history.
template <class Property>
void check_for_all_laws(const Property& property) {
  for (const NamedLaw& law : laws()) {
    CAPTURE(law.name);
    CHECK(rc::check(law.name, [&] { property(law.law); }));
  }
}

// Largest differences to a reference history, relative to its largest stress and to the initial tangent.
struct Difference {
  double stress = 0, tangent = 0;
};

Difference compare_history(const UniaxialLaw& law, const std::string& file) {
  const test::Table table = test::read_reference(file);
  REQUIRE(table.size() == 241);
  double peak = 0;
  for (const auto& row : table) peak = std::max(peak, std::abs(row[1]));
  Difference worst;
  Point point(law);
  for (const auto& row : table) {
    const UniaxialPoint at = point.move(row[0]);
    worst.stress = std::max(worst.stress, std::abs(at.stress - row[1]) / peak);
    worst.tangent = std::max(worst.tangent, std::abs(at.tangent - row[2]) / initial_tangent(law));
  }
  return worst;
}

}  // namespace

TEST_CASE("ElasticPP, Steel01 and Steel02 follow the OpenSees histories in stress and tangent") {
  // The reference has twelve digits; twice a rounding of 5e-12 in strain, plus the tangent's change over it, stays
  // below 1e-11. No strain of these histories lies on a corner, so tangents agree as well.
  const double tolerance = 1e-11;
  const NamedLaw cases[] = {
      {"elasticpp", ElasticPP{E, 0.00112, 0, 0}},
      {"steel01", Steel01{fy, E, b}},
      {"steel02", Steel02{fy, E, b, 20, 0.925, 0.15, 0, 1, 0, 1, 0}},
      {"steel02_iso", isotropic_steel},
  };
  for (const NamedLaw& c : cases) {
    CAPTURE(c.name);
    const Difference worst = compare_history(c.law, c.name);
    CHECK(worst.stress < tolerance);
    CHECK(worst.tangent < tolerance);
  }
}

TEST_CASE("an elastic law is a straight line through the origin") {
  Point point(Elastic{E});
  for (const double strain : {1e-3, -2e-3, 0.5, 0.0}) {
    CHECK(point.probe(strain).stress == E * strain);
    CHECK(point.move(strain).tangent == E);
  }
}

TEST_CASE("an elastic-perfectly plastic law yields at its two strains about the initial strain") {
  const double initial = 0.3 * yield;
  Point point(ElasticPP{E, yield, -2 * yield, initial});
  CHECK(point.move(0).stress == doctest::Approx(-E * initial).epsilon(4 * epsilon));
  CHECK(point.move(2 * yield).stress == doctest::Approx(fy).epsilon(4 * epsilon));
  CHECK(point.probe(2.1 * yield).tangent == 0);
  CHECK(point.move(-4 * yield).stress == doctest::Approx(-2 * fy).epsilon(4 * epsilon));
  CHECK(point.probe(-3.5 * yield).stress == doctest::Approx(-1.5 * fy).epsilon(16 * epsilon));
  CHECK(point.probe(-3.5 * yield).tangent == E);
}

TEST_CASE("a bilinear cycle of Steel01 passes the corners of kinematic hardening") {
  Point point(Steel01{fy, E, b});
  const double peak = fy + b * E * 4 * yield;
  CHECK(point.move(5 * yield).stress == doctest::Approx(peak).epsilon(8 * epsilon));
  // the elastic range keeps its width 2 fy
  CHECK(point.probe(3 * yield).stress == doctest::Approx(peak - 2 * fy).epsilon(16 * epsilon));
  CHECK(point.probe(3.01 * yield).tangent == E);
  CHECK(point.probe(2.99 * yield).tangent == doctest::Approx(b * E).epsilon(epsilon));
  CHECK(point.move(-5 * yield).stress == doctest::Approx(-peak).epsilon(8 * epsilon));
}

TEST_CASE("first loading of Steel02 is the Giuffre-Menegotto-Pinto curve") {
  const Steel02 law{fy, E, b};
  for (const double ratio : {0.1, 0.5, 0.9, 1.0, 1.1, 2.0, 10.0, -0.7, -3.0}) {
    CAPTURE(ratio);
    const double curve = b * ratio + (1 - b) * ratio / std::pow(1 + std::pow(std::abs(ratio), law.R0), 1 / law.R0);
    CHECK(Point(law).probe(ratio * yield).stress == doctest::Approx(fy * curve).epsilon(16 * epsilon));
  }
  // far out it lies on the hardening asymptote
  CHECK(Point(law).probe(20 * yield).stress == doctest::Approx(fy * (1 + 19 * b)).epsilon(1e-12));
}

TEST_CASE("Steel02 starts at its initial stress") {
  const Steel02 law{fy, E, b, 20, 0.925, 0.15, 0, 1, 0, 1, 0.2 * fy};
  Point point(law);
  CHECK(point.probe(0).stress == 0.2 * fy);
  CHECK(point.probe(0).tangent == E);
  CHECK(point.probe(0.1 * yield).stress == doctest::Approx(0.3 * fy).epsilon(1e-9));  // 0.3^20/20 of the curve
}

TEST_CASE("a virgin Steel02 fiber answers elastically to strains of a few epsilons") {
  Point point(Steel02{fy, E, b});
  double strain = 0;
  for (const double increment : {4 * epsilon, 4 * epsilon, -3 * epsilon, 20 * epsilon, 4 * epsilon}) {
    strain += increment;
    CHECK(point.move(strain).stress == doctest::Approx(E * strain).epsilon(1e-12));  // some 1000 epsilons
  }
}

TEST_CASE("isotropic hardening of Steel02 widens the cycle") {
  Point kinematic(Steel02{fy, E, b}), isotropic(isotropic_steel);
  for (int cycle = 0; cycle < 4; ++cycle) {
    for (const double strain : {0.01, -0.01}) {
      kinematic.move(strain);
      isotropic.move(strain);
    }
  }
  CHECK(isotropic.probe(-0.01).stress < 1.02 * kinematic.probe(-0.01).stress);
}

TEST_CASE("the tangent is the derivative of the stress along any history") {
  check_for_all_laws([](const UniaxialLaw& law) {
    Point point(law);
    for (const int i : *history_of(30)) point.move(strain_of(i));
    const double strain = strain_of(*rc::gen::inRange(-2000, 2000)) + 0.005 * yield;  // never a committed strain
    const double h = 1e-6 * yield;
    const double stress = point.probe(strain).stress;
    const double forward = (point.probe(strain + h).stress - stress) / h;
    const double backward = (stress - point.probe(strain - h).stress) / h;
    const double bend = std::abs(forward - backward);
    if (bend > 1e-3 * E) return;  // a corner within h
    // truncation is at most the bend; cancellation is epsilon (stress up to 2 fy) / h = 5e-10 E
    RC_ASSERT(std::abs(point.probe(strain).tangent - (forward + backward) / 2) < bend + 1e-8 * E);
  });
}

TEST_CASE("a response leaves the committed history as it was") {
  check_for_all_laws([](const UniaxialLaw& law) {
    Point point(law);
    for (const int i : *history_of(10)) point.move(strain_of(i));
    const std::vector<double> before = point.committed();
    const double strain = strain_of(*rc::gen::inRange(-2000, 2001));
    const UniaxialPoint first = point.probe(strain);
    point.probe(-strain);
    RC_ASSERT(point.committed() == before);
    // so that trials may come in any order
    const UniaxialPoint again = point.probe(strain);
    RC_ASSERT(first.stress == again.stress);
    RC_ASSERT(first.tangent == again.tangent);
  });
}

TEST_CASE("the response to the committed strain is the committed stress") {
  check_for_all_laws([](const UniaxialLaw& law) {
    Point point(law);
    double strain = 0, stress = point.probe(0).stress;
    for (const int i : *history_of(30)) {
      strain = strain_of(i);
      stress = point.move(strain).stress;
    }
    // Steel02 evaluates its curve again: rounding of a stress reached over 40 yield strains
    RC_ASSERT(std::abs(point.probe(strain).stress - stress) < 100 * epsilon * fy);
  });
}

TEST_CASE("unloading inside the elastic range returns on the same path") {
  for (const UniaxialLaw& law : {UniaxialLaw(ElasticPP{E, yield, 0, 0}), UniaxialLaw(Steel01{fy, E, b})}) {
    CHECK(rc::check([&] {
      Point point(law);
      double strain = 0, stress = 0;
      for (const int i : *history_of(10)) {
        strain = strain_of(i);
        stress = point.move(strain).stress;
      }
      // a small step from where the point yields last stays elastic towards the middle of the elastic range
      const double inward = point.probe(strain + 0.01 * yield).tangent == E ? 1 : -1;
      const double step = inward * 0.01 * yield * *rc::gen::inRange(1, 100);
      if (point.probe(strain + step).tangent != E) return;
      const double there = point.move(strain + step).stress;
      const double back = point.move(strain).stress;
      // rounding of strains up to 20 yield strains
      RC_ASSERT(std::abs(there - stress - E * step) < 100 * epsilon * fy);
      RC_ASSERT(std::abs(back - stress) < 100 * epsilon * fy);
    }));
  }
}

TEST_CASE("Steel02 is elastic to rounding while strains stay small, whatever the cycles") {
  // its curve departs by |e*|^R / R: 0.15^20/20 = 2e-18, where e* counts from a reversal at most 0.15 yield away
  CHECK(rc::check([] {
    Point point(Steel02{fy, E, b});
    for (const int i : *rc::gen::container<std::vector<int>>(30, rc::gen::inRange(-7, 8))) {
      const UniaxialPoint at = point.move(strain_of(i));
      RC_ASSERT(std::abs(at.stress - E * strain_of(i)) < 64 * epsilon * fy);
      RC_ASSERT(std::abs(at.tangent - E) < 64 * epsilon * E);
    }
  }));
}

TEST_CASE("random histories of a thousand strains stay finite") {
  check_for_all_laws([](const UniaxialLaw& law) {
    Point point(law);
    for (const int i : *history_of(1000)) {
      const UniaxialPoint at = point.move(strain_of(i));
      RC_ASSERT(std::isfinite(at.stress));
      RC_ASSERT(std::isfinite(at.tangent));
      // 20 yield strains: Steel02 may overshoot after partial unloading, never by as much as an elastic line
      RC_ASSERT(std::abs(at.stress) < 22 * fy);
    }
    for (const double value : point.committed()) RC_ASSERT(std::isfinite(value));
  });
}

TEST_CASE("Steel02 stays finite through strains that repeat and reverse by rounding errors") {
  for (const NamedLaw& law : laws()) {
    CAPTURE(law.name);
    Point point(law.law);
    for (const double center : {0.0, 0.5 * yield, 3 * yield, -5 * yield, 3 * yield, 0.0}) {
      for (const double offset : {0.0, 1e-16, 0.0, -1e-16, 1e-18, -1e-18, 1e-12, -1e-12, 0.0, 0.0}) {
        const UniaxialPoint at = point.move(center + offset * yield);
        CHECK(std::isfinite(at.stress));
        CHECK(std::isfinite(at.tangent));
      }
    }
  }
}

TEST_CASE("yield strain and initial tangent are those of the virgin law") {
  CHECK(yield_strain(Elastic{E}) == std::numeric_limits<double>::infinity());
  CHECK(yield_strain(ElasticPP{E, yield, -0.5 * yield, 0}) == 0.5 * yield);
  CHECK(yield_strain(ElasticPP{E, yield, 0, 0}) == yield);
  CHECK(yield_strain(Steel01{fy, E, b}) == yield);
  CHECK(yield_strain(Steel02{fy, E, b}) == yield);
  for (const NamedLaw& law : laws()) {
    CAPTURE(law.name);
    CHECK(initial_tangent(law.law) == E);
    CHECK(Point(law.law).probe(1e-9 * yield).tangent == doctest::Approx(E).epsilon(1e-9));
    CHECK(is_linear(law.law) == std::holds_alternative<Elastic>(law.law));
  }
}

TEST_CASE("parameters outside their range are refused by name") {
  const auto message = [](const UniaxialLaw& law) -> std::string {
    try {
      check_parameters(law);
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
    return "";
  };
  for (const NamedLaw& law : laws()) CHECK(message(law.law) == "");
  CHECK(message(Elastic{-1}) == "E must be positive");
  CHECK(message(ElasticPP{E, 0, 0, 0}) == "epsyP must be positive");
  CHECK(message(ElasticPP{E, yield, yield, 0}).starts_with("epsyN"));
  CHECK(message(Steel01{0, E, b}) == "fy must be positive");
  CHECK(message(Steel01{fy, E, 1}).starts_with("b must"));
  CHECK(message(Steel02{fy, E, b, 0}).starts_with("R0"));
  CHECK(message(Steel02{fy, E, b, 20, 1.0}).starts_with("cR1"));
  CHECK(message(Steel02{fy, E, b, 20, 0.9, 0}).starts_with("cR2"));
  CHECK(message(Elastic{std::numeric_limits<double>::quiet_NaN()}) == "E must be positive");
}
