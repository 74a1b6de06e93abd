// The exact scheme on random rows of masses between which impacts accumulate, last, and follow one another at all scales.
#include <doctest/doctest.h>
#include <rapidcheck.h>

#include <cmath>

#include "integrators/simulation.hpp"
#include "tests/support/small_models.hpp"
#include "tests/verification/pair_of_masses.hpp"

using namespace nsframe;
using namespace nsframe::test;

namespace {

struct Row {
  std::vector<Oscillator> bodies;
  ModelDescription description;
};

double number(double low, double high) { return low + (high - low) * *rc::gen::inRange(0, 10001) / 10000.0; }

// Two to six masses over six decades, free or on springs, before a wall; half of the rows on a moving base.
Row random_row(double restitution) {
  Row row;
  const int n = *rc::gen::inRange(2, 7);
  for (int i = 0; i < n; ++i) {
    const double m = std::pow(10, number(-3, 3)), w = *rc::gen::element(0.0, number(2, 60));
    row.bodies.push_back({m, m * w * w, w > 0 ? *rc::gen::element(0.0, number(0, 0.1), 1.5) : 0.0, number(-0.01, 0), number(-0.5, 0.5)});
    row.description.structures.push_back(oscillator(i, row.bodies.back()));
    row.description.contacts.push_back(contact_of(i, i + 1 < n ? i + 1 : -1, number(0.0101, 0.03), restitution));
  }
  if (*rc::gen::arbitrary<bool>()) {
    MotionDescription motion;
    motion.dt = 0.05;
    for (int i = 0; i <= 12; ++i) motion.acceleration.push_back(number(-5, 5));
    row.description.motions = {motion};
  }
  return row;
}

// Integral of the base's acceleration, whose steps are kept results' steps or multiples of them.
double base_velocity(const Model& model, double time) {
  double sum = 0;
  if (model.motions.empty()) return sum;
  const GroundMotion& motion = model.motions[0];
  for (std::size_t k = 0; k + 1 < motion.acceleration.size() && static_cast<double>(k) * motion.dt < time; ++k) {
    const double s = std::min(1.0, time / motion.dt - static_cast<double>(k)), a = motion.acceleration[k];
    sum += motion.dt * s * (a + 0.5 * s * (motion.acceleration[k + 1] - a));
  }
  return sum;
}

// Springs aside, what a mass gains is what the base and its two neighbours give.
double momentum_error(const Row& row, const Model& model, const std::vector<State>& states) {
  double worst = 0;
  for (std::size_t i = 0; i < row.bodies.size(); ++i) {
    const Oscillator& body = row.bodies[i];
    if (body.stiffness > 0) continue;
    const auto at = static_cast<Eigen::Index>(i);
    double given = 0, size = body.mass;  // of 1 m/s
    for (const State& state : states) {
      if (state.impulse.size() == 0) continue;
      const double left = i > 0 ? state.impulse[at - 1] : 0;
      given += left - state.impulse[at];
      size += left + state.impulse[at];
      const double gained = body.mass * (state.velocity[at] - body.velocity + base_velocity(model, state.time));
      worst = std::max(worst, std::abs(gained - given) / size);
    }
  }
  return worst;
}

void check_run(const Row& row) {
  const Model model = build(row.description);
  AnalysisOptions options;
  options.scheme = "exact";
  options.dt = 5e-3;
  options.duration = 0.6;
  Simulation simulation(model, options);
  Recorder recorder;
  const Summary summary = simulation.run({&recorder});
  RC_LOG() << summary.stop_reason << " impacts " << summary.impacts.size();
  RC_ASSERT(summary.completed);
  double scale = std::abs(summary.energy.input);
  for (const Oscillator& b : row.bodies) scale += 0.5 * b.stiffness * b.displacement * b.displacement + 0.5 * b.mass * b.velocity * b.velocity;
  RC_LOG() << " balance " << summary.energy.balance_error() << " contact " << summary.energy.contact << " of " << scale << "\n";
  RC_ASSERT(summary.accumulations.plastic == 0);
  RC_ASSERT(summary.accumulations.largest_bounce < 1e-13);  // [m], of gaps and displacements below 1 m
  RC_ASSERT(summary.max_penetration < 1e-9);
  RC_ASSERT(summary.energy.contact > -1e-10 * scale);
  RC_ASSERT(std::abs(summary.energy.balance_error()) <= 1e-9 * scale);
  RC_ASSERT(summary.max_complementarity_error < 1e-9);
  for (const State& state : recorder.states) {
    const VectorX gap = model.contacts.jacobian * state.displacement + model.contacts.initial_gap;
    RC_ASSERT(gap.minCoeff() > -1e-9);
    RC_ASSERT(state.impulse.size() == 0 || state.impulse.minCoeff() >= -1e-9 * (1 + state.impulse.maxCoeff()));
  }
  const double momentum = momentum_error(row, model, recorder.states);
  RC_LOG() << "momentum " << momentum << "\n";
  RC_ASSERT(momentum < 1e-9);
}

}  // namespace

