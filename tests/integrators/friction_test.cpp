// Coulomb friction and simultaneous impacts in motion: stick and slip against closed forms, energy, what is refused.
#include <doctest/doctest.h>

#include <cmath>

#include "base/errors.hpp"
#include "integrators/scheme_choice.hpp"
#include "tests/integrators/oscillators.hpp"
#include "tests/support/numbers.hpp"

using namespace nsframe;
using namespace nsframe::test;

namespace {

constexpr double g = 10, m = 3, mu = 0.4, friction_force = mu * m * g;  // [m/s2], [kg], [-], [N]

// A block on the floor, node "s.1", free along x and z; it lies a nanometre deep, so that contact acts from the first step.
ModelDescription block(double v0 = 0) {
  ModelDescription d = single_mass(m, 0, v0);
  d.structures[0].supports[0].fixed[2] = false;
  d.structures[0].may_move_freely = true;
  d.gravity = {Vector3(0, 0, -g), false};
  ContactDescription floor = wall("s.1", -1e-9, 0);
  floor.direction = -Vector3::UnitZ();
  floor.friction = mu;
  d.contacts = {floor};
  return d;
}

ModelDescription block_on_spring(double k, double x0) {
  ModelDescription d = block();
  d.structures[0].springs = {ground_spring("k", "1", k * Vector6::Unit(0))};
  d.structures[0].initial_displacements = {{{"1", {}}, 0, x0}};
  return d;
}

void check_balance(const Run& result) {
  CHECK(result.summary.completed);
  CHECK(result.summary.worst_balance_error < 1e5 * epsilon);  // thousands of steps
  double slips = 0;
  for (const Slip& slip : result.summary.slips) slips += slip.energy;
  CHECK(slips == doctest::Approx(result.summary.energy.friction).epsilon(1e-12));
}

double x_at(const Run& result, double t) {
  std::size_t i = 0;
  while (result.states[i].time < t - 1e-9) ++i;
  return result.states[i].displacement[0];
}

}  // namespace

TEST_CASE("a block slides v^2/(2 mu g) and stops for good, whatever theta; friction takes its energy") {
  const double v = 2, distance = v * v / (2 * mu * g), h = 1e-3;
  for (const double theta : {0.5, 1.0}) {
    const Run result = run(block(v), options(theta, h, 1));
    check_balance(result);
    // with theta = 1/2 only the step in which it stops is not exact, else each step by h/2 of its change of velocity
    CHECK(std::abs(x_at(result, 1) - distance) < (theta == 0.5 ? mu * g * h * h : v * h));
    CHECK(result.states.back().velocity.norm() < 1e-12);
    REQUIRE(result.summary.slips.size() == 1);
    CHECK(result.summary.slips[0].distance == doctest::Approx(x_at(result, 1)).epsilon(1e-12));
    CHECK(result.summary.energy.friction + result.summary.energy.numerical == doctest::Approx(0.5 * m * v * v).epsilon(1e-6));
    CHECK(result.summary.slips[0].energy == result.summary.energy.friction);
    if (theta == 0.5) CHECK(result.summary.energy.friction == doctest::Approx(friction_force * distance).epsilon(1e-5));
  }
}

TEST_CASE("along both tangents a block slides straight on and friction is no stronger than in one direction") {
  ModelDescription d = block();
  d.structures[0].supports[0].fixed[1] = false;
  d.structures[0].initial_velocities = {{{"1", {}}, 0, 1.2}, {{"1", {}}, 1, -1.6}};
  const Run result = run(d, options(0.5, 1e-3, 1));
  check_balance(result);
  const double distance = 4 / (2 * mu * g);
  CHECK(result.summary.slips[0].distance == doctest::Approx(distance).epsilon(1e-5));
  CHECK(result.states.back().displacement[0] == doctest::Approx(0.6 * distance).epsilon(1e-5));
  CHECK(result.states.back().displacement[1] == doctest::Approx(-0.8 * distance).epsilon(1e-5));
}

TEST_CASE("contacts given twice carry the same block the same way") {
  ModelDescription d = block(2);
  const Run once = run(d, options(0.5, 1e-3, 1));
  d.contacts.push_back(d.contacts[0]);
  const Run twice = run(d, options(0.5, 1e-3, 1));
  check_balance(twice);
  CHECK(std::abs(once.states.back().displacement[0] - twice.states.back().displacement[0]) < 1e-10);
  REQUIRE(twice.summary.slips.size() == 2);
  CHECK(twice.summary.slips[0].distance == doctest::Approx(once.summary.slips[0].distance).epsilon(1e-9));
}

