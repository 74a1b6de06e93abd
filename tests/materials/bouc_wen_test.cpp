// BoucWen: OpenSees histories, the differential equation by an independent integration, limits.
#include <doctest/doctest.h>

#include "tests/materials/opensees_histories.hpp"

using namespace nsframe;
using namespace nsframe::test;

namespace {

const BoucWen plain{0.1, 1e3, 1.5, 20, 30};
const BoucWen degrading{0.1, 1e3, 1.5, 20, 30, 1, 2e-3, 4e-3, 3e-3};

// z and w at the end of a path, by the classical Runge-Kutta method in steps of 1e-4.
double integrate(const BoucWen& law, const std::vector<double>& turns) {
  double z = 0, w = 0, strain = 0;
  const auto rate = [&law](double z_, double w_, double way) {
    const double opposing = law.gamma + law.beta * (z_ * way >= 0 ? 1 : -1);
    const double A = law.Ao - law.deltaA * w_, nu = 1 + law.deltaNu * w_, eta = 1 + law.deltaEta * w_;
    return (A - std::pow(std::abs(z_), law.n) * opposing * nu) / eta;
  };
  const auto power = [&law](double z_) { return (1 - law.alpha) * law.ko * z_; };
  for (const double turn : turns) {
    const double way = turn > strain ? 1 : -1;
    const int steps = static_cast<int>(std::ceil(std::abs(turn - strain) / 1e-4));
    const double d = (turn - strain) / steps;
    for (int i = 0; i < steps; ++i) {
      const double z1 = rate(z, w, way), w1 = power(z);
      const double z2 = rate(z + d / 2 * z1, w + d / 2 * w1, way), w2 = power(z + d / 2 * z1);
      const double z3 = rate(z + d / 2 * z2, w + d / 2 * w2, way), w3 = power(z + d / 2 * z2);
      const double z4 = rate(z + d * z3, w + d * w3, way), w4 = power(z + d * z3);
      z += d / 6 * (z1 + 2 * z2 + 2 * z3 + z4);
      w += d / 6 * (w1 + 2 * w2 + 2 * w3 + w4);
    }
    strain = turn;
  }
  return law.alpha * law.ko * strain + (1 - law.alpha) * law.ko * z;
}

double stress_in_steps(const BoucWen& law, const std::vector<double>& turns, double step) {
  Point point(law);
  double strain = 0, stress = 0;
  for (const double turn : turns) {
    const int steps = static_cast<int>(std::round(std::abs(turn - strain) / step));
    for (int i = 1; i <= steps; ++i) stress = point.move(strain + (turn - strain) * i / steps).stress;
    strain = turn;
  }
  return stress;
}

}  // namespace

TEST_CASE("BoucWen follows OpenSees in stress and tangent") {
  const std::vector<ReferenceHistory> histories = read_histories(BoucWen::name);
  REQUIRE(histories.size() == 6);
  for (const ReferenceHistory& history : histories) {
    CAPTURE(&history - histories.data());
    const BoucWen law =
        law_of<BoucWen>(history.parameters);  // the last two numbers are OpenSees' tolerance and iterations
    CHECK(fault_of(law) == "");
    const Difference worst = difference_to(history, law);
    CHECK(worst.stress < 1e-9);
    CHECK(worst.tangent < 1e-9);
  }
}

TEST_CASE("BoucWen converges to its differential equation by first order") {
  const std::vector<double> turns{0.3, -0.2, 0.5, -0.6, 0.1};
  for (const BoucWen& law : {plain, degrading}) {
    const double exact = integrate(law, turns);
    const double coarse = stress_in_steps(law, turns, 1e-3) - exact, fine = stress_in_steps(law, turns, 5e-4) - exact;
    CHECK(std::abs(coarse) < 0.02 * std::abs(exact));
    CHECK(coarse / fine == doctest::Approx(2).epsilon(0.05));  // second-order rest
  }
}

TEST_CASE("the hysteretic part of BoucWen ends at its limit in a step of any size") {
  const double limit = std::pow(1 / 50.0, 1 / 1.5);  // (Ao/(beta + gamma))^(1/n)
  for (const double strain : {10.0, -1e3, 1e6}) {
    const double z = (Point(plain).probe(strain).stress - 100 * strain) / 900;
    CHECK(std::abs(z) == doctest::Approx(limit).epsilon(strain == 10 ? 0.01 : 1e-3));
  }
  // and a whole reversal in one step
  Point point(plain);
  point.move(10);
  CHECK((point.probe(-1e3).stress + 1e5) / 900 == doctest::Approx(-limit).epsilon(1e-3));
}

TEST_CASE("BoucWen starts on its initial tangent, with Ao") {
  BoucWen law = plain;
  law.Ao = 0.5;
  CHECK(initial_tangent(law) == doctest::Approx(100 + 900 * 0.5));
  CHECK(Point(law).probe(0).tangent == doctest::Approx(550).epsilon(1e-14));
}

TEST_CASE("Bouc-Wen loops that would gain stiffness without bound are refused by name") {
  CHECK(fault_of(BoucWen{0.1, 1e3, 1.5, 20, -1}).starts_with("beta"));
  CHECK(fault_of(BoucWen{0.1, 1e3, 1.5, -31, 30}).starts_with("gamma"));
  CHECK(fault_of(BoucWen{0.1, 1e3, 0.5, 20, 30}).starts_with("n "));
}
