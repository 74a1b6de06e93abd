// Parts of a step of the scheme event-split with members far from what they are at rest, and the damping of what parts do not resolve.
#include <doctest/doctest.h>

#include <cmath>

#include "integrators/part_flow.hpp"
#include "tests/integrators/oscillators.hpp"
#include "tests/integrators/runs.hpp"
#include "tests/verification/pair_of_masses.hpp"

using namespace nsframe;
using namespace nsframe::test;

namespace {

// A second spring from node 1 of a structure to the ground.
void hold_by(ModelDescription& d, std::size_t structure, const std::string& material) {
  SpringDescription spring = ground_spring("second", "1", Vector6::Zero());
  spring.law[0] = Reference{material, {}};
  d.structures[structure].springs.push_back(spring);
}

// Masses of 1000 and 700 kg that yield without hardening, and stay together after a plastic impact while both yield.
ModelDescription perfectly_plastic_pair() {
  ModelDescription d = yielding_masses(ElasticPP{2e6, 4e-3});
  d.contacts[0].restitution = 0;
  return d;
}

// A mass between a wall and a cable that carries tension only, twenty times as stiff as its spring.
ModelDescription mass_on_cable() {
  ModelDescription d = nonlinear_oscillator(1000, Steel01{1e9, 5e5, 0.01}, 0, 1);
  d.materials.push_back({"cable", {}, ElasticPPGap{1e7, -1e12, -0.002}});
  hold_by(d, 0, "cable");
  d.contacts = {wall("s.1", 0.01, 0.6)};
  return d;
}

// A mass pushes another one, without rebound, into a stop that yields at 4 mm.
ModelDescription mass_against_stop(double stiffness) {
  ModelDescription d = yielding_masses(Steel01{1e9, 1e6, 0.01});
  d.contacts[0].restitution = 0;
  d.materials.push_back({"stop", {}, ElasticPPGap{stiffness, 0.004 * stiffness, 0.005, 0.1}});
  hold_by(d, 1, "stop");
  return d;
}

// Of the logarithms of errors at steps each half the last, by least squares.
double order_of(const std::vector<double>& errors) {
  double sum = 0, squares = 0;
  const double middle = 0.5 * static_cast<double>(errors.size() - 1);
  for (std::size_t i = 0; i < errors.size(); ++i) {
    const double x = static_cast<double>(i) - middle;
    sum -= x * std::log2(errors[i]);
    squares += x * x;
  }
  return sum / squares;
}

}  // namespace

TEST_CASE("event-split: second order across impacts with members that yield, tighten or meet a stop in contact") {
  const auto check_order = [](const ModelDescription& d, double dt, const char* reference) {
    const double duration = 0.4;
    const Run fine = completed(d, by_scheme(reference, dt / 128, duration));
    REQUIRE_FALSE(fine.summary.impacts.empty());
    std::vector<double> errors;
    for (const int parts : {1, 2, 4, 8, 16}) {
      const Run ours = completed(d, by_scheme("event-split", dt / parts, duration));
      errors.push_back(difference(ours, fine));
      CHECK(ours.summary.max_penetration < 1e-12);
      CHECK(ours.summary.halved_steps == 0);
      CHECK(ours.summary.evaluations < 2 * ours.summary.steps);
    }
    CAPTURE(errors.front());
    CAPTURE(errors.back());
    CHECK(errors.front() < 1e-3);
    CHECK(order_of(errors) > 1.8);
  };
  check_order(perfectly_plastic_pair(), 8e-4, "event-split");
  check_order(perfectly_plastic_pair(), 8e-4, "exponential");
  check_order(mass_on_cable(), 8e-4, "event-split");
  check_order(mass_against_stop(6e7), 8e-4, "event-split");
}

TEST_CASE("event-split: a stop that closes in contact, far stiffer than parts resolve, gives back no more energy than it took") {
  // h^2 k / (4 m) = 56: without iterations a part would throw the masses back at fifty times their speed
  for (const char* integrator : {"theta", "generalized-alpha", "alpha-os"}) {
    CAPTURE(integrator);
    AnalysisOptions o = by_scheme("event-split", 8e-4, 0.4);
    o.integrator = integrator;
    const Run hit = completed(mass_against_stop(6e11), o);
    double fastest = 0;
    for (const State& state : hit.states) fastest = std::max(fastest, state.velocity.cwiseAbs().maxCoeff());
    CHECK(fastest < 1.5 * (1 + 1e-9));
    CHECK(hit.summary.max_penetration < 1e-9);
    CHECK(hit.summary.factorizations > 2);
    CHECK(hit.summary.energy.numerical > -1e-9 * 1125);  // of the energy at the start [J]
    CHECK(hit.summary.energy.numerical < 0.02 * 1125);
  }
}

TEST_CASE("event-split: a part of any length moves a mode as (350) tells, never grows it, and leaves rho_infinity of what it does not resolve") {
  const Model model = build(row({{1, 1, 0}}));
  Simulation simulation(model, by_scheme("event-split", 1e-3, 1));
  System& system = simulation.system();
  const double h = 1e-2;
  for (const double rho : {1.0, 0.8, 0.5, 0.0}) {
    for (const double z : {1e-3, 0.3, 2.0, 30.0, 1e5}) {
      const double w = z / h;
      IterationMatrix matrix(system);
      const SparseMatrix K = (w * w) * system.initial_stiffness;
      matrix.factor(system, K, 0.5 * h);
      PartFlow flow({0.5, rho}, matrix);
      flow.set_longest(h);
      flow.held().hold(system.contacts(), {});
      for (const double f : {0.01, 0.3, 0.6, 0.9, 1.0}) {
        MatrixX step(2, 2);  // of (w q, v)
        for (Eigen::Index j = 0; j < 2; ++j) {
          const VectorX q = VectorX::Constant(1, j == 0 ? 1 / w : 0), v = VectorX::Constant(1, j == 1 ? 1 : 0);
          flow.begin(system, v, VectorX(K * q), {VectorX::Zero(1), {}}, {false});
          VectorX end;
          flow.velocity(f * h, end);
          step(0, j) = w * (q[0] + f * h * flow.mean_velocity(f * h)[0]);
          step(1, j) = end[0];
        }
        const double y = 0.25 * z * z / (1 + 0.25 * z * z), g = 1 - f * f, gamma = 1 - 0.5 * (3 - rho) * f * f;
        const double c = 1 - 2 * f * f * y * (1 + gamma * y), sigma = 2 * f * std::sqrt(y * (1 - y)) * (1 + gamma * y);
        MatrixX told(2, 2);
        told << c, sigma, -sigma, c;
        CAPTURE(rho);
        CAPTURE(z);
        CAPTURE(f);
        CHECK((step - told).cwiseAbs().maxCoeff() < 1e-9);
        const double left = 1 - 4 * f * f * y * y * (1 + gamma * y) * (0.5 * (1 - rho) * f * f * (1 - g * y) + g * g * y);
        CHECK(std::abs(c * c + sigma * sigma - left) < 1e-12);
        CHECK(left < 1 + 1e-14);
        if (f == 1 && z > 1e4) CHECK(std::sqrt(c * c + sigma * sigma) == doctest::Approx(rho).epsilon(1e-4).scale(1));
      }
    }
  }
}