TEST_CASE("on a shaken floor a block stays below mu g, and slips as far as Newmark's block above") {
  ModelDescription d = block();
  MotionDescription motion;
  motion.dt = 1e-4;
  const double below = 0.99 * mu * g, A = 2.5 * mu * g, t0 = 0.1;
  for (int i = 0; i <= 5000; ++i) motion.acceleration.push_back(below * std::sin(2 * pi * 3 * i * motion.dt));
  d.motions = {motion};
  const Run stays = run(d, options(0.5, 1e-3, 0.5));
  CHECK(stays.summary.slips[0].distance < 1e-12);
  CHECK(stays.states.back().displacement.cwiseAbs().maxCoeff() < 1e-8);
  CHECK(std::abs(stays.summary.energy.friction) < 1e-12);

  for (std::size_t i = 0; i < motion.acceleration.size(); ++i) motion.acceleration[i] = i < 1000 ? A : 0;  // a tenth of a second
  d.motions = {motion};
  const Run slips = run(d, options(0.5, 1e-4, 0.5));
  check_balance(slips);
  const double speed = (A - mu * g) * t0, distance = 0.5 * speed * t0 + speed * speed / (2 * mu * g);
  CHECK(slips.summary.slips[0].distance == doctest::Approx(distance).epsilon(3e-3));  // the pulse ends within a sample
  CHECK(slips.summary.energy.friction == doctest::Approx(friction_force * distance).epsilon(3e-3));
}

TEST_CASE("an oscillator with dry friction loses four friction forces over its stiffness a cycle and stops where it cannot return") {
  const double k = 4000, d = friction_force / k, x0 = 10.3 * d, w = std::sqrt(k / m);
  const Run result = run(block_on_spring(k, x0), options(0.5, 1e-4, 6 * pi / w));
  check_balance(result);
  // turns at -8.3, 6.3, -4.3, 2.3, -0.3 d, each half a cycle later
  for (int n = 1; n <= 5; ++n) {
    const double turn = (n % 2 ? -1 : 1) * (10.3 - 2 * n) * d;
    CHECK(std::abs(x_at(result, n * pi / w) - turn) < 5e-5 * d);
  }
  CHECK(std::abs(result.states.back().displacement[0] + 0.3 * d) < 5e-5 * d);
  CHECK(result.states.back().velocity.norm() < 1e-12);
  CHECK(result.summary.slips[0].distance == doctest::Approx((18.6 + 14.6 + 10.6 + 6.6 + 2.6) * d).epsilon(1e-4));
  CHECK(result.summary.energy.friction == doctest::Approx(0.5 * k * (x0 * x0 - 0.09 * d * d)).epsilon(1e-4));
}

TEST_CASE("on a belt a block slips until it is as fast, sticks until the spring is as strong, and then swings about that place") {
  const double k = 3000, w = std::sqrt(k / m), d = friction_force / k, v0 = 0.6 * d * w;
  ModelDescription description = block_on_spring(k, 0);
  StructureDescription belt = single_mass(1e9, 0, v0).structures[0];
  belt.name = "belt";
  belt.may_move_freely = true;
  description.structures.push_back(belt);
  description.structures[0].initial_displacements.clear();
  description.contacts[0].b = Reference{"belt.1", {}};
  const double t1 = std::asin(0.6) / w, x1 = d * (1 - 0.8), t2 = t1 + (d - x1) / v0, end = t2 + 1.9 * pi / w;
  double previous = 0;
  for (const double h : {4e-5, 2e-5}) {
    const Run result = run(description, options(0.5, h, end));
    check_balance(result);
    double error = 0;
    for (const State& state : result.states) {
      const double t = state.time;
      const double exact = t < t1 ? d * (1 - std::cos(w * t)) : t < t2 ? x1 + v0 * (t - t1) : d + v0 / w * std::sin(w * (t - t2));
      error = std::max(error, std::abs(state.displacement[0] - exact));
    }
    CHECK(error < d * w * w * h * h);  // second order
    if (previous > 0) CHECK(error < 0.5 * previous);
    previous = error;
  }
}

TEST_CASE("contact without friction computes none: the same bits, and no list of slips") {
  ModelDescription d = block(2);
  d.contacts[0].friction = 0;
  const Run result = run(d, options(0.5, 1e-3, 0.2));
  CHECK(result.summary.slips.empty());
  CHECK(result.summary.energy.friction == 0);
  CHECK(result.states.back().displacement[0] == doctest::Approx(0.4).epsilon(1e-12));
  CHECK(build(d).contacts.tangents.rows() == 0);
}

