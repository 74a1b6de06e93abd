// The projection of penetrations onto closed gaps: held contacts stay, bounces keep their figures, its energy is told.
#include <doctest/doctest.h>

#include <cmath>

#include "base/errors.hpp"
#include "tests/integrators/oscillators.hpp"
#include "tests/support/numbers.hpp"
#include "tests/verification/closed_forms.hpp"

using namespace nsframe;
using namespace nsframe::test;

namespace {

AnalysisOptions projected(double theta, double dt, double duration, bool on = true) {
  AnalysisOptions o = options(theta, dt, duration);
  o.projection = on;
  return o;
}

// The paper's ball, e = 0.5.
ModelDescription ball() {
  ModelDescription d = single_mass(1);
  d.structures[0].may_move_freely = true;
  d.gravity = {Vector3(2, 0, 0), false};
  d.contacts = {wall("s.1", 1, 0.5)};
  return d;
}

// Two masses pressed together by the load on the first, touching at the start.
ModelDescription pressed(double e) {
  ModelDescription d = linear_oscillator(4600, 2.11e6, 0.005);
  d.structures.push_back(linear_oscillator(3500, 5.31e6, 0.005).structures[0]);
  d.structures[1].name = "r";
  d.gravity = {Vector3(3, 0, 0), false};
  ContactDescription c = wall("s.1", 0, e);
  c.b = Reference{"r.1", {}};
  d.contacts = {c};
  return d;
}

double largest_penetration(const Run& run, double from, double open) {
  double most = 0;
  for (const State& state : run.states) {
    if (state.time < from) continue;
    const double second = state.displacement.size() > 1 ? state.displacement[1] : 0;
    most = std::max(most, state.displacement[0] - second - open);
  }
  return most;
}

}  // namespace

TEST_CASE("a contact that a load holds closed stays at gap 0 within 1e-12 m, and would creep without the projection") {
  for (const double theta : {0.5, 1.0}) {
    CAPTURE(theta);
    ModelDescription d = ball();
    d.contacts[0].gap = {0};
    const Run held = run(d, projected(theta, 1e-3, 2));
    CHECK(largest_penetration(held, 0, 0) < 1e-12);
    CHECK(std::abs(held.states.back().displacement[0]) < 1e-12);
    CHECK(std::abs(held.states.back().velocity[0]) < 1e-12);
    CHECK(largest_penetration(run(d, projected(theta, 1e-3, 2, false)), 0, 0) > 1e-7);
  }
}

TEST_CASE("two structures pressed together move as one at gap 0 while they press") {
  for (const double e : {0.0, 0.6}) {
    CAPTURE(e);
    const Run held = run(pressed(e), projected(0.5, 1e-3, 1)), crept = run(pressed(e), projected(0.5, 1e-3, 1, false));
    CHECK(largest_penetration(held, 0, 0) < 1e-12);
    CHECK(largest_penetration(crept, 0, 0) > 5e-10);
    CHECK(held.summary.worst_balance_error < 1e5 * epsilon);
    long carrying = 0;
    for (const State& state : held.states) carrying += state.impulse[0] > 0;
    CHECK(carrying > 100);
  }
}

TEST_CASE("the projected ball comes to rest on the floor at 3 s, with the position errors of the scheme on the way") {
  for (const double theta : {0.5, 1.0}) {
    CAPTURE(theta);
    const Run on = run(ball(), projected(theta, 1e-3, 3.5)), off = run(ball(), projected(theta, 1e-3, 3.5, false));
    const auto error = [](const Run& run) {
      double most = 0;
      for (const State& state : run.states) most = std::max(most, std::abs(1 - state.displacement[0] - bouncing_ball_height(state.time)));
      return most;
    };
    MESSAGE("ball, theta = ", theta, ": ", error(on), " m projected, ", error(off), " m not");
    CHECK(error(on) < 1.1 * error(off));
    CHECK(largest_penetration(on, 0, 1) < 1e-12);
    CHECK(largest_penetration(on, 3.1, 1) < 1e-12);
    CHECK(largest_penetration(off, 3.1, 1) > 1e-7);
    CHECK(on.summary.worst_balance_error < 1e5 * epsilon);
  }
}

