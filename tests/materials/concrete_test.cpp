// Concrete laws: OpenSees histories, closed forms of envelopes, unloading and tension.
#include <doctest/doctest.h>

#include "tests/materials/opensees_histories.hpp"

using namespace nsframe;
using namespace nsframe::test;

namespace {

const Concrete01 concrete01{-30e6, -0.002, -6e6, -0.006};
const Concrete02 concrete02{-30e6, -0.002, -6e6, -0.006, 0.1, 2.5e6, 2.5e9};
const Concrete04 concrete04{-30e6, -0.002, -0.006, 25e9, 2e6, 0.001, 0.1};

// Twelve digits of the reference, times the ratio of peak stress to the stresses and slopes that it cancels from.
constexpr double tolerance = 1e-9;

template <class Law>
void compare_random_histories(std::size_t count) {
  const std::vector<ReferenceHistory> histories = read_histories(Law::name);
  REQUIRE(histories.size() == count);
  for (const ReferenceHistory& history : histories) {
    CAPTURE(Law::name);
    CAPTURE(&history - histories.data());
    const Law law = law_of<Law>(history.parameters);
    CHECK(fault_of(law) == "");
    const Difference worst = difference_to(history, law);
    CHECK(worst.stress < tolerance);
    CHECK(worst.tangent < tolerance);
  }
}

}  // namespace

TEST_CASE("concrete laws follow OpenSees in stress and tangent through random histories") {
  compare_random_histories<Concrete01>(5);
  compare_random_histories<Concrete02>(8);
  compare_random_histories<Concrete04>(6);
}

TEST_CASE("Concrete01 and Concrete02 follow OpenSees through growing cycles") {
  for (const auto& [file, law] :
       {std::pair<const char*, UniaxialLaw>{"concrete01", concrete01}, {"concrete02", concrete02}}) {
    CAPTURE(file);
    ReferenceHistory history{{}, read_reference(file)};
    CHECK(difference_to(history, law).stress < tolerance);
    // a strain that comes back to just the least one so far is a corner: either slope is right there
    double least = 1;
    std::erase_if(history.rows, [&least](const auto& row) {
      const bool corner = row[0] == least;
      least = std::min(least, row[0]);
      return corner;
    });
    CHECK(history.rows.size() >= 319);
    CHECK(difference_to(history, law).tangent < tolerance);
  }
}

TEST_CASE("the Kent-Park envelope is a parabola, a line and a constant") {
  for (const UniaxialLaw& law : {UniaxialLaw(concrete01), UniaxialLaw(concrete02)}) {
    CHECK(initial_tangent(law) == 30e9);
    CHECK(Point(law).probe(-0.001).stress == doctest::Approx(-22.5e6).epsilon(4 * epsilon));
    CHECK(Point(law).probe(-0.002).stress == doctest::Approx(-30e6).epsilon(4 * epsilon));
    CHECK(Point(law).probe(-0.004).stress == doctest::Approx(-18e6).epsilon(4 * epsilon));
    CHECK(Point(law).probe(-0.004).tangent == doctest::Approx(-6e9).epsilon(4 * epsilon));
    CHECK(Point(law).probe(-0.02).stress == -6e6);
    CHECK(Point(law).probe(-0.02).tangent == 0);
  }
}

TEST_CASE("Concrete01 and Concrete04 unload to the plastic strains of Karsan and Jirsa") {
  for (const UniaxialLaw& law : {UniaxialLaw(concrete01), UniaxialLaw(concrete04)}) {
    for (const double ratio : {1.5, 2.5}) {
      CAPTURE(ratio);
      const double plastic = ratio < 2 ? 0.145 * ratio * ratio + 0.13 * ratio : 0.707 * (ratio - 2) + 0.834;
      Point point(law);
      const double stress = point.move(-0.002 * ratio).stress;
      const double middle = -0.001 * (ratio + plastic);
      CHECK(point.probe(middle).stress == doctest::Approx(stress / 2).epsilon(64 * epsilon));
      CHECK(point.probe(-0.002 * plastic + 1e-12).stress == 0);
      // the same way back, and on along the envelope
      point.move(-0.0001);
      CHECK(point.probe(middle).stress == doctest::Approx(stress / 2).epsilon(64 * epsilon));
      CHECK(point.probe(-0.0055).stress == Point(law).probe(-0.0055).stress);
    }
  }
}

TEST_CASE("Concrete02 unloads between two lines, of which the lower one points to a common focus") {
  // Ec er - fpcu = lambda Ec (er - epsU)
  const double Ec = 30e9, er = (-6e6 + 0.1 * Ec * 0.006) / (Ec * 0.9);
  for (const double least : {-0.0015, -0.003, -0.008}) {
    CAPTURE(least);
    Point point(concrete02);
    const double peak = point.move(least).stress;
    const double slope = (peak - Ec * er) / (least - er), closing = least - peak / slope;
    CHECK(point.probe(least + 1e-5).tangent == Ec);
    // far enough from the peak the stress is on the upper line, half as steep
    const double near = closing - 1e-5;
    CHECK(point.move(near).stress == doctest::Approx(-0.5 * slope * 1e-5).epsilon(1e-9));
    // and back along the lower one
    point.move(near - 1e-4);
    CHECK(point.probe(0.5 * (least + closing)).stress == doctest::Approx(peak / 2).epsilon(1e-12));
    CHECK(point.probe(0.5 * (least + closing)).tangent == doctest::Approx(slope).epsilon(1e-12));
  }
}

