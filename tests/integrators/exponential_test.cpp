// The scheme exponential: against exact where nothing is nonlinear, against Moreau-Jean at small steps where something is, its order
// across impacts, its guards and its refusals.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "integrators/exponential.hpp"
#include "output/sample_clock.hpp"
#include "tests/integrators/oscillators.hpp"
#include "tests/integrators/runs.hpp"

using namespace nsframe;
using namespace nsframe::test;

TEST_CASE("exponential: a linear scene moves as the exact scheme says") {
  ModelDescription d = linear_oscillator(4600, 2.11e6, 0.005, -0.024);
  d.structures.push_back(linear_oscillator(3500, 5.31e6, 0.005).structures[0]);
  d.structures[1].name = "t";
  ContactDescription c = wall("s.1", 0.02, 0.6);
  c.b = Reference{"t.1", {}};
  d.contacts = {c};
  const Run exact = completed(d, by_scheme("exact", 1e-2, 2)), ours = completed(d, by_scheme("exponential", 1e-2, 2));
  CHECK(ours.summary.impacts.size() == 3);
  CHECK(difference(ours, exact) < 1e-12);
  CHECK(ours.summary.evaluations == 200);
}

TEST_CASE("exponential: second order across impacts of yielding masses, to the limit of Moreau-Jean") {
  const UniaxialLaw laws[] = {Steel02{8e3, 2e6, 0.05}, Hardening{2e6, 8e3, 0, 1e5}};
  for (const UniaxialLaw& law : laws) {
    const ModelDescription d = yielding_masses(law);
    const Run fine = completed(d, by_scheme("exponential", 1.25e-5, 0.4));
    REQUIRE_FALSE(fine.summary.impacts.empty());
    const double coarse = difference(completed(d, by_scheme("exponential", 8e-4, 0.4)), fine),
                 finer = difference(completed(d, by_scheme("exponential", 1e-4, 0.4)), fine);
    CAPTURE(coarse);
    CAPTURE(finer);
    CHECK(std::log(coarse / finer) / std::log(8.0) > 1.8);
    // Moreau-Jean is of first order: its limit, by extrapolation of two runs
    const Run a = completed(d, by_scheme("moreau-jean", 5e-5, 0.4)), b = completed(d, by_scheme("moreau-jean", 1.25e-5, 0.4));
    CHECK(difference(fine, b) < 1.2 * difference(a, b) + 1e-7);
    CHECK(difference(a, fine) > 20 * finer);
    CHECK(fine.summary.worst_balance_error < 1e-6);
  }
}

TEST_CASE("exponential: fiber members with DOFs without mass, displacement- and force-based") {
  for (const ElementKind kind : {ElementKind::displacement_beam, ElementKind::force_beam}) {
    for (const Geometry geometry : {Geometry::linear, Geometry::p_delta, Geometry::corotational}) {
      const ModelDescription d = fiber_pair(Steel02{235e6, 210e9, 0.02}, kind, 4, geometry);
      const Run fine = completed(d, by_scheme("exponential", 5e-5, 0.1)), reference = completed(d, by_scheme("moreau-jean", 5e-5, 0.1));
      CAPTURE(static_cast<int>(kind));
      CAPTURE(static_cast<int>(geometry));
      REQUIRE_FALSE(fine.summary.impacts.empty());
      const double size = fine.states.back().displacement.cwiseAbs().maxCoeff();
      CHECK(size > 0.02);
      CHECK(difference(fine, reference) < 3e-3 * size);  // Moreau-Jean is of first order
      CHECK(difference(completed(d, by_scheme("exponential", 2e-4, 0.1)), fine) < 5e-3 * size);  // four times the step
      CHECK(fine.summary.worst_balance_error < 1e-5);
      // a second evaluation only where what has no mass has not come to rest
      CHECK(fine.summary.evaluations <= 2250);
    }
  }
}

