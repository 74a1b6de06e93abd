// Rate-dependent laws on their own: closed forms of Viscous and ViscousDamper.
#include <doctest/doctest.h>

#include <cmath>

#include "base/types.hpp"
#include "tests/materials/point.hpp"

using namespace nsframe;
using namespace nsframe::test;

namespace {

// A material point that is led through time.
class MovingPoint {
 public:
  MovingPoint(UniaxialLaw law, double theta) : law_(std::move(law)), theta_(theta), committed_(static_cast<std::size_t>(history_size(law_))), trial_(committed_.size()) {
    initialize_history(law_, committed_.data());
  }
  RatePoint probe(double strain, double h) { return respond_rate(law_, strain, committed_.data(), trial_.data(), {h, theta_}); }
  RatePoint move(double strain, double h) {
    const RatePoint point = probe(strain, h);
    committed_.swap(trial_);
    dissipated += point.energy.dissipated;
    stored += point.energy.stored;
    return point;
  }
  double stress() const { return rate_stress(law_, committed_.data()); }
  UniaxialPoint rest(double strain) {
    const UniaxialPoint point = respond(law_, strain, committed_.data(), trial_.data());
    committed_.swap(trial_);
    return point;
  }
  double dissipated = 0, stored = 0;

 private:
  UniaxialLaw law_;
  double theta_;
  std::vector<double> committed_, trial_;
};

// Energy that a law dissipates in the last of `cycles` cycles of A sin(w t).
double cycle_energy(const UniaxialLaw& law, double A, double w, int steps, int cycles) {
  MovingPoint point(law, 0.5);
  const double h = 2 * pi / w / steps;
  double before = 0;
  for (int i = 1; i <= cycles * steps; ++i) {
    if (i == (cycles - 1) * steps + 1) before = point.dissipated;
    point.move(A * std::sin(w * h * i), h);
  }
  return point.dissipated - before;
}

}  // namespace

TEST_CASE("a dashpot dissipates in a cycle what its power law says") {
  const double C = 3e5, A = 0.02, w = 7;
  for (const double alpha : {0.3, 0.5, 1.0, 1.7}) {
    CAPTURE(alpha);
    // work of C |v|^alpha over A sin(w t): C A^(1+a) w^a times the integral of |cos|^(1+a)
    const double shape = 2 * std::sqrt(pi) * std::tgamma(1 + alpha / 2) / std::tgamma(1.5 + alpha / 2);
    const double expected = C * std::pow(A, 1 + alpha) * std::pow(w, alpha) * shape;
    // mean rates of 2000 steps a cycle: second order
    CHECK(cycle_energy(Viscous{C, alpha}, A, w, 2000, 2) == doctest::Approx(expected).epsilon(1e-5));
  }
}

TEST_CASE("a linear Maxwell damper loses in a cycle what its loss modulus says, whatever the ratio of periods") {
  const double K = 4e6, A = 0.01, w = 5;
  for (const double ratio : {0.05, 1.0, 20.0}) {  // w C/K
    CAPTURE(ratio);
    const ViscousDamper law{K, ratio * K / w, 1};
    const double expected = pi * A * A * K * ratio / (1 + ratio * ratio);
    const int cycles = 2 + static_cast<int>(4 * ratio);  // the start decays by exp(-2 pi/ratio) a cycle
    CHECK(cycle_energy(law, A, w, 2000, cycles) == doctest::Approx(expected).epsilon(1e-5));
  }
}

TEST_CASE("a Maxwell damper relaxes exponentially, or by its power") {
  const double K = 2e6, C = 1e5, strain = 0.01, T = 0.08;
  const double start = K * strain;  // of a sudden elongation
  for (const double alpha : {0.35, 1.0, 1.6}) {
    CAPTURE(alpha);
    for (const double theta : {0.5, 1.0}) {
      CAPTURE(theta);
      const int steps = 4000;
      MovingPoint point(ViscousDamper{K, C, alpha}, theta);
      point.move(strain, 1e-12);
      CHECK(point.stress() == doctest::Approx(start).epsilon(1e-6));
      for (int i = 0; i < steps; ++i) point.move(strain, T / steps);
      // dF/dt = -K (F/C)^(1/alpha)
      const double p = 1 / alpha, m = p - 1;
      const double expected =
          alpha == 1 ? start * std::exp(-K / C * T)
                     : std::pow(std::max(0.0, std::pow(start, -m) + m * K * std::pow(C, -p) * T), -1 / m);
      // at theta = 1 of first order: h K/C/2 of the decay
      CHECK(point.stress() == doctest::Approx(expected).epsilon(theta == 1 ? 2e-3 : 1e-5));
      CHECK(point.dissipated + point.stored == doctest::Approx(0.5 * K * strain * strain).epsilon(theta == 1 ? 1e-3 : 1e-5));
    }
  }
}

TEST_CASE("a Maxwell damper with a stiff spring is its dashpot, with a viscous one its spring") {
  const double v = 0.3, h = 1e-3;
  MovingPoint stiff(ViscousDamper{1e12, 2e4, 0.4}, 1), dashpot(Viscous{2e4, 0.4}, 1), elastic(ViscousDamper{1e6, 1e15, 0.4}, 1);
  for (int i = 1; i <= 20; ++i) {
    const double force = dashpot.move(v * h * i, h).stress;
    CHECK(stiff.move(v * h * i, h).stress == doctest::Approx(force).epsilon(1e-4));  // C |v|^alpha/(K h v)
    CHECK(elastic.move(v * h * i, h).stress == doctest::Approx(1e6 * v * h * i).epsilon(1e-9));
  }
}

