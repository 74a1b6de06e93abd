// The scheme event-split: its order across impacts, sustained contact without drift, hard cases of contact, and against exact.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "tests/integrators/oscillators.hpp"
#include "tests/integrators/runs.hpp"
#include "tests/verification/closed_forms.hpp"
#include "tests/verification/pair_of_masses.hpp"

using namespace nsframe;
using namespace nsframe::test;

namespace {

double pull_back_error(const Run& run) {
  double error = 0;
  for (const State& state : run.states) {
    for (int k = 0; k < 2; ++k) error = std::max(error, std::abs(state.displacement[k] - pull_back_exact(state.time)[static_cast<std::size_t>(k)]));
  }
  return error;
}

}  // namespace

TEST_CASE("event-split: the pull-back pair, of second order across three impacts") {
  std::vector<double> errors;
  for (const double dt : {5e-3, 1e-3, 1e-4}) {
    const Run result = completed(pull_back(0.6, 0.005), by_scheme("event-split", dt, 2));
    CHECK(result.summary.impacts.size() == 3);
    CHECK(result.summary.factorizations == 2);  // of whole steps and of parts
    errors.push_back(pull_back_error(result));
  }
  CHECK(errors[1] < 4.5e-5);  // an event-split trapezoidal rule with its parts factored anew: 4.2e-5
  CHECK(std::log10(errors[1] / errors[2]) > 1.8);
}

TEST_CASE("event-split: a ball to rest, whose bounces end within a tenth of a step") {
  for (const double e : {0.5, 0.9}) {
    ModelDescription d = row({{1, 0, 0}});
    d.contacts = {contact_of(0, -1, 1.0, e)};
    d.gravity = {Vector3(2, 0, 0), false};
    const double rest = (1 + e) / (1 - e);
    for (const double dt : {1e-2, 1e-3}) {
      const Run result = completed(d, by_scheme("event-split", dt, rest + 0.5));
      double last = 0, error = 0;
      for (const Impact& impact : result.summary.impacts) last = std::max(last, impact.time);
      CHECK(last < rest + 1e-9);
      CHECK(last > rest - 0.1 * dt);
      CHECK(result.summary.accumulations.ended == 1);
      CHECK(result.summary.energy.contact == doctest::Approx(2).epsilon(1e-11));
      CHECK(std::abs(result.states.back().displacement[0] - 1) < 1e-12);
      CHECK(result.summary.max_penetration < 1e-12);
      if (e == 0.5) {
        for (const State& s : result.states) error = std::max(error, std::abs(s.displacement[0] - (1 - bouncing_ball_height(s.time))));
        CHECK(error < 1e-12);
      }
    }
  }
}

TEST_CASE("event-split: preload on a wall neither drifts nor leaks, and lets go in time") {
  const double m = 1000, k = m * 16 * pi * pi, g0 = 0.01, w = 4 * pi, t1 = 1;
  ModelDescription d = row({{m, k, 0}});
  MotionDescription motion;
  motion.dt = t1 / 4;
  motion.acceleration.assign(5, -4 * k * g0 / m);
  d.motions = {motion};
  d.gravity = {Vector3(-k * g0 / m, 0, 0), false};
  d.contacts = {contact_of(0, -1, g0, 0)};
  std::vector<double> later;
  for (const double dt : {1e-3, 2.5e-4}) {
    const Run result = completed(d, by_scheme("event-split", dt, 1.4));
    double drift = 0, error = 0;
    for (const State& state : result.states) {
      if (state.time > 0.068 && state.time <= t1) drift = std::max(drift, std::abs(state.displacement[0] - g0));
      if (state.time > t1) error = std::max(error, std::abs(state.displacement[0] + g0 - 2 * g0 * std::cos(w * (state.time - t1))));
    }
    CHECK(drift < 1e-14);
    CHECK(result.states[result.states.size() / 3].impulse[0] / dt == doctest::Approx(3158.2734).epsilon(1e-7));
    REQUIRE(result.summary.impacts.size() == 2);
    CHECK(std::abs(result.summary.impacts[0].time - 0.0669301182) < dt * dt);
    later.push_back(error);
  }
  CHECK(later[0] < 1.5e-6);
  CHECK(later[0] / later[1] > 12);
}

