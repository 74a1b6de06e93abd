// Dampers whose force depends on the rate: against dashpots, closed forms and OpenSees; energy, checkpoints, errors.
#include <doctest/doctest.h>

#include <cmath>

#include "tests/integrators/oscillators.hpp"
#include "tests/support/reference_data.hpp"

using namespace nsframe;
using namespace nsframe::test;

namespace {

ModelDescription damped(ModelDescription d, const UniaxialLaw& law) {
  d.materials.push_back({"damper", {}, law});
  SpringDescription spring = ground_spring("d", "1", Vector6::Zero());
  spring.law[0] = Reference{"damper", {}};
  d.structures[0].springs.push_back(spring);
  return d;
}

MotionDescription sine(double amplitude, double w, double duration) {
  MotionDescription motion;
  motion.dt = 1e-4;
  for (int i = 0; i * motion.dt <= duration + 1e-9; ++i) motion.acceleration.push_back(-amplitude * std::sin(w * i * motion.dt));
  return motion;
}

// The same mass on a Steel01 spring and a damper, hit by a wall.
ModelDescription hitting(const UniaxialLaw& law) {
  ModelDescription d = damped(nonlinear_oscillator(1000, Steel01{8e3, 40e3, 0.05}, 0, 2), law);
  d.contacts = {wall("s.1", 0.05, 0.5)};
  d.motions = {sine(4, 9, 3)};
  return d;
}

}  // namespace

TEST_CASE("a Viscous law of exponent 1 is a dashpot") {
  const double m = 900, k = 40e3, xi = 0.08;
  for (const double theta : {0.5, 1.0}) {
    const AnalysisOptions o = options(theta, 2e-3, 2);
    const Run dashpot = run(linear_oscillator(m, k, xi, 0.03), o);
    const Run law = run(damped(linear_oscillator(m, k, 0, 0.03), Viscous{2 * xi * std::sqrt(k * m), 1}), o);
    double worst = 0;
    for (std::size_t i = 0; i < law.states.size(); ++i)
      worst = std::max(worst, std::abs(law.states[i].displacement[0] - dashpot.states[i].displacement[0]));
    CHECK(worst < 1e-8 * 0.03);  // Newton's tolerance
    CHECK(law.summary.energy.damping == doctest::Approx(dashpot.summary.energy.damping).epsilon(1e-8));
    CHECK(law.summary.worst_balance_error < 1e-8);
  }
}

TEST_CASE("a mass on a power-law dashpot slows down as its equation says, to second order") {
  const double m = 700, C = 900, v0 = 1.5, T = 0.4;
  for (const double alpha : {0.5, 2.0}) {
    CAPTURE(alpha);
    ModelDescription d = damped(single_mass(m, 0, v0), Viscous{C, alpha});
    d.structures[0].may_move_freely = true;
    // m v' = -C v^alpha
    const double exact = std::pow(std::pow(v0, 1 - alpha) - (1 - alpha) * C / m * T, 1 / (1 - alpha));
    double error[2];
    for (const int i : {0, 1}) {
      AnalysisOptions o = options(0.5, 0.02 / (1 + i), T);
      o.newton_tolerance = 1e-12;
      error[i] = std::abs(run(d, o).states.back().velocity[0] - exact);
    }
    CHECK(error[0] / error[1] == doctest::Approx(4).epsilon(0.05));
    CHECK(error[1] < 1e-4 * v0);
  }
}

TEST_CASE("oscillators with dampers follow OpenSees") {
  const std::tuple<const char*, UniaxialLaw, double> cases[] = {
      // the last number: of the peaks; OpenSees' power law jumps at rest, ours is linear below minVel
      {"linear", Viscous{2e3, 1}, 2e-5},
      {"power", Viscous{3e3, 0.4}, 1e-4},
      {"maxwell", ViscousDamper{60e3, 3e3, 1}, 2e-5},
      {"maxwell_power", ViscousDamper{60e3, 3e3, 0.4}, 2e-5},
      // OpenSees lets the pins close at the end of a step
      {"maxwell_gap", ViscousDamper{60e3, 3e3, 1, 0.004}, 2e-4},
      {"maxwell_power_gap", ViscousDamper{60e3, 3e3, 0.4, 0.004}, 2e-4},
  };
  for (const auto& [name, law, tolerance] : cases) {
    CAPTURE(std::string(name));
    ModelDescription d = damped(linear_oscillator(1000, 40e3, 0), law);
    d.motions = {sine(4, 9, 3)};
    const Run result = run(d, options(0.5, 5e-4, 3));
    double worst = 0, peak = 0;
    for (const auto& row : read_reference(std::string("damper_") + name)) {
      const auto step = static_cast<std::size_t>(std::lround(row[0] / 5e-4));
      worst = std::max(worst, std::abs(result.states[step].displacement[0] - row[1]));
      peak = std::max(peak, std::abs(row[1]));
    }
    CHECK(worst < tolerance * peak);
    CHECK(result.summary.halved_steps == 0);
    CHECK(result.summary.worst_balance_error < 1e-7);
    CHECK(result.summary.energy.damping > 0);
  }
}