TEST_CASE("exact: a slow approach that nothing pushes is an impact with its e, and no end of an accumulation") {
  ModelDescription d;
  const double slow = 5e-9, e = 0.6;  // [m/s]: beside an impact at 1 m/s
  d.structures = {oscillator(0, {1, 0, 0, 0, 1}), oscillator(1, {1, 0, 0}), oscillator(2, {1, 0, 0, 0, slow}), oscillator(3, {1, 0, 0})};
  d.contacts = {contact_of(0, 1, 0.01, e), contact_of(2, 3, 1e-9, e)};
  const Model model = build(d);
  AnalysisOptions options;
  options.scheme = "exact";
  options.dt = 0.1;
  options.duration = 0.4;
  Simulation simulation(model, options);
  const Summary summary = simulation.run({});
  REQUIRE(summary.impacts.size() == 2);
  CHECK(summary.accumulations.ended == 0);
  const VectorX& v = simulation.state().velocity;
  CHECK((v[3] - v[2]) / slow == doctest::Approx(e).epsilon(1e-9));
  CHECK(v[1] - v[0] == doctest::Approx(e).epsilon(1e-14));
}

TEST_CASE("exact: a light mass squeezed between heavy ones ends in their common velocity while a neighbour that touches leaves") {
  ModelDescription d;
  const double heavy = 1000, light = 1e-3, fast = 1e-3;
  d.structures = {oscillator(0, {10, 0, 0, 0, -10 * fast}), oscillator(1, {heavy, 0, 0, 0, fast}), oscillator(2, {light, 0, 0, 0, -2 * fast}),
                  oscillator(3, {heavy / 2, 0, 0, 0, -fast})};
  d.contacts = {contact_of(0, 1, 0, 0.5), contact_of(1, 2, 0, 0.05), contact_of(2, 3, 0, 0.05)};
  const Model model = build(d);
  for (const char* scheme : {"exact", "event-split"}) {
    CAPTURE(scheme);
    AnalysisOptions options;
    options.scheme = scheme;
    options.dt = 0.1;
    options.duration = 0.4;
    Simulation simulation(model, options);
    const Summary summary = simulation.run({});
    CHECK(summary.accumulations.ended == 1);
    CHECK(summary.accumulations.plastic == 0);
    const VectorX& v = simulation.state().velocity;
    const double common = (heavy / 2 - 2 * light) * fast / (1.5 * heavy + light);
    CHECK(v[0] == doctest::Approx(-10 * fast).epsilon(1e-12));
    for (int i = 1; i < 4; ++i) CHECK(v[i] == doctest::Approx(common).epsilon(1e-9));
  }
}

TEST_CASE("exact: two corners that bounce together come to rest together, whichever rounding lets return first") {
  int most = 0;
  for (int run = 0; run < 400; ++run) {
    ModelDescription d;
    StructureDescription floor = oscillator(0, {700, 4e4 + 37 * run, 0, 0, 0.3});
    floor.nodes.push_back({"2", {}, Vector3(0, 1, 0)});
    floor.supports.push_back({{"2", {}}, {false, true, true, true, true, true}});
    floor.masses.push_back({{"2", {}}, Vector3::Constant(700), Vector3::Zero()});
    SpringDescription spring = floor.springs[0];
    spring.id = "k2";
    spring.node_i = {"2", {}};
    floor.springs.push_back(spring);
    spring.id = "tie";
    spring.node_j = Reference{"1", {}};
    spring.stiffness[0] = 3e7;
    floor.springs.push_back(spring);
    floor.initial_velocities.push_back({{"2", {}}, 0, 0.3});
    d.structures = {floor};
    ContactDescription pair = contact_of(0, -1, 0.01, 0.5);
    d.contacts = {pair};
    pair.a = {"s0.2", {}};
    d.contacts.push_back(pair);
    MotionDescription motion;  // pushes towards the wall
    motion.dt = 0.5;
    motion.acceleration = {-4.0 - 0.001 * run, -4.0, -4.0};
    d.motions = {motion};
    const Model model = build(d);
    AnalysisOptions options;
    options.scheme = "exact";
    options.dt = 1e-3;
    options.duration = 0.5;
    Simulation simulation(model, options);
    const Summary summary = simulation.run({});
    CHECK(summary.accumulations.ended >= 1);
    CHECK(summary.accumulations.plastic == 0);
    most = std::max(most, static_cast<int>(summary.impacts.size()));
  }
  CHECK(most < 100);
}

TEST_CASE("exact: random rows of masses never overlap, never gain energy, and keep the balance of momentum") {
  CHECK(rc::check([] {  // a hundred times
    for (int row = 0; row < 5; ++row) check_run(random_row(*rc::gen::element(0.0, number(0, 0.99), number(0, 0.99))));
  }));
}
