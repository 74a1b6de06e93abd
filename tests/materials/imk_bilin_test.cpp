// IMKBilin: OpenSees histories, backbone, deterioration by hand, failure.
#include <doctest/doctest.h>

#include "tests/materials/opensees_histories.hpp"

using namespace nsframe;
using namespace nsframe::test;

namespace {

// Yields at (1, 100), cap at (6, 120), residual strength 20 from 6 + 100/12 on, fails at 30.
IMKBilin simple(double lamda) { return {100, 5, 10, 30, 100, 1.2, 0.2, 5, 10, 30, 100, 1.2, 0.2, lamda, lamda, lamda}; }

}  // namespace

TEST_CASE("IMKBilin follows OpenSees in stress") {
  const std::vector<ReferenceHistory> histories = read_histories(IMKBilin::name);
  REQUIRE(histories.size() == 9);
  int failed = 0;
  for (const ReferenceHistory& history : histories) {
    CAPTURE(&history - histories.data());
    const IMKBilin law = law_of<IMKBilin>(history.parameters);
    CHECK(fault_of(law) == "");
    // OpenSees' tangent is the secant of the step; ours is the derivative
    CHECK(difference_to(history, law).stress < 1e-9);
    if (history.rows.back()[1] == 0) ++failed;
  }
  CHECK(failed > 0);
  CHECK(failed < 9);
}

TEST_CASE("the first loading of IMKBilin follows its backbone to failure") {
  for (const auto& [strain, stress] :
       {std::pair{0.5, 50.0}, {3.0, 108.0}, {6.0, 120.0}, {10.0, 72.0}, {20.0, 20.0}, {30.0, 0.0}}) {
    CHECK(Point(simple(0)).probe(strain).stress == doctest::Approx(stress).epsilon(16 * epsilon));
    CHECK(Point(simple(0)).probe(-strain).stress == doctest::Approx(-stress).epsilon(16 * epsilon));
  }
  for (const auto& [strain, tangent] : {std::pair{0.5, 100.0}, {3.0, 4.0}, {10.0, -12.0}, {20.0, 0.0}})
    CHECK(Point(simple(0)).probe(strain).tangent == doctest::Approx(tangent).epsilon(16 * epsilon));
}

TEST_CASE("dissipated energy takes stiffness at a reversal and strength where the force changes sign") {
  const double capacity = 10 * 100;
  Point point(simple(10));
  point.move(1);
  CHECK(point.move(3).stress == doctest::Approx(108).epsilon(1e-14));
  double W = 50 + 2 * 104;
  const double dissipated = W - 0.5 * 108 * 108 / 100;
  const double K = 100 * (1 - dissipated / (capacity - dissipated));
  CHECK(point.move(1.6).tangent == doctest::Approx(K).epsilon(1e-14));
  const double before = 108 - 1.4 * K;
  CHECK(before > 0);
  W -= 0.5 * (108 + before) * 1.4;
  // the energy of the excursion counts up to the last committed state before the change of sign
  const double left = 1 - W / (capacity - W);
  const double Fy = 100 * left, Kp = 4 * left, Kpc = 12 * (Fy - 20) / 80;
  const double hardening = Fy - Kp * Fy / 100, softening = 192 * left, cap = (softening - hardening) / (Kp + Kpc);
  CHECK(point.probe(-1.5).stress == doctest::Approx(-hardening - Kp * 1.5).epsilon(1e-13));
  CHECK(cap < 8);
  CHECK(point.probe(-8).stress == doctest::Approx(-softening + Kpc * 8).epsilon(1e-13));
  CHECK(point.probe(-8).tangent == doctest::Approx(-Kpc).epsilon(1e-13));
}

TEST_CASE("IMKBilin without deterioration is bilinear hysteresis") {
  Point point(simple(0));
  point.move(3);
  point.move(-3);
  CHECK(point.probe(-1).stress == doctest::Approx(-108 + 200).epsilon(1e-14));
  CHECK(point.probe(3).stress == doctest::Approx(108).epsilon(1e-14));
}

TEST_CASE("a component that has used its energy collapses for good") {
  Point point(simple(2));
  point.move(1);
  point.move(3);  // 199.7 of 200
  CHECK(point.move(2.9).stress == 0);
  for (const double strain : {5.0, -5.0, 0.5, 0.0}) {
    CHECK(point.move(strain).stress == 0);
    CHECK(point.probe(strain).tangent == 0);
  }
}

TEST_CASE("a side that failed leaves the other one its residual strength") {
  Point point(simple(0));
  CHECK(point.move(30).stress == 0);
  CHECK(point.move(31).stress == 0);
  CHECK(point.move(30.9).tangent == doctest::Approx(50));  // half of Ke from there on
  CHECK(point.move(20).stress == doctest::Approx(-20).epsilon(1e-14));
  CHECK(point.move(-29).stress == doctest::Approx(-20).epsilon(1e-14));
  CHECK(point.move(-30).stress == 0);
  CHECK(point.move(0).stress == 0);
}

TEST_CASE("IMKBilin is elastic before it yields, whatever the cycles") {
  CHECK(rc::check([] {
    Point point(simple(0.5));
    for (const int i : *rc::gen::container<std::vector<int>>(30, rc::gen::inRange(-99, 100)))
      RC_ASSERT(std::abs(point.move(0.01 * i).stress - i) < 256 * epsilon * 100);
  }));
}

TEST_CASE("parameters of IMKBilin outside their range are refused by name") {
  IMKBilin law = simple(1);
  law.FresFy_neg = 1;
  CHECK(fault_of(law).starts_with("FresFy_neg"));
  law = simple(-1);
  CHECK(fault_of(law).starts_with("Lamda_S"));
  law = simple(1);
  law.FmaxFy_pos = 0.9;
  CHECK(fault_of(law).starts_with("FmaxFy_pos"));
}
