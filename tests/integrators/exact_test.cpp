// The exact scheme: the hard cases that have a closed form, and its energy.
#include <doctest/doctest.h>

#include <cmath>
#include <limits>

#include "integrators/exact.hpp"
#include "tests/integrators/oscillators.hpp"
#include "tests/verification/closed_forms.hpp"

using namespace nsframe;
using namespace nsframe::test;

namespace {

constexpr double epsilon = std::numeric_limits<double>::epsilon();

Run completed(const ModelDescription& d, const AnalysisOptions& options) {
  Run result = run(d, options);
  CAPTURE(result.summary.stop_reason);
  REQUIRE(result.summary.completed);
  return result;
}

AnalysisOptions exactly(double dt, double duration) {
  AnalysisOptions o;
  o.scheme = "exact";
  o.dt = dt;
  o.duration = duration;
  return o;
}

// Masses in a row along x, free in x only: structures "0", "1", ... with one node "1".
struct Body {
  double mass, stiffness = 0, damping_ratio = 0, displacement = 0, velocity = 0;
};

ModelDescription row(const std::vector<Body>& bodies) {
  ModelDescription d;
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    const Body& b = bodies[i];
    StructureDescription s = b.stiffness > 0 ? linear_oscillator(b.mass, b.stiffness, b.damping_ratio, b.displacement, b.velocity).structures[0]
                                             : single_mass(b.mass, b.displacement, b.velocity).structures[0];
    s.name = std::to_string(i);
    s.may_move_freely = b.stiffness == 0;
    d.structures.push_back(s);
  }
  return d;
}

ContactDescription between(int a, int b, double gap, double e) {
  ContactDescription c = wall(std::to_string(a) + ".1", gap, e);
  if (b >= 0) c.b = Reference{std::to_string(b) + ".1", {}};
  return c;
}

ModelDescription pull_back(double e, double xi) {
  ModelDescription d = row({{4600, 2.11e6, xi, -0.024}, {3500, 5.31e6, xi}});
  d.contacts = {between(0, 1, 0.02, e)};
  return d;
}

}  // namespace

TEST_CASE("exact: the pull-back pair is right to rounding at every step") {
  for (const double dt : {1e-2, 1e-3}) {
    const Run result = completed(pull_back(0.6, 0.005), exactly(dt, 2));
    REQUIRE(result.summary.impacts.size() == 3);
    double error = 0;
    for (const State& state : result.states) {
      const auto q = pull_back_exact(state.time);
      error = std::max({error, std::abs(state.displacement[0] - q[0]), std::abs(state.displacement[1] - q[1])});
    }
    CHECK(error < 1e-12);
    CHECK(result.summary.impacts[0].time == doctest::Approx(0.12050131156430804).epsilon(1e-14));
    CHECK(result.summary.impacts[2].impulse == doctest::Approx(813.15022).epsilon(1e-8));
    CHECK(result.summary.worst_balance_error < 1e-13);
  }
}

TEST_CASE("exact: the ball comes to rest where the geometric series ends") {
  for (const double e : {0.5, 0.9}) {
    ModelDescription d;
    d.structures = row({{1}}).structures;
    d.contacts = {between(0, -1, 1.0, e)};
    d.gravity = {Vector3(2, 0, 0), false};
    const double rest = (1 + e) / (1 - e);
    const Run result = completed(d, exactly(1e-3, rest + 0.5));
    double last = 0;
    for (const Impact& impact : result.summary.impacts) last = std::max(last, impact.time);
    CHECK(result.summary.worst_balance_error < 1e-13);
    CHECK(result.summary.max_penetration < 1e-13);
    CHECK(std::abs(last - rest) < 1e-10);
    if (e == 0.5) {
      double error = 0;
      for (const State& state : result.states) error = std::max(error, std::abs(1 - state.displacement[0] - bouncing_ball_height(state.time)));
      CHECK(error < 1e-12);
    }
  }
}