TEST_CASE("exponential: what has no mass is followed where yielding surrounds it") {
  // a massless node between a yielding spring and a softer elastic one: one evaluation leaves two thirds of an error there
  ModelDescription d = single_mass(1000, 0, 2);
  StructureDescription& s = d.structures[0];
  s.nodes.push_back(node("2", 0, 0, 1));
  s.supports.push_back(fixed("2", {false, true, true, true, true, true}));
  d.materials = {{"law", {}, Steel02{8e3, 2e6, 0.02}}};
  SpringDescription lower = ground_spring("a", "2", Vector6::Zero()), upper = ground_spring("b", "2", 1e6 * Vector6::Unit(0));
  lower.law[0] = Reference{"law", {}};
  upper.node_j = Reference{"1", {}};
  s.springs = {lower, upper};
  const Run ours = completed(d, by_scheme("exponential", 1e-3, 1)), reference = completed(d, by_scheme("moreau-jean", 1e-4, 1));
  double most = 0;
  for (const State& state : ours.states) most = std::max(most, state.displacement.cwiseAbs().maxCoeff());
  CHECK(most > 0.02);
  CHECK(difference(ours, reference) < 2e-3 * most);
  CHECK(ours.summary.evaluations > 1010);
}

TEST_CASE("exponential: accuracy is met, with work where something yields") {
  const ModelDescription d = yielding_masses(Steel02{8e3, 2e6, 0.05});
  const Run fine = completed(d, by_scheme("exponential", 5e-6, 0.4));
  double peak = 0;
  for (const State& state : fine.states) peak = std::max(peak, state.displacement.cwiseAbs().maxCoeff());
  long last = 0;
  for (const double accuracy : {1e-3, 1e-4, 1e-5}) {
    const Run ours = completed(d, by_scheme("exponential", 4e-3, 0.4, accuracy));
    CAPTURE(accuracy);
    CHECK(difference(ours, fine) < accuracy * peak);
    CHECK(ours.summary.evaluations > last);
    last = ours.summary.evaluations;
  }
}

namespace {

// Keeps states, of which histories are to be read at a rate [Hz], and notes which.
class ReadsSometimes : public Recorder {
 public:
  explicit ReadsSometimes(double rate) : clock_(rate) {}
  std::vector<std::size_t> read;
  void start(const Model& model, const State& state) override {
    clock_.start(state.time);
    Recorder::start(model, state);
  }
  void step(const State& before, const State& after, const StepReport& report, const Energy& energy) override {
    if (clock_.due(before.time, after.time)) read.push_back(states.size());
    Recorder::step(before, after, report, energy);
  }
  double next_history_time() const override { return clock_.next_time(); }

 private:
  SampleClock clock_;
};

// Largest difference of the histories of two states, over the largest entry.
double behind(const State& state, const State& reference) {
  return (state.history - reference.history).cwiseAbs().maxCoeff() / reference.history.cwiseAbs().maxCoeff();
}

}  // namespace

TEST_CASE("exponential: with an accuracy, one evaluation serves many short steps, and histories are those of the steps at which they are read") {
  const ModelDescription d = yielding_masses(Steel02{8e3, 2e6, 0.05});
  const Run fine = completed(d, by_scheme("exponential", 5e-6, 0.4));
  double peak = 0;
  for (const State& state : fine.states) peak = std::max(peak, state.displacement.cwiseAbs().maxCoeff());
  const Model model = build(d);
  for (const double rate : {1.0, 300.0, 3100.0, 9999.0}) {  // steps are at 10 kHz
    CAPTURE(rate);
    Simulation simulation(model, by_scheme("exponential", 1e-4, 0.4, 1e-3));
    ReadsSometimes reader(rate);
    Run ours;
    ours.summary = simulation.run({&reader});
    ours.states = reader.states;
    CHECK(difference(ours, fine) < 1e-3 * peak);
    CHECK(ours.summary.worst_balance_error < 1e-4);
    CHECK(ours.summary.evaluations < (rate < 1000 ? 2000 : 5000));
    const std::size_t stride = (fine.states.size() - 1) / (ours.states.size() - 1);
    CHECK(behind(ours.states.back(), fine.states.back()) < 1e-3);
    CHECK(reader.read.size() >= static_cast<std::size_t>(0.39 * rate));
    // but at a reversal, which one of the two may have met and the other not yet
    const auto wrong = std::count_if(reader.read.begin(), reader.read.end(), [&](std::size_t i) { return behind(ours.states[i], fine.states[i * stride]) > 1e-3; });
    CHECK(static_cast<double>(wrong) <= 0.01 * static_cast<double>(reader.read.size()));
  }
}