TEST_CASE("event-split: hard cases of contact on masses") {
  SUBCASE("grazing a wall without speed") {
    ModelDescription d = row({{1, 4 * pi * pi, 0, 0.01}});
    d.contacts = {contact_of(0, -1, 0.01, 0.6)};
    const Run result = completed(d, by_scheme("event-split", 1e-3, 3.5));
    double impulse = 0, error = 0;
    for (const Impact& impact : result.summary.impacts) impulse += impact.impulse;
    for (const State& state : result.states) error = std::max(error, std::abs(state.displacement[0] - 0.01 * std::cos(2 * pi * state.time)));
    CHECK(impulse < 1e-6);  // of 0.06 N s, the momentum on the way
    CHECK(error < 1e-6);
  }
  SUBCASE("heavy on light") {
    for (const double ratio : {1e6, 1e10}) {
      ModelDescription d = row({{ratio, 0, 0, 0, 1}, {1, 0, 0}});
      d.contacts = {contact_of(0, 1, 0.1, 0.7)};
      const Run hit = completed(d, by_scheme("event-split", 1e-2, 0.2));
      CHECK(std::abs(hit.states.back().velocity[0] - (ratio - 0.7) / (ratio + 1)) < 1e-13);
      CHECK(std::abs(hit.states.back().velocity[1] - ratio * 1.7 / (ratio + 1)) < 1e-13);
      d = row({{ratio, 0, 0}, {1, 0, 0}});
      d.contacts = {contact_of(0, 1, 0, 0.7), contact_of(1, -1, 0, 0.7)};
      d.gravity = {Vector3(9.81, 0, 0), false};
      const State stack = completed(d, by_scheme("event-split", 1e-2, 0.5)).states.back();
      CHECK(stack.impulse[0] == doctest::Approx(1e-2 * ratio * 9.81).epsilon(1e-15 * ratio));
      CHECK(stack.impulse[1] == doctest::Approx(1e-2 * (ratio + 1) * 9.81).epsilon(1e-15 * ratio));
      CHECK(stack.displacement.cwiseAbs().maxCoeff() < 1e-13);
    }
  }
  SUBCASE("five balls") {
    const int n = 5;
    for (const double gap : {0.0, 1e-3}) {
      std::vector<Oscillator> balls(n, {2, 0, 0});
      balls[0].velocity = 1;
      ModelDescription d = row(balls);
      for (int i = 0; i + 1 < n; ++i) d.contacts.push_back(contact_of(i, i + 1, gap, 1));
      const Run result = completed(d, by_scheme("event-split", 1e-2, 1));
      for (int i = 0; i < n; ++i) {
        const double expected = gap == 0 ? (i == 0 ? (2.0 - n) / n : 2.0 / n) : (i == n - 1 ? 1.0 : 0.0);
        CHECK(std::abs(result.states.back().velocity[i] - expected) < 1e-12);
      }
    }
  }
}