TEST_CASE("schemes without friction refuse it and name the one that has it, which auto takes") {
  const Model model = build(block(2));
  AnalysisOptions o = options(0.5, 1e-3, 0.1);
  for (const char* scheme : {"exact", "exponential"}) {
    o.scheme = scheme;
    try {
      Simulation simulation(model, o);
      FAIL(scheme, " took friction");
    } catch (const InputError& error) {
      CHECK(std::string(error.what()).find("scheme = \"moreau-jean\" has it") != std::string::npos);
    }
  }
  o.scheme = "auto";
  const Simulation chosen(model, o);
  CHECK(chosen.scheme().name() == "moreau-jean");
  CHECK(chosen.scheme_reason() == "not exact: contact has friction, which acts in moreau-jean alone");
  o.impact_law = ImpactLaw::poisson;
  CHECK_THROWS_AS(Simulation(model, o), InputError);
  ModelDescription d = block();
  d.contacts[0].friction = -0.1;
  CHECK(error_of(d).find("friction = -0.1, must not be negative") != std::string::npos);
}

namespace {

// Balls of 2 kg in a row, gap rates of the counterexample of theory.md (271).
ModelDescription three_balls(const Vector3& velocity, double second_gap, double e1, double e2) {
  ModelDescription d;
  for (int i = 0; i < 3; ++i) {
    StructureDescription s = single_mass(2, 0, velocity[i]).structures[0];
    s.name = std::string(1, static_cast<char>('a' + i));
    s.may_move_freely = true;
    d.structures.push_back(s);
  }
  for (int i = 0; i < 2; ++i) {
    ContactDescription c = wall(d.structures[static_cast<std::size_t>(i)].name + ".1", i == 0 ? 0 : second_gap, i == 0 ? e1 : e2);
    c.b = Reference{d.structures[static_cast<std::size_t>(i) + 1].name + ".1", {}};
    d.contacts.push_back(c);
  }
  return d;
}

}  // namespace

TEST_CASE("Moreau-Jean with Newton's law creates a sixth of a joule where e differs, and says so; with Poisson's an eighth is lost") {
  const ModelDescription d = three_balls({1, 0, 0.5}, -1e-3, 1, 0);  // the second pair overlaps a little and opens
  AnalysisOptions o = options(0.5, 1e-3, 2e-3);
  const Run newton = run(d, o);
  CHECK(newton.summary.created.sum == doctest::Approx(1.0 / 6).epsilon(1e-12));
  CHECK(newton.summary.created.largest == newton.summary.created.sum);
  CHECK(newton.summary.energy.contact == doctest::Approx(-1.0 / 6).epsilon(1e-12));
  o.impact_law = ImpactLaw::poisson;
  const Run poisson = run(d, o);
  CHECK(poisson.summary.created.sum == 0);
  CHECK(poisson.summary.energy.contact == doctest::Approx(0.125).epsilon(1e-12));
  for (const Run* result : {&newton, &poisson}) CHECK(result->summary.worst_balance_error < 64 * epsilon);
}

TEST_CASE("Newton's cradle: both laws share alike with e = 1, in Moreau-Jean and exactly; the law of one pair is the same") {
  for (const ImpactLaw law : {ImpactLaw::newton, ImpactLaw::poisson}) {
    for (const char* scheme : {"moreau-jean", "exact", "event-split"}) {
      CAPTURE(scheme);
      AnalysisOptions o = options(0.5, 1e-3, 2e-3);
      o.scheme = scheme;
      o.impact_law = law;
      const bool overlaps = std::string(scheme) == "moreau-jean";  // takes part only when predicted to close
      const Run cradle = run(three_balls({1, 0, 0}, overlaps ? -1e-9 : 0, 1, 1), o);
      CHECK((cradle.states.back().velocity - Vector3(-1, 2, 2) / 3).norm() < 64 * epsilon);
      CHECK(std::abs(cradle.summary.energy.contact) < 64 * epsilon);
      CHECK(cradle.summary.created.sum < 64 * epsilon);
      const Run pair = run(three_balls({1, 0, 0}, 1, 0.3, 0), o);
      CHECK((pair.states.back().velocity - Vector3(0.35, 0.65, 0)).norm() < 64 * epsilon);
    }
  }
}

TEST_CASE("Poisson's law in the schemes that find impacts: the hit of two balls that touch, with different e") {
  for (const char* scheme : {"exact", "event-split"}) {
    CAPTURE(scheme);
    AnalysisOptions o = options(0.5, 1e-3, 2e-3);
    o.scheme = scheme;
    o.impact_law = ImpactLaw::poisson;
    // compression (4/3, 2/3) N s brings all to 1/3 m/s; expansion adds 2/3 to the first pair, and 1/3 to the second, which would close
    const Run result = run(three_balls({1, 0, 0}, 0, 0.5, 0), o);
    CHECK((result.states.back().velocity - Vector3(0, 0.5, 0.5)).norm() < 64 * epsilon);
    CHECK(result.summary.created.sum == 0);
    CHECK(result.summary.energy.contact > 0);
  }
}
