// The paper's pull-back test (Table 3, k and m as printed): structure 1 released from -2.4 cm, gap 2 cm, e = 0.6.
// The reference is an event-driven closed-form solution computed here; hard-case figures by the same numbers.
#include <doctest/doctest.h>

#include "integrators/simulation.hpp"
#include "tests/verification/closed_forms.hpp"
#include "tests/verification/pair_of_masses.hpp"

using namespace nsframe;
using namespace nsframe::test;

namespace {

struct PullBackRun {
  double error;  // largest displacement error of both masses [m]
  std::size_t impacts;
};

PullBackRun pull_back(double theta, double gamma, double dt) {
  ModelDescription d;
  d.structures = {oscillator(0, {4600, 2.11e6, 0.005, -0.024}), oscillator(1, {3500, 5.31e6, 0.005})};
  d.contacts = {contact_of(0, 1, 0.02, 0.6)};
  Diagnostics diagnostics;
  const Model model = build_model(d, diagnostics);
  AnalysisOptions options;
  options.scheme = "moreau-jean";
  options.dt = dt;
  options.theta = theta;
  options.gamma = gamma;
  options.duration = 2;
  Simulation simulation(model, options);
  Recorder recorder;
  const Summary summary = simulation.run({&recorder});
  double error = 0;
  for (const State& state : recorder.states) {
    const std::array<double, 2> exact = pull_back_exact(state.time);
    for (int i = 0; i < 2; ++i) error = std::max(error, std::abs(state.displacement[i] - exact[static_cast<std::size_t>(i)]));
  }
  return {error, summary.impacts.size()};
}

void check(double theta, double gamma, double dt, double error, std::size_t impacts) {
  CAPTURE(theta);
  CAPTURE(gamma);
  CAPTURE(dt);
  const PullBackRun run = pull_back(theta, gamma, dt);
  CHECK(run.error == doctest::Approx(error).epsilon(0.05));
  CHECK(run.impacts == impacts);
}

}  // namespace

TEST_CASE("the pull-back's exact impacts are those of the hard-case table") {
  const auto impacts = pull_back_impacts();
  REQUIRE(impacts.size() == 3);
  CHECK(impacts[0].time == doctest::Approx(0.12050131156430804).epsilon(1e-12));
  CHECK(impacts[1].time == doctest::Approx(0.38924251683069677).epsilon(1e-12));
  CHECK(impacts[2].time == doctest::Approx(0.6722824563756127).epsilon(1e-12));
  CHECK(impacts[0].rate == doctest::Approx(-0.26989424).epsilon(1e-7));
}

TEST_CASE("Moreau-Jean with theta = 1 misses impacts of the pull-back at the steps it is known to miss them") {
  check(1.0, 0.5, 1e-2, 1.6e-2, 0);
  check(1.0, 0.5, 5e-3, 1.8e-2, 1);
  check(1.0, 0.5, 1e-3, 1.28e-2, 2);
  check(1.0, 0.5, 1e-4, 1.27e-3, 3);
  check(1.0, 1.5, 1e-2, 1.62e-2, 0);
  check(1.0, 1.5, 5e-3, 1.64e-2, 1);
  check(1.0, 1.5, 1e-3, 1.20e-2, 2);
  check(1.0, 1.5, 1e-4, 1.18e-3, 3);
}

TEST_CASE("Moreau-Jean with theta = 1/2 finds the pull-back's three impacts with the known errors") {
  check(0.5, 0.5, 1e-2, 7.4e-3, 3);
  check(0.5, 0.5, 5e-3, 3.0e-3, 3);
  check(0.5, 0.5, 1e-3, 8.0e-4, 3);
  check(0.5, 0.5, 1e-4, 6.4e-5, 3);
  check(0.5, 1.5, 1e-2, 4.63e-3, 3);
  check(0.5, 1.5, 5e-3, 3.63e-3, 3);
  check(0.5, 1.5, 1e-3, 3.48e-4, 3);
  check(0.5, 1.5, 1e-4, 4.42e-5, 3);
  check(0.5, 1.0, 1e-3, 2.0e-4, 3);
}
