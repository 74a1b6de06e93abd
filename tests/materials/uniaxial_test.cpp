// Elastic, ElasticPP, Steel01, Steel02: closed forms and OpenSees histories (tests/reference/README.md).
#include "materials/uniaxial.hpp"

#include <doctest/doctest.h>
#include <rapidcheck.h>

#include <cmath>
#include <limits>

#include "tests/materials/point.hpp"

using namespace nsframe;
using namespace nsframe::test;

namespace {

const Steel02 isotropic_steel{fy, E, b, 18.5, 0.925, 0.15, 0.04, 1, 0.02, 1, 0};

}  // namespace

TEST_CASE("ElasticPP, Steel01 and Steel02 follow the OpenSees histories in stress and tangent") {
  // The reference has twelve digits; twice a rounding of 5e-12 in strain, plus the tangent's change over it, stays
  // below 1e-11. No strain of these histories lies on a corner, so tangents agree as well.
  const double tolerance = 1e-11;
  const std::pair<const char*, UniaxialLaw> cases[] = {
      {"elasticpp", ElasticPP{E, 0.00112, 0, 0}},
      {"steel01", Steel01{fy, E, b}},
      {"steel02", Steel02{fy, E, b, 20, 0.925, 0.15, 0, 1, 0, 1, 0}},
      {"steel02_iso", isotropic_steel},
  };
  for (const auto& [name, law] : cases) {
    CAPTURE(std::string(name));
    const Difference worst = compare_history(law, name);
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

TEST_CASE("a reversal of Steel02 starts its curve anew, however small it is; Steel01 has no memory of one") {
  // stress, over fy, by which the curve after a reversal of `size` differs half a yield strain later
  const auto jump = [](const UniaxialLaw& law, double size) {
    Point plain(law), reversed(law);
    for (Point* point : {&plain, &reversed}) {
      for (const double strain : {5.0, -5.0, 1.0}) point->move(strain * yield);
    }
    reversed.move((1 - size) * yield);
    return (reversed.move(1.5 * yield).stress - plain.move(1.5 * yield).stress) / fy;
  };
  const Steel02 steel{fy, E, b};
  CHECK(jump(steel, 1e-3) > 0.05);
  CHECK(std::abs(jump(steel, 1e-9) / jump(steel, 1e-6) - 1) < 1e-3);
  CHECK(std::abs(jump(Steel01{fy, E, b}, 1e-6)) < 1e-14);
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

TEST_CASE("unloading inside the elastic range returns on the same path") {
  for (const UniaxialLaw& law : {UniaxialLaw(ElasticPP{E, yield, 0, 0}), UniaxialLaw(Steel01{fy, E, b})}) {
    CHECK(rc::check([&] {
      Point point(law);
      double strain = 0, stress = 0;
      for (const int i : *history_of(10)) {
        strain = 0.01 * i * yield;
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
      const UniaxialPoint at = point.move(0.01 * i * yield);
      RC_ASSERT(std::abs(at.stress - E * 0.01 * i * yield) < 64 * epsilon * fy);
      RC_ASSERT(std::abs(at.tangent - E) < 64 * epsilon * E);
    }
  }));
}

TEST_CASE("yield strain and initial tangent are those of the virgin law") {
  CHECK(yield_strain(Elastic{E}) == std::numeric_limits<double>::infinity());
  CHECK(yield_strain(ElasticPP{E, yield, -0.5 * yield, 0}) == 0.5 * yield);
  CHECK(yield_strain(ElasticPP{E, yield, 0, 0}) == yield);
  CHECK(yield_strain(Steel01{fy, E, b}) == yield);
  CHECK(yield_strain(Steel02{fy, E, b}) == yield);
  CHECK(initial_tangent(Steel02{fy, E, b}) == E);
  CHECK(is_linear(Elastic{E}));
  CHECK_FALSE(is_linear(ElasticPP{E, yield, 0, 0}));
}

TEST_CASE("parameters outside their range are refused by name") {
  CHECK(fault_of(Elastic{-1}) == "E must be positive");
  CHECK(fault_of(ElasticPP{E, 0, 0, 0}) == "epsyP must be positive");
  CHECK(fault_of(ElasticPP{E, yield, yield, 0}).starts_with("epsyN"));
  CHECK(fault_of(Steel01{0, E, b}) == "fy must be positive");
  CHECK(fault_of(Steel01{fy, E, 1}).starts_with("b must"));
  CHECK(fault_of(Steel02{fy, E, b, 0}).starts_with("R0"));
  CHECK(fault_of(Steel02{fy, E, b, 20, 1.0}).starts_with("cR1"));
  CHECK(fault_of(Steel02{fy, E, b, 20, 0.9, 0}).starts_with("cR2"));
  CHECK(fault_of(Elastic{std::numeric_limits<double>::quiet_NaN()}) == "E must be positive");
}
