// Hysteretic: OpenSees histories, closed forms of backbone, pinching, damage and unloading.
#include <doctest/doctest.h>

#include "tests/materials/opensees_histories.hpp"

using namespace nsframe;
using namespace nsframe::test;

namespace {

// Slopes 100, 10 and -2, the same on both sides.
Hysteretic simple() { return {100, 1, 200, 11, 180, 21, -100, -1, -200, -11, -180, -21}; }

}  // namespace

TEST_CASE("Hysteretic follows OpenSees in stress and tangent") {
  std::vector<ReferenceHistory> histories = read_histories(Hysteretic::name);
  REQUIRE(histories.size() == 9);
  histories.push_back(
      {{200e6, 1e-3, 260e6, 0.01, 210e6, 0.03, -200e6, -1e-3, -260e6, -0.01, -210e6, -0.03, 0.7, 0.3, 0.01, 0.005, 0.2},
       read_reference("hysteretic")});
  for (const ReferenceHistory& history : histories) {
    CAPTURE(&history - histories.data());
    const Hysteretic law = law_of<Hysteretic>(history.parameters);
    CHECK(fault_of(law) == "");
    const Difference worst = difference_to(history, law);
    CHECK(worst.stress < 1e-9);
    // OpenSees has 1e-9 of the first slope of a side where the tangent is zero; sides differ by less than four times
    CHECK(worst.tangent < 5e-9);
  }
}

TEST_CASE("the first loading of Hysteretic follows its backbone, and two points make a bilinear one") {
  for (const auto& [strain, stress] :
       {std::pair{0.5, 50.0}, {1.0, 100.0}, {6.0, 150.0}, {16.0, 190.0}, {30.0, 180.0}}) {
    CHECK(Point(simple()).probe(strain).stress == doctest::Approx(stress).epsilon(8 * epsilon));
    CHECK(Point(simple()).probe(-strain).stress == doctest::Approx(-stress).epsilon(8 * epsilon));
  }
  Hysteretic two = simple();
  two.s3p = two.e3p = two.s3n = two.e3n = std::nullopt;
  two.s2p = 200;
  CHECK(Point(two).probe(9).stress == doctest::Approx(180).epsilon(8 * epsilon));
  CHECK(Point(two).probe(20).stress == doctest::Approx(290).epsilon(8 * epsilon));  // hardening goes on
}

TEST_CASE("reloading of Hysteretic passes the pinching point on its way to the target") {
  Hysteretic law = simple();
  law.pinchX = 0.5;
  law.pinchY = 0.3;
  Point point(law);
  point.move(5);  // 140
  CHECK(point.probe(4).stress == doctest::Approx(40).epsilon(1e-14));
  CHECK(point.move(3.6).stress == doctest::Approx(0).scale(100));
  // target (-1, -100); the pinching point at half the way from 3.6 to -1 + 0.7 100/100 = -0.3
  CHECK(point.probe(1.65).stress == doctest::Approx(-30).epsilon(1e-13));
  CHECK(point.probe(2.625).stress == doctest::Approx(-15).epsilon(1e-13));
  CHECK(point.probe(0.325).stress == doctest::Approx(-65).epsilon(1e-13));
  CHECK(point.probe(-1).stress == doctest::Approx(-100).epsilon(1e-13));
}

TEST_CASE("damage of Hysteretic moves the target out, and beta softens its unloading") {
  Hysteretic law = simple();
  law.damage1 = 0.1;
  law.beta = 0.5;
  Point point(law);
  point.move(5);
  CHECK(point.move(4.9).tangent == doctest::Approx(100 / std::sqrt(5)).epsilon(1e-14));
  point.move(-5);
  point.move(-4.9);
  // ductility 5 of the side left: the target at 5 (1 + 0.1 (5 - 1)) = 7, where the backbone has 160
  const double zero = -5 + 140 * std::sqrt(5) / 100;
  CHECK(point.probe(0.5 * (zero + 7)).stress == doctest::Approx(80).epsilon(1e-13));
  // damage by energy: W over what both backbones enclose
  Hysteretic by_energy = simple();
  by_energy.damage2 = 0.5;
  Point other(by_energy);
  double W = 0, strain = 0, stress = 0;
  for (const double next : {1.0, 5.0, 3.6, -1.0, -5.0}) {  // corners of the path: the trapezoidal rule is exact
    const double s = other.move(next).stress;
    W += 0.5 * (s + stress) * (next - strain);
    strain = next;
    stress = s;
  }
  const double enclosed = 2 * (50 + 1500 + 1900);
  const double target = 5 * (1 + 0.5 * (W - 0.5 * 140 * 140 / 100) / enclosed);
  other.move(-4.9);
  CHECK(other.probe(0.5 * (-3.6 + target)).stress == doctest::Approx(0.5 * (90 + 10 * target)).epsilon(1e-13));
}

TEST_CASE("Hysteretic is elastic inside its first points, whatever the pinching") {
  CHECK(rc::check([] {
    Hysteretic law = simple();
    law.pinchX = 0.5;
    law.pinchY = 0.3;
    law.damage1 = law.damage2 = 0.1;
    Point point(law);
    for (const int i : *rc::gen::container<std::vector<int>>(30, rc::gen::inRange(-99, 100)))
      RC_ASSERT(std::abs(point.move(0.01 * i).stress - i) < 256 * epsilon * 100);
  }));
}

TEST_CASE("a side of Hysteretic driven beyond all strength reloads from where the strength ends") {
  Hysteretic law = simple();
  law.s3n = 0;
  Point point(law);
  CHECK(point.move(-30).stress == 0);
  CHECK(point.probe(-22).stress == 0);
  // from -21 to the target (1, 100)
  CHECK(point.probe(-10).stress == doctest::Approx(50).epsilon(1e-13));
}

TEST_CASE("backbones of Hysteretic that turn back are refused by name") {
  Hysteretic law = simple();
  law.e2p = 0.5;
  CHECK(fault_of(law).starts_with("e2p"));
  law = simple();
  law.s1n = 100;
  CHECK(fault_of(law).starts_with("s1n"));
  law = simple();
  law.e3n = std::nullopt;
  CHECK(fault_of(law).starts_with("s3n"));
  law = simple();
  law.pinchX = 1.5;
  CHECK(fault_of(law).starts_with("pinchX"));
}
