// Rayleigh damping on initial, committed and current stiffness: a yielding column against OpenSees' rayleigh (betaKinit,
// betaKcomm, betaK) under sinusoidal base motion, and the energy balance.
#include <doctest/doctest.h>

#include <cmath>

#include "integrators/simulation.hpp"
#include "tests/integrators/oscillators.hpp"
#include "tests/support/reference_data.hpp"

using namespace nsframe;
using namespace nsframe::test;

namespace {

class Top : public Observer {
 public:
  void step(const State& before, const State& after, const StepReport&, const Energy&) override {
    const double u = after.displacement[0];
    most = std::max(most, u);
    least = std::min(least, u);
    if (before.time < 1 - 1e-9 && after.time >= 1 - 1e-9) at_one = u;
    last = u;
  }
  double most = 0, least = 0, at_one = 0, last = 0;
};

ModelDescription yielding_column(DampingStiffness stiffness) {
  ModelDescription d;
  d.materials = {{"steel", {}, Steel01{235e6, 210e9, 0.01}}};
  FiberSectionDescription section;
  for (const auto& row : read_reference("hea140_fibers")) section.fibers.push_back({row[0], row[1], row[2], {"steel", {}}});
  section.torsion_stiffness = 210e9 / 2.6 * 8.13e-8;
  d.sections.resize(1);
  d.sections[0].name = "HEA140";
  d.sections[0].kind = section;
  StructureDescription s;
  s.name = "c";
  s.nodes = {node("1", 0, 0, 0), node("2", 0, 0, 2.5)};
  s.supports = {fixed("1"), fixed("2", {false, true, false, true, false, true})};
  s.elements = {beam("e", "1", "2", "HEA140", ElementKind::displacement_beam)};
  s.masses = {mass("2", 5000)};
  s.damping.kind = DampingKind::rayleigh;
  s.damping.stiffness_factor = 0.01;
  s.damping.stiffness = stiffness;
  d.structures = {s};
  MotionDescription motion;
  motion.dt = 1e-3;
  for (int i = 0; i <= 2000; ++i) motion.acceleration.push_back(4 * std::sin(2 * pi * 1.45 * i * motion.dt));
  d.motions = {motion};
  return d;
}

Top run(DampingStiffness stiffness, double dt) {
  const Model model = build(yielding_column(stiffness));
  AnalysisOptions analysis = options(0.5, dt, 2);
  analysis.newton_tolerance = 1e-10;
  Simulation simulation(model, analysis);
  Top top;
  const Summary summary = simulation.run({&top});
  CHECK(summary.completed);
  CHECK(summary.worst_balance_error < 1e-8);  // a hundred times Newton's tolerance, over thousands of steps
  return top;
}

// What OpenSees' figures at steps of 0.5 and 0.25 ms tend to (its error is of first order with betaK and betaKcomm).
constexpr double opensees_limit[4] = {0.1398671, -0.0815072, 0.0135134, 0.0255581};

}  // namespace

TEST_CASE("stiffness-proportional damping on the initial stiffness is OpenSees' betaKinit") {
  const Top top = run(DampingStiffness::initial, 2.5e-4);
  CHECK(top.most == doctest::Approx(0.130364074).epsilon(2e-6));
  CHECK(top.least == doctest::Approx(-0.0794059317).epsilon(2e-6));
  CHECK(top.at_one == doctest::Approx(-0.00475329865).epsilon(2e-4));
  CHECK(top.last == doctest::Approx(0.0278484175).epsilon(2e-5));
}

TEST_CASE("damping on the committed and on the current stiffness tends to OpenSees' betaKcomm and betaK") {
  for (const DampingStiffness stiffness : {DampingStiffness::committed, DampingStiffness::current}) {
    CAPTURE(int(stiffness));
    const Top coarse = run(stiffness, 5e-4), fine = run(stiffness, 2.5e-4);
    // the error halves with the step: twice the finer less the coarser result is of second order
    CHECK(2 * fine.most - coarse.most == doctest::Approx(opensees_limit[0]).epsilon(2e-5));
    CHECK(2 * fine.least - coarse.least == doctest::Approx(opensees_limit[1]).epsilon(2e-5));
    CHECK(2 * fine.at_one - coarse.at_one == doctest::Approx(opensees_limit[2]).epsilon(2e-4));
    CHECK(2 * fine.last - coarse.last == doctest::Approx(opensees_limit[3]).epsilon(2e-4));
    CHECK(std::abs(fine.most - opensees_limit[0]) < 1e-4);
  }
}

TEST_CASE("of a linear model, all three stiffnesses damp alike") {
  ModelDescription d = linear_oscillator(100, 1e4, 0, 0.1);
  d.structures[0].damping.kind = DampingKind::rayleigh;
  d.structures[0].damping.stiffness_factor = 0.01;
  std::vector<double> ends;
  for (const DampingStiffness stiffness : {DampingStiffness::initial, DampingStiffness::committed, DampingStiffness::current}) {
    d.structures[0].damping.stiffness = stiffness;
    const Model model = build(d);
    Simulation simulation(model, options(0.5, 1e-3, 1));
    CHECK(simulation.modes()[0].damping_ratio[0] == doctest::Approx(0.05).epsilon(1e-9));
    CHECK(simulation.run({}).completed);
    ends.push_back(simulation.state().displacement[0]);
  }
  CHECK(ends[1] == ends[0]);
  CHECK(ends[2] == ends[0]);
}

TEST_CASE("a run with tangent damping goes on from its checkpoint with the same bits") {
  for (const DampingStiffness stiffness : {DampingStiffness::committed, DampingStiffness::current}) {
    const Model model = build(yielding_column(stiffness));
    AnalysisOptions whole = options(0.5, 1e-3, 1.2), part = options(0.5, 1e-3, 0.6);
    Simulation one(model, whole), first(model, part), second(model, whole);
    CHECK(one.run({}).completed);
    Snapshot kept;
    RunControl keeping;
    keeping.keep_snapshot = [&](const Snapshot& snapshot) { kept = snapshot; };
    CHECK(first.run({}, keeping).completed);
    RunControl resuming;
    resuming.resume = &kept;
    CHECK(second.run({}, resuming).completed);
    CHECK(second.state().displacement == one.state().displacement);
    CHECK(second.state().velocity == one.state().velocity);
  }
}