TEST_CASE("the tangent of rate-dependent laws is the derivative of the stress") {
  for (const UniaxialLaw& law : {UniaxialLaw(Viscous{2e5, 0.3}), UniaxialLaw(Viscous{2e5, 1}), UniaxialLaw(Viscous{2e5, 1.5}),
                                 UniaxialLaw(ViscousDamper{1e7, 2e5, 0.3}), UniaxialLaw(ViscousDamper{1e7, 2e5, 1}),
                                 UniaxialLaw(ViscousDamper{1e7, 2e5, 1.5}), UniaxialLaw(ViscousDamper{1e7, 2e5, 0.6, 1e-4})}) {
    for (const double theta : {0.5, 0.8, 1.0}) {
      MovingPoint point(law, theta);
      for (const double strain : {1e-4, 4e-4, -2e-4, -2.2e-4}) {
        const double h = 1e-3, d = 1e-10;
        const double slope = (point.probe(strain + d, h).stress - point.probe(strain - d, h).stress) / (2 * d);
        // differences of stresses of 1e5 over 2e-10
        CHECK(point.probe(strain, h).tangent == doctest::Approx(slope).epsilon(1e-5));
        point.move(strain, h);
      }
    }
  }
}

TEST_CASE("at rest rate-dependent laws have no stress, and start again from there") {
  for (const UniaxialLaw& law : {UniaxialLaw(Viscous{2e5, 0.3}), UniaxialLaw(ViscousDamper{1e7, 2e5, 0.3})}) {
    CHECK(is_rate_dependent(law));
    MovingPoint point(law, 1);
    point.move(1e-3, 1e-3);
    CHECK(point.stress() > 0);
    const UniaxialPoint rest = point.rest(5e-3);
    CHECK(rest.stress == 0);
    CHECK(rest.tangent == 0);
    CHECK(point.stress() == 0);
    CHECK(point.move(5e-3, 1e-3).stress == 0);
  }
  CHECK_FALSE(is_rate_dependent(Elastic{1}));
}

TEST_CASE("the stored energy of a Maxwell damper and what it dissipates are the work on it") {
  MovingPoint point(ViscousDamper{5e6, 3e5, 0.6}, 0.5);
  double work = 0, strain = 0;
  for (int i = 1; i <= 500; ++i) {
    const double next = 0.01 * std::sin(0.05 * i) + 0.003 * std::sin(0.31 * i);
    work += point.move(next, 2e-3).stress * (next - strain);
    strain = next;
  }
  CHECK(point.dissipated + point.stored == doctest::Approx(work).epsilon(1e-12));
  CHECK(point.stored == doctest::Approx(point.stress() * point.stress() / 2 / 5e6).epsilon(1e-9));
}

TEST_CASE("a damper with play in its pins carries nothing over the play after each change of sign") {
  const double play = 0.004, C = 2e4, v = 0.1, h = 1e-3;
  for (const double theta : {0.5, 0.8, 1.0}) {
    CAPTURE(theta);
    // a spring so stiff that the force is the dashpot's within a step or two
    MovingPoint point(ViscousDamper{1e9, C, 1, play}, theta);
    double u = 0;
    const auto go = [&](double rate, int steps) {
      double stress = 0;
      for (int i = 0; i < steps; ++i) stress = point.move(u += rate * h, h).stress;
      return stress;
    };
    CHECK(go(v, 100) == doctest::Approx(C * v).epsilon(1e-3));   // engaged from the start
    go(-v, 3);
    CHECK(go(-v, 35) == 0);                                      // 38 of the 40 steps that the play lasts
    go(-v, 10);
    CHECK(go(-v, 50) == doctest::Approx(-C * v).epsilon(1e-3));
    go(v, 3);
    CHECK(go(v, 15) == 0);                                       // into the play, and back before it closes
    CHECK(go(-v, 15) == 0);
    go(-v, 10);
    CHECK(go(-v, 20) == doctest::Approx(-C * v).epsilon(1e-3));
  }
}

TEST_CASE("the play of a damper neither stores nor takes energy, and a first motion either way finds the pins closed") {
  const double play = 0.002, A = 0.01, w = 6;
  const ViscousDamper law{4e6, 2e5, 0.5, play};
  for (const double sense : {1.0, -1.0}) {
    MovingPoint point(law, 0.5);
    double work = 0, before = 0;
    const double h = 5e-5;
    CHECK(sense * point.move(1e-6 * sense, h).stress > 0);
    before = 1e-6 * sense;
    for (int i = 1; i <= 40000; ++i) {
      const double strain = 1e-6 * sense + sense * A * std::sin(w * h * i);
      work += point.move(strain, h).stress * (strain - before);
      before = strain;
    }
    // steps of closing pins do some work more than the mean force on the damper's part of the step: first order
    CHECK(point.dissipated + point.stored == doctest::Approx(work + 0.5 * 4e6 * 1e-12).epsilon(1e-3));
  }
}