TEST_CASE("exact: a preload pushes a mass onto a wall, holds it there without drift, and lets it go") {
  const double m = 1000, f = 2, k = m * 16 * pi * pi, g0 = 0.01, w = 2 * pi * f, t1 = 1;
  ModelDescription d = row({{m, k}});
  MotionDescription motion;  // 4 k g0 until t1, beside - k g0 throughout
  motion.dt = t1 / 4;
  motion.acceleration.assign(5, -4 * k * g0 / m);
  d.motions = {motion};
  d.gravity = {Vector3(-k * g0 / m, 0, 0), false};
  d.contacts = {between(0, -1, g0, 0)};
  const Run result = completed(d, exactly(1e-3, 1.4));
  double drift = 0, later = 0;
  for (const State& state : result.states) {
    if (state.time > 0.067 && state.time <= t1) drift = std::max(drift, std::abs(state.displacement[0] - g0));
    if (state.time > t1) later = std::max(later, std::abs(state.displacement[0] + g0 - 2 * g0 * std::cos(w * (state.time - t1))));
  }
  REQUIRE(result.summary.impacts.size() == 2);
  CHECK(result.summary.worst_balance_error < 1e-11);
  CHECK(result.summary.impacts[0].time == doctest::Approx(std::acos(2.0 / 3) / w).epsilon(1e-13));
  CHECK(result.summary.impacts[1].time == doctest::Approx(t1).epsilon(1e-13));
  CHECK(drift < 1e-15);
  CHECK(later < 1e-14);
  CHECK(result.states[500].impulse[0] / 1e-3 == doctest::Approx(2 * k * g0).epsilon(1e-12));
  CHECK(2 * k * g0 == doctest::Approx(3158.2734).epsilon(1e-8));
}

TEST_CASE("exact: a wall that is grazed without speed gives no impulse") {
  const double m = 1, k = 16 * pi * pi, g0 = 0.01;
  for (const double gap : {g0, g0 * (1 + 1e-12)}) {
    ModelDescription d = row({{m, k, 0, g0}});
    d.structures[0].springs[0].stiffness[0] = 4 * pi * pi;  // q = g0 cos 2 pi t
    d.contacts = {between(0, -1, gap, 0.6)};
    const Run result = completed(d, exactly(1e-3, 3.5));
    double impulse = 0, error = 0;
    for (const Impact& impact : result.summary.impacts) impulse += impact.impulse;
    for (const State& state : result.states) error = std::max(error, std::abs(state.displacement[0] - g0 * std::cos(2 * pi * state.time)));
    CHECK(impulse < 1e-9);
    CHECK(error < 1e-12);
  }
}

TEST_CASE("exact: touching balls share an impact as Newton's law for all pairs says, balls with gaps pass it on") {
  const int n = 5;
  for (const double gap : {0.0, 1e-3}) {
    std::vector<Body> bodies(n, Body{2});
    bodies[0].velocity = 1;
    ModelDescription d = row(bodies);
    for (int i = 0; i + 1 < n; ++i) d.contacts.push_back(between(i, i + 1, gap, 1));
    const Run result = completed(d, exactly(1e-2, 1));
    for (int i = 0; i < n; ++i) {
      const double v = result.states.back().velocity[i];
      CAPTURE(result.summary.impacts.size());
      CAPTURE(result.states.front().displacement[i]);
      CHECK(v == doctest::Approx(gap == 0 ? (i == 0 ? (2.0 - n) / n : 2.0 / n) : (i == n - 1 ? 1.0 : 0.0)).epsilon(1e-13));
    }
  }
}

TEST_CASE("exact: mass ratios up to 1e10") {
  for (const double ratio : {1e6, 1e10}) {
    const double e = 0.7;
    ModelDescription d = row({{ratio, 0, 0, 0, 1}, {1}});
    d.contacts = {between(0, 1, 0.1, e)};
    Run result = completed(d, exactly(1e-2, 0.2));
    CHECK(result.states.back().velocity[0] == doctest::Approx((ratio - e) / (ratio + 1)).epsilon(1e-14));
    CHECK(result.states.back().velocity[1] == doctest::Approx(ratio * (1 + e) / (ratio + 1)).epsilon(1e-14));
    // heavy on light on the floor, at rest under gravity
    d = row({{ratio}, {1}});
    d.contacts = {between(0, 1, 0, e), between(1, -1, 0, e)};
    d.gravity = {Vector3(9.81, 0, 0), false};
    result = completed(d, exactly(1e-2, 0.5));
    const VectorX& p = result.states.back().impulse;
    CHECK(p[0] / 1e-2 == doctest::Approx(ratio * 9.81).epsilon(1e-8));
    CHECK(p[1] / 1e-2 == doctest::Approx((ratio + 1) * 9.81).epsilon(1e-8));
    CHECK(result.states.back().displacement.cwiseAbs().maxCoeff() < 1e-15);
  }
}