namespace {

// Spectral radius of a step of one undamped mode that turns by `angle`, when nonlinear elements with `share` of its stiffness keep the
// part `kept` of theirs: above 1 it grows (theory.md, 236). `shown`: elements see it where it would rest.
double growth(double angle, double share, double kept, bool shown) {
  const double square = angle * angle;
  const StepCoefficients c = step_coefficients(square, 0, 1);
  const auto A = static_cast<double>(c.A), B = static_cast<double>(c.B), L = static_cast<double>(c.L), R = static_cast<double>(c.R);
  const double change = (kept - 1) * share * square;  // r = change * x
  Eigen::Matrix4d step;                                // of x, x', r, rate of r, in steps
  for (int i = 0; i < 4; ++i) {
    const Eigen::Vector4d from = Eigen::Vector4d::Unit(i);
    const double x = A * from[0] + B * from[1] - L * from[2], y = -square * B * from[0] + A * from[1] - B * from[2];
    const double r = change * (shown ? -(from[2] + from[3]) / square : x - R * from[3]), rate = r - from[2];
    step.col(i) << x - R * rate, y - L * rate, r, rate;
  }
  return Eigen::EigenSolver<MatrixX>(MatrixX(step), false).eigenvalues().cwiseAbs().maxCoeff();
}

}  // namespace

TEST_CASE("exponential: modes that turn by no more than 3 rad in a part do not grow while elements yield, others do not when shown at rest") {
  double beyond = 0;
  for (const double share : {1e-3, 0.1, 0.5, 1.0}) {
    for (const double kept : {0.01, 0.25, 0.5, 0.75, 0.99}) {
      for (double angle = 0.05; angle <= 20; angle += 0.05) {
        CAPTURE(angle);
        CAPTURE(share);
        CAPTURE(kept);
        if (angle <= farthest_turn) CHECK(growth(angle, share, kept, false) < 1 + 1e-7);
        CHECK(growth(angle, share, kept, true) < 1 + 1e-7);
        beyond = std::max(beyond, growth(angle, share, kept, false));
      }
    }
  }
  CHECK(beyond > 1.05);
}

TEST_CASE("exponential: fast modes that hardly move are shown to the elements at rest, at whole steps") {
  const ModelDescription d = fiber_pair(Steel02{235e6, 210e9, 0.02}, ElementKind::displacement_beam, 4);
  const double dt = 4e-3;
  const Run ours = completed(d, by_scheme("exponential", dt, 0.8)), fine = completed(d, by_scheme("exponential", 5e-5, 0.8));
  double peak = 0;
  for (const State& state : fine.states) peak = std::max(peak, state.displacement.cwiseAbs().maxCoeff());
  CHECK(difference(ours, fine) < 0.03 * peak);
  CHECK(!ours.summary.impacts.empty());
  CHECK(ours.summary.evaluations < 1.5 * 0.8 / dt);
  const Model model = build(d);
  const Simulation simulation(model, by_scheme("exponential", dt, 0.8));
  bool said = false;
  for (const std::string& line : simulation.scheme().describe()) said = said || line.find("where they would rest: these turn by more than 3 rad") != std::string::npos;
  CHECK(said);
}

TEST_CASE("exponential: a fast mode at rest is shown under the force of sustained contact, too") {
  // a buffer of 5 kg on a spring that yields is pressed against a wall; it turns by 10 rad a step
  ModelDescription d = single_mass(1000);
  StructureDescription& s = d.structures[0];
  s.nodes.push_back(node("2", 1, 0, 0));
  s.supports.push_back(fixed("2", {false, true, true, true, true, true}));
  s.masses.push_back(mass("2", 5));
  d.materials = {{"buffer", {}, Hardening{5e6, 5e3, 0, 5e5}}};
  SpringDescription buffer = ground_spring("b", "1", Vector6::Zero());
  buffer.node_j = Reference{"2", {}};
  buffer.law[0] = Reference{"buffer", {}};
  s.springs = {ground_spring("k", "1", 1e5 * Vector6::Unit(0)), buffer};
  s.springs[0].damping[0] = 6e3;
  MotionDescription motion;
  motion.dt = 0.5;
  motion.acceleration = {0, -10, -20, -20, -20, -20, -20};
  d.motions = {motion};
  d.contacts = {wall("s.2", 0.02, 0)};
  const Run ours = completed(d, by_scheme("exponential", 1e-2, 3)), fine = completed(d, by_scheme("exponential", 1e-4, 3));
  const double pressed = fine.states.back().displacement[0] - fine.states.back().displacement[1];
  CHECK(pressed > 0.01);  // the buffer yields, at 1 mm
  CHECK(std::abs(ours.states.back().displacement[0] - fine.states.back().displacement[0]) < 0.01 * pressed);
}

