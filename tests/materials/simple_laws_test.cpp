// Elastic with two moduli, ENT, ElasticPPGap, Hardening, Steel01 with isotropic hardening.
#include <doctest/doctest.h>

#include "tests/materials/point.hpp"

using namespace nsframe;
using namespace nsframe::test;

TEST_CASE("simple laws follow the OpenSees histories in stress and tangent") {
  const double gap = 0.00129999999999;  // 1e-14 below a strain of the history, see ElasticPPGap
  const std::pair<const char*, UniaxialLaw> cases[] = {
      {"elastic_eneg", Elastic{E, 70e9}},
      {"ent", ENT{E}},
      {"elasticppgap", ElasticPPGap{E, fy, gap, 0.02}},
      {"elasticppgap_damage", ElasticPPGap{E, fy, gap, 0.02, true}},
      {"elasticppgap_compression", ElasticPPGap{E, -fy, -gap, 0.02}},
      {"elasticppgap_compression_damage", ElasticPPGap{E, -fy, -gap, 0.02, true}},
      {"hardening", Hardening{E, fy, 0.01 * E, 0.02 * E}},
      {"steel01_iso", Steel01Isotropic{fy, E, b, 0.04, 1.0, 0.02, 1.5}},
  };
  for (const auto& [name, law] : cases) {
    CAPTURE(std::string(name));
    const Difference worst = compare_history(law, name);
    // roundings of 240 increments of E times strain; the gap's contact is off by 1e-14 E = 9e-12 of the peak
    CHECK(worst.stress < 2e-11);
    CHECK(worst.tangent < 1e-12);
  }
}

TEST_CASE("an elastic law with two moduli has each on its side") {
  const Point point(Elastic{E, 0.3 * E});
  CHECK(point.probe(1e-3).stress == E * 1e-3);
  CHECK(point.probe(-1e-3).stress == -0.3 * E * 1e-3);
  CHECK(point.probe(-1e-3).tangent == 0.3 * E);
  CHECK(is_linear(Elastic{E, E}));
  CHECK_FALSE(is_linear(Elastic{E, 0.3 * E}));
  CHECK(initial_tangent(Elastic{E, 2 * E}) == 2 * E);
}

TEST_CASE("a tension-only cable is an elastic law without modulus in compression") {
  const Point point(Elastic{E, 0});
  CHECK(point.probe(-1e-3).stress == 0);
  CHECK(point.probe(-1e-3).tangent == 0);
}

TEST_CASE("a gap that yields closes again where it was, or later with damage") {
  const double gap = 0.002, far = gap + 5 * yield;
  Point healed(ElasticPPGap{E, fy, gap, 0.05}), damaged(ElasticPPGap{E, fy, gap, 0.05, true});
  const double peak = fy + 0.05 * E * 4 * yield;
  CHECK(healed.move(far).stress == doctest::Approx(peak).epsilon(1e-14));
  CHECK(damaged.move(far).stress == doctest::Approx(peak).epsilon(1e-14));
  // back over the whole gap in one step or in many
  healed.move(-0.001);
  damaged.move(-0.001);
  CHECK(healed.probe(gap + 0.5 * yield).stress == doctest::Approx(0.5 * fy).epsilon(1e-13));
  CHECK(healed.probe(far).stress == doctest::Approx(peak).epsilon(1e-13));
  CHECK(damaged.probe(gap + 0.5 * yield).stress == 0);
  CHECK(damaged.probe(far - peak / E - 1e-9).stress == 0);
  CHECK(damaged.probe(far - 0.5 * peak / E).stress == doctest::Approx(0.5 * peak).epsilon(1e-12));
}

TEST_CASE("a gap with damage loads and unloads on one line until it yields further") {
  Point point(ElasticPPGap{E, -fy, -0.002, 0.05, true});
  const double far = -0.002 - 3 * yield;
  const double peak = point.move(far).stress;
  for (const double share : {0.2, 0.9, 0.1, 1.0}) {
    const double strain = far - (1 - share) * peak / E;
    CHECK(point.move(strain).stress == doctest::Approx(share * peak).epsilon(1e-12));
  }
  CHECK(has_yielded(ElasticPPGap{E, -fy, -0.002, 0.05}, far, peak));
  CHECK_FALSE(has_yielded(ElasticPPGap{E, -fy, -0.002, 0.05}, -0.002 - 0.5 * yield, -0.5 * fy));
  CHECK_FALSE(has_yielded(ElasticPPGap{E, -fy, -0.002, 0.05}, 0.05, 0));
}