TEST_CASE("exact: undamped masses with e = 1 keep their energy over a million steps and thousands of impacts") {
  const Model model = build(pull_back(1, 0));
  Simulation simulation(model, exactly(1e-3, 1000));
  const Summary summary = simulation.run({});
  CHECK(summary.steps == 1000000);
  CHECK(summary.impacts.size() > 3000);
  const State& s = simulation.state();
  const double start = 0.5 * 2.11e6 * 0.024 * 0.024;
  const double end = 0.5 * (4600 * s.velocity[0] * s.velocity[0] + 3500 * s.velocity[1] * s.velocity[1] + 2.11e6 * s.displacement[0] * s.displacement[0] +
                            5.31e6 * s.displacement[1] * s.displacement[1]);
  CHECK(start == doctest::Approx(607.68).epsilon(1e-12));
  CHECK(std::abs(end / start - 1) < 1e-11);
  CHECK(summary.worst_balance_error < 1e-11);
}

TEST_CASE("exact: contact on a rotation without mass is a spring in series, without impulse") {
  // cantilever with 4600 kg at its tip, contact at an arm of 0.5 m on the tip's rotation
  const double m = 4600, EI = 7.3e5, L = 2.5, arm = 0.5, g0 = 0.01;
  ModelDescription d;
  d.sections = {elastic_section("c", {EI / 1e-4, 81e9, 1, 1e-4, 1e-4, 1e-4})};
  StructureDescription s;
  s.name = "a";
  s.nodes = {node("1", 0, 0, 0), node("2", 0, 0, L), node("3", 0, 0, L + arm)};
  s.elements = {beam("e", "1", "2", "c")};
  s.supports = {fixed("1"), fixed("2", {false, true, true, true, false, true})};
  s.masses = {{{"2", {}}, Vector3(m, 0, 0), Vector3::Zero()}};
  s.constraints = {constraint(ConstraintKind::rigid_body, "2", {"3"})};
  s.initial_displacements = {{{"2", {}}, 0, -0.02}};
  d.structures = {s};
  d.contacts = {wall("a.3", g0, 0.6)};
  const Run result = completed(d, exactly(1e-3, 1.5));
  CHECK(result.summary.max_penetration < 1e-12);
  CHECK(result.summary.worst_balance_error < 1e-10);
  REQUIRE(result.summary.impacts.size() == 2);
  CHECK(std::abs(result.summary.impacts[0].time - 0.42862361) < 1e-8);
  CHECK(std::abs(result.summary.impacts[1].time - 1.21333678) < 1e-8);
}

TEST_CASE("exact: a rigid slab that falls flat on four corners keeps flat") {
  for (const double e : {0.5, 0.0}) {
    const double m = 4600, h = 0.05, g = 9.81;
    ModelDescription d;
    StructureDescription s;
    s.name = "slab";
    s.may_move_freely = true;
    s.nodes = {node("0", 0, 0, h), node("1", -1.6, -1.1, h), node("2", 1.6, -1.1, h), node("3", 1.6, 1.1, h), node("4", -1.6, 1.1, h)};
    s.masses = {mass("0", m, Vector3(m * 1.1 * 1.1 / 3, m * 1.6 * 1.6 / 3, m * 1.2))};
    s.constraints = {constraint(ConstraintKind::rigid_body, "0", {"1", "2", "3", "4"})};
    d.structures = {s};
    for (int i = 1; i <= 4; ++i) {
      ContactDescription c = wall("slab." + std::to_string(i), h, e);
      c.direction = -Vector3::UnitZ();
      d.contacts.push_back(c);
    }
    d.gravity = {Vector3(0, 0, -g), false};
    const double t0 = std::sqrt(2 * h / g), v = std::sqrt(2 * g * h);
    const Run result = completed(d, exactly(1e-3, e > 0 ? 0.15 : 0.5));
    const auto& impacts = result.summary.impacts;
    REQUIRE(impacts.size() >= 4);
    double sum = 0;
    for (int i = 0; i < 4; ++i) {
      sum += impacts[static_cast<std::size_t>(i)].impulse;
      CHECK(impacts[static_cast<std::size_t>(i)].time == doctest::Approx(t0).epsilon(1e-14));
      CHECK(impacts[static_cast<std::size_t>(i)].rate_after == doctest::Approx(e * v).epsilon(1e-13));
    }
    CHECK(sum == doctest::Approx(m * (1 + e) * v).epsilon(1e-13));
    double turned = 0;
    for (const State& state : result.states) turned = std::max(turned, state.displacement.tail(3).cwiseAbs().maxCoeff());
    CHECK(turned < 1e-15);
    if (e == 0) {
      CHECK(result.states.back().impulse.sum() / 1e-3 == doctest::Approx(m * g).epsilon(1e-12));
      CHECK(result.states.back().displacement[2] == doctest::Approx(-h).epsilon(1e-14));
    }
  }
}