TEST_CASE("event-split: contact on a rotation without mass is a spring in series, of second order") {
  ModelDescription d;
  d.sections = {elastic_section("c", {7.3e9, 81e9, 1, 1e-4, 1e-4, 1e-4})};
  StructureDescription s;
  s.name = "s0";
  s.nodes = {node("0", 0, 0, 0), node("2", 0, 0, 2.5), node("1", 0, 0, 3)};
  s.elements = {beam("e", "0", "2", "c")};
  s.supports = {fixed("0"), fixed("2", {false, true, true, true, false, true})};
  s.masses = {{{"2", {}}, Vector3(4600, 0, 0), Vector3::Zero()}};
  s.constraints = {constraint(ConstraintKind::rigid_body, "2", {"1"})};
  s.initial_displacements = {{{"2", {}}, 0, -0.02}};
  d.structures = {s};
  d.contacts = {contact_of(0, -1, 0.01, 0.6)};
  const Run exact = completed(d, by_scheme("exact", 1e-3, 1.5));
  std::vector<double> errors;
  for (const int parts : {1, 4}) {
    const Run result = completed(d, by_scheme("event-split", 1e-3 / parts, 1.5));
    double error = 0;
    for (std::size_t i = 0; i < exact.states.size(); ++i) {
      error = std::max(error, (result.states[i * static_cast<std::size_t>(parts)].displacement - exact.states[i].displacement).cwiseAbs().maxCoeff());
    }
    errors.push_back(error);
    CHECK(result.summary.max_penetration < 1e-12);
    CHECK(result.summary.worst_balance_error < 1e-10);
  }
  CHECK(errors[0] < 6e-6);  // of 2 cm
  CHECK(errors[0] / errors[1] > 12);
}

TEST_CASE("event-split: the energy of the undamped pair with e = 1 never grows") {
  for (const double dt : {1e-3, 0.46, 1e-7}) {
    const Model model = build(pull_back(1, 0));
    Simulation simulation(model, by_scheme("event-split", dt, dt * 1e5));
    const Summary summary = simulation.run({});
    const State& s = simulation.state();
    const double energy = 0.5 * (4600 * s.velocity[0] * s.velocity[0] + 3500 * s.velocity[1] * s.velocity[1] +
                                 2.11e6 * s.displacement[0] * s.displacement[0] + 5.31e6 * s.displacement[1] * s.displacement[1]);
    CHECK(energy < 607.68 * (1 + 1e-9));
    CHECK(summary.energy.numerical == doctest::Approx(607.68 - energy).epsilon(1e-6).scale(607.68));
    if (dt < 0.1) CHECK(energy > 607.68 * (1 - 1e-4));
    CHECK(summary.worst_balance_error < 1e-9);
  }
}

TEST_CASE("event-split: yielding masses and fiber members, of second order across impacts, to the limit of exponential") {
  const ModelDescription masses = yielding_masses(Steel02{8e3, 2e6, 0.05});
  const auto slope = [](const ModelDescription& d, double dt, double duration, double most) {
    const Run fine = completed(d, by_scheme("exponential", dt / 32, duration));
    REQUIRE_FALSE(fine.summary.impacts.empty());
    std::vector<double> errors;
    for (const int parts : {1, 8}) {
      const Run ours = completed(d, by_scheme("event-split", dt / parts, duration));
      errors.push_back(difference(ours, fine));
      CHECK(ours.summary.worst_balance_error < 1e-6);
      CHECK(ours.summary.max_penetration < 1e-12);
    }
    CAPTURE(errors[0]);
    CHECK(errors[0] < most);
    CHECK(std::log(errors[0] / errors[1]) / std::log(8.0) > 1.8);
  };
  slope(masses, 8e-4, 0.4, 4e-5);
  slope(fiber_pair(Steel02{235e6, 210e9, 0.02}, ElementKind::displacement_beam, 4), 4e-4, 0.1, 6e-5);
  slope(fiber_pair(Steel02{235e6, 210e9, 0.02}, ElementKind::force_beam, 4), 4e-4, 0.1, 6e-5);
}

TEST_CASE("event-split: a yielding column pressed against a wall neither drifts nor opens") {
  ModelDescription d = nonlinear_oscillator(1000, Steel02{8e3, 2e6, 0.05});
  MotionDescription motion;
  motion.dt = 0.5;
  motion.acceleration = {0, -12, -12, -12, 0, 5, 5};
  d.motions = {motion};
  d.contacts = {wall("s.1", 0.02, 0.3)};
  const Run ours = completed(d, by_scheme("event-split", 1e-3, 3)), reference = completed(d, by_scheme("exponential", 1e-4, 3));
  double drift = 0;
  for (const State& state : ours.states) {
    if (state.time > 1 && state.time < 1.5) drift = std::max(drift, std::abs(state.displacement[0] - 0.02));
  }
  CHECK(drift < 1e-12);
  CHECK(ours.summary.max_penetration < 1e-12);
  CHECK(difference(ours, reference) < 1e-5);
}