TEST_CASE("isotropic hardening widens the elastic range, kinematic hardening shifts it") {
  const double H = 0.05 * E, plastic = 2 * yield;  // plastic strain of the excursion
  const double rise = H * plastic, strain = yield + plastic + rise / E;
  Point isotropic(Hardening{E, fy, H, 0}), kinematic(Hardening{E, fy, 0, H});
  CHECK(isotropic.move(strain).stress == doctest::Approx(fy + rise).epsilon(1e-13));
  CHECK(kinematic.move(strain).stress == doctest::Approx(fy + rise).epsilon(1e-13));
  const auto yields_at = [&](Point& point, double stress) {
    const double e = plastic + stress / E;
    return point.probe(e + 1e-6 * yield).tangent == E && point.probe(e - 1e-6 * yield).tangent < 0.1 * E;
  };
  CHECK(yields_at(isotropic, -fy - rise));
  CHECK(yields_at(kinematic, -fy + rise));
}

TEST_CASE("kinematic hardening alone is Steel01") {
  const double ratio = 0.03, H = ratio * E / (1 - ratio);
  CHECK(rc::check([&] {
    Point hardening(Hardening{E, fy, 0, H}), steel(Steel01{fy, E, ratio});
    for (const int i : *history_of(50)) {
      const double strain = 0.01 * i * yield;
      // roundings of 50 increments over up to 40 yield strains
      RC_ASSERT(std::abs(hardening.move(strain).stress - steel.move(strain).stress) < 2000 * epsilon * fy);
    }
  }));
}

TEST_CASE("Steel01 without isotropic parameters is the same law") {
  CHECK(rc::check([&] {
    Point with(Steel01Isotropic{fy, E, b}), without(Steel01{fy, E, b});
    for (const int i : *history_of(50)) {
      const UniaxialPoint first = with.move(0.01 * i * yield), second = without.move(0.01 * i * yield);
      RC_ASSERT(first.stress == second.stress);
    }
  }));
}

TEST_CASE("the yield line of Steel01 moves at a reversal by the excursion so far") {
  Point point(Steel01Isotropic{fy, E, b, 0.1, 2, 0.2, 3});
  point.move(4 * yield);
  // first reversal: excursion 4 over 2 a2 = 4 yield strains
  const double compression = point.move(-6 * yield).stress;
  CHECK(compression == doctest::Approx(-b * 6 * fy - 1.1 * (1 - b) * fy).epsilon(1e-13));
  // second: excursion 10 over 2 a4 = 6
  const double tension = point.move(6 * yield).stress;
  CHECK(tension == doctest::Approx(b * 6 * fy + (1 + 0.2 * std::pow(10.0 / 6, 0.8)) * (1 - b) * fy).epsilon(1e-13));
}

TEST_CASE("simple laws are elastic inside their elastic range whatever the path") {
  const UniaxialLaw laws[] = {Hardening{E, fy, 0.02 * E, 0.03 * E}, Steel01Isotropic{fy, E, b, 0.05, 1, 0.05, 1},
                              ElasticPPGap{E, fy, 0, 0.02, true}};
  for (const UniaxialLaw& law : laws) {
    const double low = std::holds_alternative<ElasticPPGap>(law) ? 0 : -99;
    CHECK(rc::check([&] {
      Point point(law);
      for (const int i : *rc::gen::container<std::vector<int>>(50, rc::gen::inRange(-99, 100))) {
        const double strain = 0.01 * std::max<double>(i, low) * yield;
        RC_ASSERT(std::abs(point.move(strain).stress - E * strain) < 100 * epsilon * fy);
      }
    }));
  }
}

TEST_CASE("parameters of simple laws that contradict each other are refused by name") {
  CHECK(fault_of(ElasticPPGap{E, 0, 0.001}) == "Fy must not be zero");
  CHECK(fault_of(ElasticPPGap{E, fy, -0.001}) == "gap must have the sign of Fy");
  CHECK(fault_of(ElasticPPGap{E, -fy, 0.001}).starts_with("gap"));
  CHECK(fault_of(ElasticPPGap{E, fy, 0.001, 1}).starts_with("eta must lie in [0, 1)"));
  CHECK(fault_of(Hardening{E, fy, 0, -1.01 * E}).starts_with("H_kin"));
  CHECK(fault_of(Hardening{E, fy, -1, 0}) == "H_iso must not be negative");
  CHECK(fault_of(Elastic{E, -1}).starts_with("Eneg"));
  CHECK(fault_of(Steel01Isotropic{fy, E, b, 0.1, 0}).starts_with("a2"));
  CHECK(fault_of(ENT{0}) == "E must be positive");
  CHECK(fault_of(Steel01{std::numeric_limits<double>::infinity(), E, b}) == "fy must be finite");
}
