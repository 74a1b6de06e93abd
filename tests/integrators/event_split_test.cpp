// The scheme event-split: its order across impacts, sustained contact without drift, hard cases of contact, and against exact.
#include <doctest/doctest.h>

#include <cmath>

#include "tests/integrators/oscillators.hpp"
#include "tests/verification/closed_forms.hpp"
#include "tests/verification/pair_of_masses.hpp"

using namespace nsframe;
using namespace nsframe::test;

namespace {

AnalysisOptions by_scheme(const std::string& scheme, double dt, double duration) {
  AnalysisOptions o = options(0.5, dt, duration);
  o.scheme = scheme;
  return o;
}

Run completed(const ModelDescription& d, const AnalysisOptions& o) {
  Run result = run(d, o);
  CAPTURE(result.summary.stop_reason);
  REQUIRE(result.summary.completed);
  return result;
}

ModelDescription row(const std::vector<Oscillator>& bodies) {
  ModelDescription d;
  for (std::size_t i = 0; i < bodies.size(); ++i) d.structures.push_back(oscillator(static_cast<int>(i), bodies[i]));
  return d;
}

ModelDescription pull_back(double e, double xi) {
  ModelDescription d = row({{4600, 2.11e6, xi, -0.024}, {3500, 5.31e6, xi}});
  d.contacts = {contact_of(0, 1, 0.02, e)};
  return d;
}

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
    CHECK(result.summary.factorizations == 1);
    errors.push_back(pull_back_error(result));
  }
  CHECK(errors[1] < 4.5e-5);  // an event-split trapezoidal rule with its parts factored anew: 4.2e-5
  CHECK(std::log10(errors[1] / errors[2]) > 1.8);
}

