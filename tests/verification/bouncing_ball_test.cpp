// The paper's bouncing ball: m = 1 kg, dropped from 1 m under 2 m/s2, e = 0.5; impacts at 1, 2, 2.5, ... until 3 s.
#include <doctest/doctest.h>

#include "integrators/simulation.hpp"
#include "tests/verification/closed_forms.hpp"
#include "tests/verification/pair_of_masses.hpp"

using namespace nsframe;
using namespace nsframe::test;

namespace {

double largest_error(double theta, double gamma, double dt) {
  ModelDescription d;
  StructureDescription ball = oscillator(0, {1, 0, 0});
  d.structures = {ball};
  d.contacts = {contact_of(0, -1, 1.0, 0.5)};
  d.gravity = {Vector3(2, 0, 0), false};  // towards the wall, which the node meets along +x
  Diagnostics diagnostics;
  const Model model = build_model(d, diagnostics);
  AnalysisOptions options;
  options.scheme = "moreau-jean";
  options.theta = theta;
  options.gamma = gamma;
  options.dt = dt;
  options.duration = 3.5;
  Simulation simulation(model, options);
  Recorder recorder;
  simulation.run({&recorder});
  double error = 0;
  for (const State& state : recorder.states) error = std::max(error, std::abs(1 - state.displacement[0] - bouncing_ball_height(state.time)));
  return error;
}

}  // namespace

TEST_CASE("the bouncing ball's largest position error is 1.5 and 2.0 mm at 1 ms, a tenth of it at 0.1 ms") {
  CHECK(largest_error(0.5, 1.5, 1e-3) == doctest::Approx(1.5e-3).epsilon(0.05));
  CHECK(largest_error(0.5, 1.5, 1e-4) == doctest::Approx(1.5e-4).epsilon(0.05));
  CHECK(largest_error(1.0, 1.5, 1e-3) == doctest::Approx(2.0e-3).epsilon(0.05));
  CHECK(largest_error(1.0, 0.5, 1e-3) == doctest::Approx(1.0e-3).epsilon(0.05));
}

TEST_CASE("Moreau-Jean is first order across impacts: the ball's error over four step sizes") {
  for (const double theta : {0.5, 1.0}) {
    const double coarse = largest_error(theta, 1.5, 2e-3), fine = largest_error(theta, 1.5, 2.5e-4);
    CHECK(largest_error(theta, 1.5, 1e-3) < coarse);
    CHECK(fine < largest_error(theta, 1.5, 5e-4));
    const double order = std::log(coarse / fine) / std::log(8.0);
    CHECK(order > 0.9);
    CHECK(order < 1.1);
  }
}