TEST_CASE("the projection keeps the impacts of the pull-back, and its energy is that of the shifts") {
  ModelDescription d = linear_oscillator(4600, 2.11e6, 0, -0.024);
  d.structures[0].damping.kind = DampingKind::modal;
  d.structures[0].damping.ratios = {0.005};
  d.structures.push_back(linear_oscillator(3500, 5.31e6, 0).structures[0]);
  d.structures[1].name = "r";
  d.structures[1].damping = d.structures[0].damping;
  ContactDescription c = wall("s.1", 0.02, 0.6);
  c.b = Reference{"r.1", {}};
  d.contacts = {c};
  for (const bool on : {false, true}) {
    const Run result = run(d, projected(0.5, 1e-3, 2, on));
    double error = 0;
    for (const State& state : result.states) {
      const auto exact = pull_back_exact(state.time);
      for (int m = 0; m < 2; ++m) error = std::max(error, std::abs(state.displacement[m] - exact[static_cast<std::size_t>(m)]));
    }
    MESSAGE("pull-back, projection ", on, ": ", error, " m, ", result.summary.impacts.size(), " impacts, numerical ", result.summary.energy.numerical, " J");
    CHECK(result.summary.impacts.size() == 3);
    CHECK(error < 5e-4);
    CHECK(result.summary.worst_balance_error < 1e5 * epsilon);
    if (on) CHECK(largest_penetration(result, 0, 0.02) < 1e-12);
  }
  // of a ball lifted out of the floor, by hand: m g times the sum of the lifts
  const double h = 1.5e-3;  // it hits at two thirds of a step, later than gamma foresees
  AnalysisOptions late = projected(0.5, h, 1.5), without = projected(0.5, h, 1.5, false);
  late.gamma = without.gamma = 0.5;
  const Run lifted = run(ball(), late), left = run(ball(), without);
  double lift = 0;
  for (std::size_t i = 1; i < lifted.states.size(); ++i) {
    const State &before = lifted.states[i - 1], &after = lifted.states[i];
    lift += before.displacement[0] + 0.5 * h * (before.velocity[0] + after.velocity[0]) - after.displacement[0];
  }
  CHECK(lift > 1e-6);
  CHECK(lifted.summary.energy.numerical == doctest::Approx(-2 * lift).epsilon(1e-9));
  CHECK(std::abs(left.summary.energy.numerical) < 1e-12);
}

TEST_CASE("redundant pairs and fiber structures are projected too; dampers refuse") {
  ModelDescription twice = ball();
  twice.contacts.push_back(twice.contacts[0]);
  const Run doubled = run(twice, projected(0.5, 1e-3, 3.5)), single = run(ball(), projected(0.5, 1e-3, 3.5));
  CHECK(std::abs(doubled.states.back().displacement[0] - single.states.back().displacement[0]) < 1e-12);
  const Run fibers = run(fiber_pair(Steel02{235e6, 210e9, 0.01}, ElementKind::displacement_beam, 3), projected(0.5, 1e-3, 0.4));
  REQUIRE(fibers.summary.completed);
  CHECK(fibers.summary.impacts.size() > 0);
  CHECK(fibers.summary.worst_balance_error < 1e-6);  // of Newton's tolerance, 1e-8 a step
  ModelDescription damped = nonlinear_oscillator(100, Viscous{1e3, 0.5}, 0, 4);
  damped.structures[0].springs.push_back(ground_spring("elastic", "1", 1e4 * Vector6::Unit(0)));
  CHECK_THROWS_WITH_AS(run(damped, projected(0.5, 1e-3, 0.1)),
                       doctest::Contains("analysis.projection"), InputError);
}