TEST_CASE("event-split: converges to exact on random rows of two to six masses over six decades") {
  std::mt19937 random(20210715);
  const std::vector<double> steps{5e-4, 2.5e-4, 1.25e-4};
  std::size_t most_impacts = 0;
  std::vector<double> slopes;
  double worst = 0;
  for (int scene = 0; scene < 100; ++scene) {
    CAPTURE(scene);
    const auto number = [&](double low, double high) { return std::uniform_real_distribution<double>(low, high)(random); };
    const int n = 2 + scene % 5;
    ModelDescription d;
    double energy = 0;
    for (int i = 0; i < n; ++i) {
      const double m = std::pow(10, number(-3, 3)), w = number(2, 30);
      const Oscillator body{m, m * w * w, number(0, 0.1), number(-0.01, 0), number(-0.5, 0.5)};
      energy += 0.5 * m * (w * w * body.displacement * body.displacement + body.velocity * body.velocity);
      d.structures.push_back(oscillator(i, body));
      d.contacts.push_back(contact_of(i, i + 1 < n ? i + 1 : -1, number(0.0101, 0.03), number(0, 1)));
    }
    const Run exact = run(d, by_scheme("exact", 5e-3, 0.3));
    std::vector<double> errors;
    for (const double dt : steps) {
      const Run ours = run(d, by_scheme("event-split", dt, 0.3));
      CAPTURE(dt);
      CAPTURE(ours.summary.stop_reason);
      REQUIRE(ours.summary.completed);
      errors.push_back(difference(exact, ours));
      CHECK(ours.summary.max_penetration < 1e-12);
      CHECK(ours.summary.energy.contact > -1e-9 * energy);
      CHECK(ours.summary.worst_balance_error < 1e-7);
      CHECK(ours.summary.accumulations.plastic == 0);
      most_impacts = std::max(most_impacts, ours.summary.impacts.size());
    }
    worst = std::max(worst, errors.back());
    slopes.push_back(std::log(errors.front() / errors.back()) / std::log(steps.front() / steps.back()));
  }
  std::sort(slopes.begin(), slopes.end());
  CAPTURE(slopes[0]);
  CAPTURE(slopes[2]);
  CAPTURE(slopes[5]);
  CAPTURE(worst);
  CHECK(slopes[3] > 1.8);
  CHECK(slopes[50] > 1.95);
  CHECK(worst < 1.2e-6);  // of motions of centimetres
  CHECK(most_impacts > 100);  // a light mass between two that close on it: every impact makes the other pair close again
}

TEST_CASE("event-split: a run that goes on from a snapshot has the same bits") {
  const Model model = build(fiber_pair(Steel02{235e6, 210e9, 0.02}, ElementKind::displacement_beam, 4));
  const AnalysisOptions o = by_scheme("event-split", 1e-3, 0.1);
  for (const int stop_at : {3, 43}) check_resumed(model, o, stop_at);
}

TEST_CASE("event-split: what it cannot take is refused by name") {
  ModelDescription rate = nonlinear_oscillator(1000, Viscous{1e3, 0.5}, 0, 1);
  rate.structures[0].springs.push_back(ground_spring("stiff", "1", 1e6 * Vector6::Unit(0)));
  CHECK_THROWS_WITH_AS(run(rate, by_scheme("event-split", 1e-3, 0.1)), doctest::Contains("rate of deformation"), InputError);
  ModelDescription overlap = row({{1, 100, 0, 0.02}});
  overlap.contacts = {contact_of(0, -1, 0.01, 0.5)};
  CHECK_THROWS_WITH_AS(run(overlap, by_scheme("event-split", 1e-3, 0.1)), doctest::Contains("overlaps by 0.01 m"), InputError);
}