TEST_CASE("tension of Concrete02 starts where compression ends, softens, and reloads along the secant") {
  Point point(concrete02);
  const double Ec = 30e9, cracking = 2.5e6 / Ec;
  CHECK(point.probe(cracking).stress == doctest::Approx(2.5e6).epsilon(4 * epsilon));
  CHECK(point.move(3e-4).stress == doctest::Approx(2.5e6 - 2.5e9 * (3e-4 - cracking)).epsilon(16 * epsilon));
  CHECK(point.probe(1e-4).stress == doctest::Approx((2.5e6 - 2.5e9 * (3e-4 - cracking)) / 3).epsilon(16 * epsilon));
  CHECK(point.probe(2e-3).stress == 0);
  CHECK(point.probe(2e-3).tangent == 0);
  point.move(-0.003);
  // a crack in the concrete stays a crack: the secant now starts at e_t
  const double er = 12e6 / (0.9 * Ec), peak = -24e6, slope = (peak - Ec * er) / (-0.003 - er),
               closing = -0.003 - peak / slope;
  CHECK(point.probe(closing + 1e-4).stress == doctest::Approx((2.5e6 - 2.5e9 * (3e-4 - cracking)) / 3).epsilon(1e-12));
}

TEST_CASE("a Concrete02 whose focus lies in compression unloads on the initial slope near it") {
  const Concrete02 law{-30e6, -0.002, -6e6, -0.006, 0.0, 2.5e6, 2.5e9};  // the focus is at fpcu/Ec = -0.0002
  CHECK(fault_of(law) == "");
  Point point(law);
  const double least = -0.000205;
  const double peak = point.move(least).stress;
  CHECK(point.probe(least + 1e-6).tangent == 30e9);
  CHECK(point.probe(least + 1e-6).stress == doctest::Approx(peak + 30e3).epsilon(1e-12));
}

TEST_CASE("Concrete04 is Popovics' curve with exponential tension") {
  const double r = 25.0 / (25 - 15);
  for (const double ratio : {0.3, 1.0, 1.7, 2.9}) {
    CAPTURE(ratio);
    CHECK(Point(concrete04).probe(-0.002 * ratio).stress ==
          doctest::Approx(-30e6 * ratio * r / (r - 1 + std::pow(ratio, r))).epsilon(16 * epsilon));
  }
  CHECK(std::abs(Point(concrete04).probe(-0.002).tangent) < 1e-12 * 25e9);
  CHECK(Point(concrete04).probe(-0.0061).stress == 0);
  const double cracking = 2e6 / 25e9;
  CHECK(Point(concrete04).probe(0.001).stress == doctest::Approx(0.2e6).epsilon(1e-13));
  CHECK(Point(concrete04).probe(0.5 * (0.001 + cracking)).stress ==
        doctest::Approx(2e6 * std::sqrt(0.1)).epsilon(1e-13));
  Point point(concrete04);
  point.move(0.001);
  CHECK(point.probe(0.0004).stress == doctest::Approx(0.08e6).epsilon(1e-13));
  CHECK(point.probe(0.00101).stress == 0);
}

TEST_CASE("compressive parameters of concrete may have either sign") {
  const std::pair<UniaxialLaw, UniaxialLaw> pairs[] = {
      {concrete01, Concrete01{30e6, 0.002, 6e6, 0.006}},
      {concrete02, Concrete02{30e6, 0.002, 6e6, 0.006, 0.1, 2.5e6, 2.5e9}},
      {concrete04, Concrete04{30e6, 0.002, 0.006, 25e9, 2e6, 0.001, 0.1}},
  };
  for (const auto& [negative, positive] : pairs) {
    Point a(negative), b(positive);
    for (const double strain : {-0.001, -0.003, 0.0002, -0.004, 0.0005})
      CHECK(a.move(strain).stress == b.move(strain).stress);
  }
}

TEST_CASE("concrete parameters that contradict each other are refused by name") {
  CHECK(fault_of(Concrete01{0, -0.002, -6e6, -0.006}).starts_with("fpc"));
  CHECK(fault_of(Concrete01{-30e6, -0.002, -6e6, -0.002}).starts_with("epsU"));
  CHECK(fault_of(Concrete02{-30e6, -0.002, -6e6, -0.006, 1.0}).starts_with("lambda"));
  CHECK(fault_of(Concrete02{-30e6, -0.002, -6e6, -0.006, 0.1, -1e6}).starts_with("ft"));
  CHECK(fault_of(Concrete02{-30e6, -0.002, -6e6, -0.006, 0.1, 1e6, 0.0}).starts_with("Ets"));
  CHECK(fault_of(Concrete04{-30e6, -0.002, -0.006, 15e9}).starts_with("Ec"));
  CHECK(fault_of(Concrete04{-30e6, -0.002, -0.001, 25e9}).starts_with("ecu"));
  CHECK(fault_of(Concrete04{-30e6, -0.002, -0.006, 25e9, 2e6, 2e-5}).starts_with("et"));
}