TEST_CASE("the energy that a damper takes out of an oscillator counts as damping") {
  for (const UniaxialLaw& law : {UniaxialLaw(Viscous{2e3, 0.3}), UniaxialLaw(ViscousDamper{90e3, 2e3, 0.5})}) {
    const double k = 40e3, x0 = 0.04;
    const Run result = run(damped(linear_oscillator(1000, k, 0, x0), law), options(0.5, 1e-3, 8));
    const Energy& energy = result.summary.energy;
    CHECK(result.summary.worst_balance_error < 1e-8);
    // what is left is in the mass, its spring and that of the damper (history: strain, force)
    const State& last = result.states.back();
    const double force = last.history[1], x = last.displacement[0], v = last.velocity[0];
    const double left = 0.5 * 1000 * v * v + 0.5 * k * x * x + (std::holds_alternative<ViscousDamper>(law) ? force * force / 2 / 90e3 : 0);
    CHECK(left < 0.05 * 0.5 * k * x0 * x0);
    CHECK(energy.damping == doctest::Approx(0.5 * k * x0 * x0 - left).epsilon(1e-8));
    CHECK(std::abs(energy.numerical) < 1e-9 * energy.damping);
  }
}

TEST_CASE("with impacts and yielding the energy balance holds at any theta") {
  for (const double theta : {0.5, 0.7, 1.0}) {
    for (const UniaxialLaw& law : {UniaxialLaw(Viscous{2e3, 0.3}), UniaxialLaw(ViscousDamper{90e3, 2e3, 0.5})}) {
      const Run result = run(hitting(law), options(theta, 1e-3, 3));
      CHECK(result.summary.completed);
      CHECK_FALSE(result.summary.impacts.empty());
      CHECK(result.summary.worst_balance_error < 1e-7);
      CHECK(result.summary.energy.damping > 0);
    }
  }
}

TEST_CASE("a run with dampers goes on from a snapshot with the same bits") {
  for (const UniaxialLaw& law : {UniaxialLaw(Viscous{2e3, 0.3}), UniaxialLaw(ViscousDamper{90e3, 2e3, 0.5})}) {
    const Model model = build(hitting(law));
    const AnalysisOptions o = options(1, 1e-3, 3);
    std::vector<Snapshot> kept;
    RunControl control;
    control.snapshot_interval = 1e-12;
    control.keep_snapshot = [&kept](const Snapshot& snapshot) { kept.push_back(snapshot); };
    Simulation whole(model, o);
    whole.run({}, control);
    RunControl again;
    again.resume = &kept[kept.size() / 2];
    Simulation resumed(model, o);
    resumed.run({}, again);
    CHECK(resumed.state().displacement == whole.state().displacement);
    CHECK(resumed.state().velocity == whole.state().velocity);
    CHECK(resumed.state().history == whole.state().history);
  }
}

TEST_CASE("dampers carry nothing in statics") {
  ModelDescription d = damped(linear_oscillator(1000, 40e3, 0), ViscousDamper{90e3, 2e3, 0.5});
  d.gravity.acceleration = {3, 0, 0};
  const Model model = build(d);
  Simulation simulation(model, options(1, 1e-3, 1));
  CHECK(simulation.state().displacement[0] == doctest::Approx(3000 / 40e3).epsilon(1e-12));
  CHECK(simulation.modes()[0].modes.circular_frequency[0] == doctest::Approx(std::sqrt(40.0)).epsilon(1e-12));
}

TEST_CASE("a damper as a truss is one of force C A (v/L)^alpha, in every geometry") {
  const double C = 4e7, A = 2e-3, L = 1.5, alpha = 0.6;
  for (const Geometry geometry : {Geometry::linear, Geometry::p_delta, Geometry::corotational}) {
    ModelDescription d = linear_oscillator(1000, 40e3, 0, 0.04);
    d.materials = {{"damper", {}, Viscous{C, alpha}}};
    StructureDescription& s = d.structures[0];
    s.nodes.push_back(node("2", -L, 0, 0));
    s.supports.push_back(fixed("2"));
    s.elements = {bar("d", "2", "1", "damper", A)};
    s.elements[0].geometry = geometry;
    const Run truss = run(d, options(0.5, 1e-3, 2));
    const Run spring = run(damped(linear_oscillator(1000, 40e3, 0, 0.04), Viscous{C * A * std::pow(L, -alpha), alpha}),
                           options(0.5, 1e-3, 2));
    // minVel is a strain rate in the one and a velocity in the other
    CHECK(truss.states.back().displacement[0] == doctest::Approx(spring.states.back().displacement[0]).epsilon(1e-5));
    CHECK(truss.summary.worst_balance_error < 1e-7);
    CHECK(truss.summary.energy.damping == doctest::Approx(spring.summary.energy.damping).epsilon(1e-5));
  }
}

TEST_CASE("a rate-dependent law in a fiber or inside another law is an error that names the place") {
  ModelDescription d = damped(single_mass(1000), Viscous{1e3, 1});
  d.structures[0].may_move_freely = true;
  FiberSectionDescription section;
  section.fibers = {{0, 0, 1e-4, {"damper", at(7)}}};
  section.torsion_stiffness = 1;
  d.sections.resize(1);
  d.sections[0].name = "f";
  d.sections[0].kind = section;
  CHECK(error_of(d).find("s.toml:7:3: error: section 'f': the stress of material 'damper' depends on the rate of strain") !=
        std::string::npos);
  d.sections.clear();
  Parallel both;
  both.materials = {InnerLaw{{"damper", at(9)}, nullptr}};
  d.materials.push_back({"both", at(8), both});
  CHECK(error_of(d).find("s.toml:9:3: error: the stress of material 'damper' depends on the rate of strain") != std::string::npos);
}