TEST_CASE("event-split: probe hard cases") {
  for (const double e : {0.5, 0.9}) {
    ModelDescription d = row({{1, 0, 0}});
    d.contacts = {contact_of(0, -1, 1.0, e)};
    d.gravity = {Vector3(2, 0, 0), false};
    const double rest = (1 + e) / (1 - e);
    for (const double dt : {1e-2, 1e-3}) {
      const Run result = completed(d, by_scheme("event-split", dt, rest + 0.5));
      double last = 0;
      for (const Impact& i : result.summary.impacts) last = std::max(last, i.time);
      double err = 0;
      if (e == 0.5) for (const State& state : result.states) err = std::max(err, std::abs(state.displacement[0] - (1 - bouncing_ball_height(state.time))));
      MESSAGE("ball e " << e << " dt " << dt << " rest " << last - rest << " at " << result.states.back().displacement[0] - 1 << " energy " << result.summary.energy.contact - 2
              << " pen " << result.summary.max_penetration << " impacts " << result.summary.impacts.size() << " ended " << result.summary.accumulations.ended << " err " << err);
    }
  }
  {
    const double m = 1000, k = m * 16 * pi * pi, g0 = 0.01, w = 4 * pi, t1 = 1;
    ModelDescription d = row({{m, k, 0}});
    MotionDescription motion;
    motion.dt = t1 / 4;
    motion.acceleration.assign(5, -4 * k * g0 / m);
    d.motions = {motion};
    d.gravity = {Vector3(-k * g0 / m, 0, 0), false};
    d.contacts = {contact_of(0, -1, g0, 0)};
    for (const double dt : {1e-3, 2.5e-4}) {
    const Run result = completed(d, by_scheme("event-split", dt, 1.4));
    double drift = 0, later = 0, reaction = 0;
    for (const State& state : result.states) {
      if (state.time > 0.068 && state.time <= t1) drift = std::max(drift, std::abs(state.displacement[0] - g0)), reaction = state.impulse[0] / dt;
      if (state.time > t1) later = std::max(later, std::abs(state.displacement[0] + g0 - 2 * g0 * std::cos(w * (state.time - t1))));
    }
    MESSAGE("preload drift " << drift << " later " << later << " reaction " << reaction << " first " << result.summary.impacts.at(0).time << " n " << result.summary.impacts.size() << " part " << result.summary.impacts.back().time);
    }
  }
  {
    ModelDescription d = row({{1, 4 * pi * pi, 0, 0.01}});
    d.contacts = {contact_of(0, -1, 0.01, 0.6)};
    const Run result = completed(d, by_scheme("event-split", 1e-3, 3.5));
    double impulse = 0, error = 0;
    for (const Impact& impact : result.summary.impacts) impulse += impact.impulse;
    for (const State& state : result.states) error = std::max(error, std::abs(state.displacement[0] - 0.01 * std::cos(2 * pi * state.time)));
    MESSAGE("grazing " << impulse << " err " << error << " pen " << result.summary.max_penetration);
  }
  {
    for (const double ratio : {1e6, 1e10}) {
      ModelDescription d = row({{ratio, 0, 0, 0, 1}, {1, 0, 0}});
      d.contacts = {contact_of(0, 1, 0.1, 0.7)};
      const Run r = completed(d, by_scheme("event-split", 1e-2, 0.2));
      MESSAGE("ratio " << r.states.back().velocity[0] - (ratio - 0.7) / (ratio + 1) << " " << r.states.back().velocity[1] - ratio * 1.7 / (ratio + 1));
      d = row({{ratio, 0, 0}, {1, 0, 0}});
      d.contacts = {contact_of(0, 1, 0, 0.7), contact_of(1, -1, 0, 0.7)};
      d.gravity = {Vector3(9.81, 0, 0), false};
      const Run s = completed(d, by_scheme("event-split", 1e-2, 0.5));
      MESSAGE("stack " << s.states.back().impulse[0] / 1e-2 / (ratio * 9.81) - 1 << " " << s.states.back().impulse[1] / 1e-2 / ((ratio + 1) * 9.81) - 1 << " q " << s.states.back().displacement.cwiseAbs().maxCoeff());
    }
  }
  {
    const int n = 5;
    for (const double gap : {0.0, 1e-3}) {
      std::vector<Oscillator> balls(n, {2, 0, 0});
      balls[0].velocity = 1;
      ModelDescription d = row(balls);
      for (int i = 0; i + 1 < n; ++i) d.contacts.push_back(contact_of(i, i + 1, gap, 1));
      const Run r = completed(d, by_scheme("event-split", 1e-2, 1));
      MESSAGE("cradle " << r.states.back().velocity.transpose());
    }
  }
  {
    const double m = 4600, EI = 7.3e5, L = 2.5, arm = 0.5;
    ModelDescription d;
    d.sections = {elastic_section("c", {EI / 1e-4, 81e9, 1, 1e-4, 1e-4, 1e-4})};
    StructureDescription s;
    s.name = "s0";
    s.nodes = {node("0", 0, 0, 0), node("2", 0, 0, L), node("1", 0, 0, L + arm)};
    s.elements = {beam("e", "0", "2", "c")};
    s.supports = {fixed("0"), fixed("2", {false, true, true, true, false, true})};
    s.masses = {{{"2", {}}, Vector3(m, 0, 0), Vector3::Zero()}};
    s.constraints = {constraint(ConstraintKind::rigid_body, "2", {"1"})};
    s.initial_displacements = {{{"2", {}}, 0, -0.02}};
    d.structures = {s};
    d.contacts = {contact_of(0, -1, 0.01, 0.6)};
    const Run ex = completed(d, by_scheme("exact", 1e-3, 1.5));
    for (const double dt : {1e-3, 2.5e-4}) {
      const Run r = completed(d, by_scheme("event-split", dt, 1.5));
      double err = 0;
      for (std::size_t i = 0; i < r.states.size(); ++i) {
        const double at = r.states[i].time / 1e-3;
        const auto k = static_cast<std::size_t>(std::lround(at));
        if (std::abs(at - static_cast<double>(k)) < 1e-6) err = std::max(err, (r.states[i].displacement - ex.states[k].displacement).cwiseAbs().maxCoeff());
      }
      MESSAGE("massless " << err << " n " << r.summary.impacts.size() << " pen " << r.summary.max_penetration << " balance " << r.summary.worst_balance_error);
      for (const Impact& i : r.summary.impacts) MESSAGE("  " << i.time << " " << i.impulse);
    }
  }
  for (double h : {1e-3, 0.46, 1e-7}) {
    const Model model = build(pull_back(1, 0));
    AnalysisOptions o = by_scheme("event-split", h, h * 2e5);
    Simulation simulation(model, o);
    const Summary summary = simulation.run({});
    const State& s = simulation.state();
    MESSAGE("energy " << h << " " << 0.5 * (4600 * s.velocity[0] * s.velocity[0] + 3500 * s.velocity[1] * s.velocity[1] + 2.11e6 * s.displacement[0] * s.displacement[0] +
                  5.31e6 * s.displacement[1] * s.displacement[1]) / 607.68 << " impacts " << summary.impacts.size() << " balance " << summary.worst_balance_error);
  }
}