TEST_CASE("exact: an elastic bar of 100 elements hits a wall, stays as long as its wave takes, and leaves") {
  // E = 900, rho = 1, L = 10, c = 30 m/s; starts 5 m off at 10 m/s: in contact from 0.5 s for 2 L/c, impulse 2 rho L v = 200
  const int N = 100;
  const double dx = 0.1;
  ModelDescription d;
  StructureDescription s;
  s.name = "bar";
  s.may_move_freely = true;
  d.materials = {{"e", {}, Elastic{900}}};
  for (int i = 0; i <= N; ++i) {
    const std::string id = std::to_string(i);
    s.nodes.push_back(node(id, i * dx, 0, 0));
    s.supports.push_back(fixed(id, {false, true, true, true, true, true}));
    s.masses.push_back({{id, {}}, Vector3(i == 0 || i == N ? dx / 2 : dx, 0, 0), Vector3::Zero()});
    s.initial_velocities.push_back({{id, {}}, 0, -10});
    if (i < N) s.elements.push_back(bar(id, id, std::to_string(i + 1), "e", 1));
  }
  d.structures = {s};
  ContactDescription c = wall("bar.0", 5, 0);
  c.direction = -Vector3::UnitX();
  d.contacts = {c};
  const Run result = completed(d, exactly(1e-3, 1.5));
  double impulse = 0, contact = 0, last = 0;
  for (const State& state : result.states) {
    if (state.impulse.size() > 0) impulse += state.impulse[0];
    if (state.impulse.size() > 0 && state.impulse[0] > 0) last = state.time;
    if (state.time > 0.5 && state.time < 0.5 + 2.0 / 3) contact = std::max(contact, std::abs(state.displacement[0] + 5));
  }
  const VectorX& v = result.states.back().velocity;
  double momentum = 0;
  for (int i = 0; i <= N; ++i) momentum += v[i] * (i == 0 || i == N ? dx / 2 : dx);
  // the chain of masses disperses the wave's front: that of the bar itself is met to (dx / L)^(2/3)
  CHECK(impulse == doctest::Approx(200).epsilon(0.01));
  CHECK(last == doctest::Approx(0.5 + 2.0 / 3).epsilon(0.005));
  CHECK(contact < 1e-13);
  CHECK(momentum / 10 == doctest::Approx(10).epsilon(0.02));
  CHECK(result.summary.worst_balance_error < 1e-12);
}

TEST_CASE("exact: nonlinear elements and damping that couples the modes are refused, each with its name") {
  const auto reason = [](const ModelDescription& d) {
    try {
      run(d, exactly(1e-3, 0.1));
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string("no error");
  };
  CHECK(reason(nonlinear_oscillator(100, Steel02{1e4, 1e6, 0.01}, 0, 4)).find("element 's.k' (spring) is nonlinear") != std::string::npos);
  ModelDescription d = row({{1, 100}});
  CHECK(reason(d) == "no error");
  StructureDescription& s = d.structures[0];
  s.supports[0].fixed[1] = false;  // two directions, of which a skew dashpot couples the motions
  s.springs[0].stiffness[1] = 400;
  s.springs.push_back(s.springs[0]);
  s.springs[1].id = "skew";
  s.springs[1].stiffness.setZero();
  s.springs[1].damping[0] = 3;
  s.springs[1].x = Vector3(1, 1, 0);
  s.springs[1].in_plane = Vector3::UnitY();
  const std::string why = reason(d);
  CHECK_MESSAGE(why.find("structure '0'") != std::string::npos, why);
}
