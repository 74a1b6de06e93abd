// The part of a step's change of velocity that impacts make, as observers get it.
#include <doctest/doctest.h>


#include "tests/integrators/oscillators.hpp"
#include "tests/support/numbers.hpp"

using namespace nsframe;
using namespace nsframe::test;

namespace {

struct Step {
  State before, after;
  StepReport report;
  std::vector<Impact> impacts;
};

class StepRecorder : public Observer {
 public:
  std::vector<Step> steps;
  void impact(const Impact& impact) override { impacts_.push_back(impact); }
  void step(const State& before, const State& after, const StepReport& report, const Energy&) override {
    steps.push_back({before, after, report, impacts_});
    impacts_.clear();
  }

 private:
  std::vector<Impact> impacts_;
};

std::vector<Step> steps_of(const ModelDescription& description, const AnalysisOptions& options) {
  const Model model = build(description);
  Simulation simulation(model, options);
  StepRecorder recorder;
  REQUIRE(simulation.run({&recorder}).completed);
  return recorder.steps;
}

}  // namespace

TEST_CASE("a free mass that hits a wall under gravity jumps by its impulse over its mass, within the step") {
  for (const double theta : {0.5, 0.75, 1.0}) {
    ModelDescription d = single_mass(2, 0, 1.5);
    d.structures[0].may_move_freely = true;
    d.gravity = {Vector3(3, 0, 0), false};
    d.contacts = {wall("s.1", 0.1, 0.4)};
    const double h = 1e-3;
    int jumps = 0;
    for (const Step& step : steps_of(d, options(theta, h, 0.12))) {
      REQUIRE(step.report.jumps.size() == step.impacts.size());
      if (step.impacts.empty()) continue;
      ++jumps;
      const VelocityJump& jump = step.report.jumps[0];
      CHECK(jump.change[0] == doctest::Approx(-step.impacts[0].impulse / 2).epsilon(8 * epsilon));
      CHECK(jump.time == doctest::Approx(step.before.time + (1 - theta) * h).epsilon(8 * epsilon));
      // what is left is the fall: 3 m/s2
      CHECK(step.after.velocity[0] - step.before.velocity[0] - jump.change[0] == doctest::Approx(3 * h).epsilon(1e3 * epsilon));
    }
    CHECK(jumps == 1);
  }
}

TEST_CASE("the jump of a frame in pounding does on the pair what the impulse did, and no jump is told without an impact") {
  ModelDescription d = linear_oscillator(4600, 2.11e6, 0.005, -0.024);
  d.structures.push_back(linear_oscillator(3500, 5.31e6, 0.005).structures[0]);
  d.structures[1].name = "r";
  ContactDescription c = wall("s.1", 0.02, 0.6);
  c.b = Reference{"r.1", {}};
  d.contacts = {c};
  const double h = 1e-3, theta = 0.5;
  // M + h theta C + h^2 theta^2 K of each mass
  const auto J = [&](double m, double k) { return m + h * theta * 2 * 0.005 * std::sqrt(k * m) + h * h * theta * theta * k; };
  int jumps = 0;
  for (const Step& step : steps_of(d, options(theta, h, 1))) {
    CHECK(step.report.jumps.size() == step.impacts.size());
    if (step.impacts.empty()) continue;
    ++jumps;
    const VectorX& change = step.report.jumps[0].change;
    CHECK(change[0] == doctest::Approx(-step.impacts[0].impulse / J(4600, 2.11e6)).epsilon(64 * epsilon));
    CHECK(change[1] == doctest::Approx(step.impacts[0].impulse / J(3500, 5.31e6)).epsilon(64 * epsilon));
  }
  CHECK(jumps == 3);
}

TEST_CASE("jumps of halved steps are told in the order of time, each with its part of the impulse") {
  AnalysisOptions o = options(0.5, 0.01, 0.3);
  o.algorithm = {"newton"};
  o.max_newton = 1;  // so that yielding steps are halved
  o.newton_tolerance = 1e-3;
  ModelDescription d = nonlinear_oscillator(100, Steel02{1e4, 1e6, 0.01}, 0, 4);
  int halved_with_impact = 0;
  for (const double gap : {0.01, 0.02, 0.03, 0.04, 0.05, 0.06}) {
    d.contacts = {wall("s.1", gap, 0.6)};
    for (const Step& step : steps_of(d, o)) {
      for (std::size_t i = 0; i < step.report.jumps.size(); ++i) {
        const VelocityJump& jump = step.report.jumps[i];
        CHECK(jump.time >= step.before.time);
        CHECK(jump.time <= step.after.time);
        if (i > 0) CHECK(jump.time > step.report.jumps[i - 1].time);
      }
      halved_with_impact += step.report.substeps > 1 && !step.report.jumps.empty();
      double impulse = 0;
      for (const Impact& impact : step.impacts) impulse += impact.impulse;
      CHECK(impulse == doctest::Approx(step.after.impulse[0]).epsilon(8 * epsilon));
    }
  }
  CHECK(halved_with_impact > 0);
}