TEST_CASE("exponential: steps are parted where a fast mode yields, and where a member stiffens") {
  SUBCASE("fast") {  // a link at 600 Hz that yields: three radians a millisecond and more
    const ModelDescription d = nonlinear_oscillator(1, Steel02{50, 1.5e7, 0.01}, 0, 0.1);
    const Run ours = completed(d, by_scheme("exponential", 1e-3, 0.1)), fine = completed(d, by_scheme("exponential", 2e-5, 0.1));
    double peak = 0;
    for (const State& state : fine.states) peak = std::max(peak, std::abs(state.displacement[0]));
    CHECK(ours.summary.rejected_parts > 0);
    CHECK(difference(ours, fine) < 0.05 * peak);
  }
  SUBCASE("stiffening") {  // a second spring, fifty times stiffer, behind a gap of 1 cm
    ModelDescription d = nonlinear_oscillator(1000, ElasticPPGap{5e6, 1e9, 0.01, 0}, 0, 1);
    d.structures[0].springs.push_back(ground_spring("soft", "1", 1e5 * Vector6::Unit(0)));
    d.structures[0].springs.back().id = "soft";
    const Run ours = completed(d, by_scheme("exponential", 2e-2, 1)), fine = completed(d, by_scheme("moreau-jean", 5e-5, 1));
    double peak = 0;
    for (const State& state : fine.states) peak = std::max(peak, std::abs(state.displacement[0]));
    CHECK(ours.summary.rejected_parts > 0);
    CHECK(difference(ours, fine) < 0.1 * peak);
    CHECK(difference(completed(d, by_scheme("exponential", 1e-3, 1, 1e-4)), fine) < 1e-3 * peak);
  }
}

TEST_CASE("exponential: a yielding column pressed against a wall neither drifts nor opens") {
  ModelDescription d = nonlinear_oscillator(1000, Steel02{8e3, 2e6, 0.05});
  MotionDescription motion;
  motion.dt = 0.5;
  motion.acceleration = {0, -12, -12, -12, 0, 5, 5};
  d.motions = {motion};
  d.contacts = {wall("s.1", 0.02, 0.3)};
  const Run ours = completed(d, by_scheme("exponential", 1e-3, 3));
  double drift = 0, back = 0;
  int held = 0;
  for (const State& state : ours.states) {
    if (state.time > 1 && state.time < 1.5) {
      drift = std::max(drift, std::abs(state.displacement[0] - 0.02));
      ++held;
    }
    back = std::max(back, state.displacement[0]);
  }
  CHECK(held > 400);
  CHECK(drift < 1e-12);
  CHECK(back < 0.02 + 1e-12);
  CHECK(ours.states.back().displacement[0] < 0.015);
}

TEST_CASE("exponential: a run that goes on from a snapshot has the same bits") {
  const Model model = build(fiber_pair(Steel02{235e6, 210e9, 0.02}, ElementKind::displacement_beam, 4));
  const AnalysisOptions o = by_scheme("exponential", 1e-3, 0.1, 1e-3);
  check_resumed(model, o, 43);
}

TEST_CASE("exponential: what it cannot take is refused by name") {
  const auto refusal = [](const ModelDescription& d) -> std::string {
    try {
      const Model model = build(d);
      Simulation simulation(model, by_scheme("exponential", 1e-3, 1));
    } catch (const InputError& error) {
      return error.what();
    }
    return "taken";
  };
  ModelDescription rate = nonlinear_oscillator(1000, Viscous{1e3, 0.5}, 0, 1);
  rate.structures[0].springs.push_back(ground_spring("stiff", "1", 1e6 * Vector6::Unit(0)));
  CHECK(refusal(rate).find("rate of deformation") != std::string::npos);
  ModelDescription massless = nonlinear_oscillator(1000, Steel02{8e3, 2e6, 0.02});
  StructureDescription& s = massless.structures[0];
  s.nodes.push_back(node("2", 0, 0, 1));
  s.supports.push_back(fixed("2", {false, true, true, true, true, true}));
  SpringDescription tip = ground_spring("tip", "2", 1e6 * Vector6::Unit(0));
  tip.node_j = Reference{"1", {}};
  s.springs.push_back(tip);
  massless.contacts = {wall("s.2", 0.01, 0.5)};
  CHECK(refusal(massless).find("meets DOFs without mass") != std::string::npos);
}
