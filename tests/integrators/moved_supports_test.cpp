// Supports that move by prescribed histories, all together or as a wave reaches them.
#include <doctest/doctest.h>

#include <functional>

#include "integrators/reduced_simulation.hpp"
#include "tests/integrators/oscillators.hpp"

using namespace nsframe;
using namespace nsframe::test;

namespace {

// A pulse whose displacement comes back to rest far from zero, sampled every 10 ms.
MotionDescription ground_pulse(double peak = 3) {
  MotionDescription motion;
  motion.dt = 0.01;
  for (int i = 0; i <= 80; ++i) motion.acceleration.push_back(peak * std::sin(2 * pi * i / 80.0) * std::sin(pi * i / 80.0));
  return motion;
}

GroundMotion pulse_history(const MotionDescription& motion, double start = 0) {
  GroundMotion out;
  out.dt = motion.dt;
  out.acceleration = motion.acceleration;
  out.start = start;
  out.prepare();
  return out;
}

// A mass, node 1, between two supports, nodes 0 and 2, 30 m apart along x; x only. `left`: the law of the left spring, or a stiffness.
ModelDescription bridge(double k_left, double k_right, double m, const std::optional<UniaxialLaw>& left = {}) {
  ModelDescription d = single_mass(m);
  StructureDescription& s = d.structures[0];
  s.nodes = {node("0", 0, 0, 0), node("1", 15, 0, 0), node("2", 30, 0, 0)};
  s.supports = {fixed("0"), fixed("1", {false, true, true, true, true, true}), fixed("2")};
  SpringDescription a = ground_spring("a", "0", k_left * Vector6::Unit(0)), b = ground_spring("b", "1", k_right * Vector6::Unit(0));
  a.node_j = Reference{"1", {}};
  b.node_j = Reference{"2", {}};
  if (left) {
    d.materials = {{"law", {}, *left}};
    a.stiffness.setZero();
    a.law[0] = Reference{"law", {}};
  }
  s.springs = {a, b};
  return d;
}

MotionDescription as_wave(MotionDescription motion, double velocity, std::vector<std::string> supports = {"s.0", "s.2"}) {
  for (const std::string& support : supports) motion.supports.push_back({support, {}});
  motion.wave = WaveDescription{{}, Vector3::UnitX(), velocity};
  return motion;
}

AnalysisOptions in_scheme(const std::string& name, double dt, double duration) {
  AnalysisOptions o = options(0.5, dt, duration);
  o.scheme = name;
  return o;
}

struct Watched {
  Summary summary;
  std::vector<State> states;  // of `model`
  Model model;
  double u(std::size_t step, const std::string& id, int direction = 0) const {
    return model.dofs.expand(states[step].displacement)[full_dof(model, id, direction)];
  }
};

Watched watch(const ModelDescription& d, const AnalysisOptions& o) {
  Watched out;
  out.model = build(d);
  Recorder recorder;
  ReducedSimulation simulation(out.model, o);
  out.summary = simulation.run({&recorder});
  CAPTURE(out.summary.stop_reason);
  REQUIRE(out.summary.completed);
  out.states = std::move(recorder.states);
  return out;
}

// m u'' = f(u, u', t) from rest by Runge and Kutta's method; u at the ends of steps of `dt`.
std::vector<double> runge_kutta(double m, double dt, int steps, int parts, const std::function<double(double, double)>& force) {
  std::vector<double> out{0};
  double u = 0, v = 0, t = 0;
  const double h = dt / parts;
  for (int i = 0; i < steps * parts; ++i) {
    const auto a = [&](double at, double x) { return force(at, x) / m; };
    const double k1 = a(t, u), k2 = a(t + h / 2, u + h / 2 * v), k3 = a(t + h / 2, u + h / 2 * v + h * h / 4 * k1),
                 k4 = a(t + h, u + h * v + h * h / 2 * k2);
    u += h * v + h * h / 6 * (k1 + k2 + k3);
    v += h / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
    t += h;
    if ((i + 1) % parts == 0) out.push_back(u);
  }
  return out;
}

}  // namespace

TEST_CASE("supports that all move together carry a structure as a base motion does") {
  for (const bool yields : {false, true}) {
    ModelDescription base = yields ? fiber_pair(Steel02{235e6, 210e9, 0.01}, ElementKind::displacement_beam, 0)
                                   : fiber_pair(Elastic{210e9}, ElementKind::displacement_beam, 0);
    base.contacts.clear();
    ModelDescription supports = base;
    base.motions = {ground_pulse(9)};
    supports.motions = {ground_pulse(9)};
    supports.motions[0].supports = {{"a.0", {}}, {"b.0", {}}};
    const GroundMotion ground = pulse_history(ground_pulse(9));
    CAPTURE(yields);
    const Watched relative = watch(base, in_scheme("moreau-jean", 0.002, 1)), total = watch(supports, in_scheme("moreau-jean", 0.002, 1));
    REQUIRE(relative.states.size() == total.states.size());
    double difference = 0, peak = 0;
    for (std::size_t i = 0; i < relative.states.size(); i += 5) {
      const double d = ground.displacement_at(relative.states[i].time), rate = ground.velocity_at(relative.states[i].time);
      CHECK(total.u(i, "a.0") == doctest::Approx(d).epsilon(1e-12));
      for (const std::string id : {"a.1", "a.3", "b.2"}) {
        difference = std::max(difference, std::abs(total.u(i, id) - d - relative.u(i, id)));
        peak = std::max(peak, std::abs(relative.u(i, id)));
        const int at = full_dof(total.model, id, 0);
        CHECK(total.model.dofs.expand(total.states[i].velocity)[at] - rate ==
              doctest::Approx(relative.model.dofs.expand(relative.states[i].velocity)[full_dof(relative.model, id, 0)]).epsilon(1e-6));
      }
    }
    CHECK(peak > 0.02);
    CHECK(difference < 1e-6 * peak);  // the tolerance of Newton's method
    CHECK(total.summary.energy.strain == doctest::Approx(relative.summary.energy.strain).epsilon(1e-6));
    CHECK(total.summary.worst_balance_error < 1e-6);
  }
}

TEST_CASE("a mass between two supports follows a wave in every scheme as its equation of motion says") {
  const double k1 = 4e5, k2 = 2.5e5, m = 1000, c = 200;  // c [m/s]: the second support moves 0.15 s later
  ModelDescription d = bridge(k1, k2, m);
  d.motions = {as_wave(ground_pulse(), c)};
  const GroundMotion first = pulse_history(ground_pulse()), second = pulse_history(ground_pulse(), 30 / c);
  const double dt = 0.004;
  const int steps = 400;
  const std::vector<double> expected = runge_kutta(m, dt, steps, 40, [&](double t, double u) {
    return k1 * (first.displacement_at(t) - u) + k2 * (second.displacement_at(t) - u);
  });
  double peak = 0;
  for (const double u : expected) peak = std::max(peak, std::abs(u));
  const auto error = [&](const std::string& name, double step) {
    const Watched run = watch(d, in_scheme(name, step, dt * steps));
    const auto stride = static_cast<std::size_t>(std::lround(dt / step));
    double largest = 0;
    for (std::size_t i = 0; i < expected.size(); ++i) {
      const State& state = run.states[i * stride];
      largest = std::max(largest, std::abs(run.u(i * stride, "s.1") - expected[i]));
      CHECK(run.u(i * stride, "s.0") == doctest::Approx(first.displacement_at(state.time)).epsilon(1e-12));
      CHECK(run.u(i * stride, "s.2") == doctest::Approx(second.displacement_at(state.time)).epsilon(1e-12));
    }
    CHECK(run.summary.worst_balance_error < 1e-9);
    return largest / peak;
  };
  CHECK(error("exact", dt) < 1e-9);  // the rest is Runge and Kutta's
  const double coarse = error("moreau-jean", dt), fine = error("moreau-jean", dt / 4);
  CHECK(coarse < 2e-2);
  CHECK(fine < coarse / 14);  // second order
  const double split = error("event-split", dt), finer = error("event-split", dt / 4);
  CHECK(split < 2e-2);
  CHECK(finer < split / 14);
}

TEST_CASE("after a wave has passed, a mass swings about where its supports have come to rest") {
  // in closed form: at rest again the frame stands off by the wave's displacement, and stresses are those of free vibration
  const double k1 = 4e5, k2 = 2.5e5, m = 1000;
  ModelDescription d = bridge(k1, k2, m);
  d.motions = {as_wave(ground_pulse(), 500)};
  const double away = pulse_history(ground_pulse()).displacement.back();
  CHECK(std::abs(away) > 0.05);
  const Watched run = watch(d, in_scheme("exact", 0.002, 4));
  const double w = std::sqrt((k1 + k2) / m), start = 1.0;
  const auto at = [&](double t) { return static_cast<std::size_t>(std::lround(t / 0.002)); };
  const double drift = pulse_history(ground_pulse()).velocity.back();
  CHECK(std::abs(drift) < 1e-12);
  const double u0 = run.u(at(start), "s.1") - away;
  const double v0 = run.model.dofs.expand(run.states[at(start)].velocity)[full_dof(run.model, "s.1", 0)];
  for (const double t : {1.3, 2.0, 3.1}) {
    CHECK(run.u(at(t), "s.1") - away == doctest::Approx(u0 * std::cos(w * (t - start)) + v0 / w * std::sin(w * (t - start))).epsilon(1e-8));
  }
}

TEST_CASE("the input energy is the work of the supports' reactions") {
  const double k1 = 4e5, k2 = 2.5e5, m = 1000, c = 200, dt = 5e-4;
  for (const bool yields : {false, true}) {
    CAPTURE(yields);
    const Steel01 law{6e3, k1, 0.05};
    ModelDescription d = bridge(k1, k2, m, yields ? std::optional<UniaxialLaw>(law) : std::nullopt);
    d.motions = {as_wave(ground_pulse(), c)};
    d.structures[0].masses.push_back(mass("0", 300));  // carried along
    const Watched run = watch(d, in_scheme("moreau-jean", dt, 1.6));
    const GroundMotion first = pulse_history(ground_pulse()), second = pulse_history(ground_pulse(), 30 / c);
    std::vector<double> memory(static_cast<std::size_t>(history_size(UniaxialLaw(law)))), next = memory;
    initialize_history(UniaxialLaw(law), memory.data());
    double work = 0, left_before = 0, right_before = 0, strain = 0;
    for (std::size_t i = 1; i < run.states.size(); ++i) {
      const double t = run.states[i].time, da = first.displacement_at(t), db = second.displacement_at(t), u = run.u(i, "s.1");
      double left = k1 * (u - da);  // pulls at the mass backwards
      if (yields) {
        left = respond(UniaxialLaw(law), u - da, memory.data(), next.data()).stress;
        memory.swap(next);
      }
      const double right = k2 * (db - u);
      const double step_a = da - first.displacement_at(t - dt), step_b = db - second.displacement_at(t - dt);
      const double du = u - run.u(i - 1, "s.1");
      work += -0.5 * (left + left_before) * step_a + 0.5 * (right + right_before) * step_b;
      strain += 0.5 * (left + left_before) * (du - step_a) + 0.5 * (right + right_before) * (step_b - du);
      left_before = left;
      right_before = right;
    }
    work += 0.5 * 300 * std::pow(first.velocity_at(1.6), 2);
    CHECK(run.summary.energy.input == doctest::Approx(work).epsilon(1e-4));  // trapezoids of 0.5 ms
    CHECK(run.summary.energy.strain == doctest::Approx(strain).epsilon(1e-6));
    CHECK(run.summary.worst_balance_error < 1e-8);
    if (yields) CHECK(run.summary.energy.strain > 100);
  }
}

TEST_CASE("a yielding structure follows a wave as its equation of motion says") {
  const double k1 = 4e5, k2 = 2.5e5, m = 1000, c = 200, dt = 0.002;
  const UniaxialLaw law = Steel01{6e3, k1, 0.05};
  ModelDescription d = bridge(k1, k2, m, law);
  d.motions = {as_wave(ground_pulse(), c)};
  const GroundMotion first = pulse_history(ground_pulse()), second = pulse_history(ground_pulse(), 30 / c);
  // central differences, forty to a step
  const double h = dt / 40;
  std::vector<double> memory(static_cast<std::size_t>(history_size(law))), next = memory, expected{0};
  initialize_history(law, memory.data());
  double u = 0, v = 0, peak = 0;
  for (int i = 0; i < 800 * 40; ++i) {
    const double t = i * h;
    const double left = respond(law, u - first.displacement_at(t), memory.data(), next.data()).stress;
    memory.swap(next);
    v += h * (-left + k2 * (second.displacement_at(t) - u)) / m;
    u += h * v;
    peak = std::max(peak, std::abs(u));
    if ((i + 1) % 40 == 0) expected.push_back(u);
  }
  const Watched run = watch(d, in_scheme("moreau-jean", dt, 1.6));
  for (std::size_t i = 0; i < expected.size(); i += 20) CHECK(std::abs(run.u(i, "s.1") - expected[i]) < 2e-3 * peak);
  CHECK(std::abs(run.u(800, "s.1") - run.u(0, "s.1")) > 0.01);
}

TEST_CASE("a structure on a moved support strikes a wall that stands on the base") {
  const double k = 3e5, m = 800, g0 = 0.02, e = 0.5, dt = 2e-4, h = 1e-6;
  ModelDescription d = bridge(k, 0, m);
  d.structures[0].springs.pop_back();
  d.structures[0].nodes.pop_back();
  d.structures[0].supports.pop_back();
  MotionDescription motion = ground_pulse();
  motion.supports = {{"s.0", {}}};
  d.motions = {motion};
  d.contacts = {wall("s.1", g0, e)};
  const Watched run = watch(d, in_scheme("moreau-jean", dt, 1));
  const GroundMotion ground = pulse_history(motion);
  std::vector<std::pair<double, double>> impacts;  // time, approach velocity
  double u = 0, v = 0;
  for (int i = 0; i < 1000000 && impacts.size() < 2; ++i) {
    v += h * k * (ground.displacement_at(i * h) - u) / m;
    u += h * v;
    if (u > g0 && v > 0) {
      impacts.emplace_back(i * h, v);
      v *= -e;
    }
  }
  REQUIRE(impacts.size() == 2);
  REQUIRE(run.summary.impacts.size() >= 2);
  for (std::size_t i = 0; i < 2; ++i) {
    CHECK(run.summary.impacts[i].time == doctest::Approx(impacts[i].first).epsilon(4e-3));  // two steps
    CHECK(run.summary.impacts[i].approach_velocity == doctest::Approx(impacts[i].second).epsilon(2e-2));
    CHECK(run.summary.impacts[i].rate_after == doctest::Approx(-e * run.summary.impacts[i].rate_before).epsilon(1e-9));
  }
  CHECK(run.summary.worst_balance_error < 1e-9);
}

TEST_CASE("a wave reaches supports by its velocity, and a delay shifts a motion") {
  ModelDescription d = bridge(4e5, 2.5e5, 1000);
  d.motions = {as_wave(ground_pulse(), 123)};
  d.motions[0].delay = 0.07;
  const Model model = build(d);
  REQUIRE(model.motions.size() == 2);
  CHECK(model.motions[0].start == doctest::Approx(0.07));
  CHECK(model.motions[1].start == doctest::Approx(0.07 + 30 / 123.0));
  CHECK(model.motions[1].duration() == doctest::Approx(0.07 + 30 / 123.0 + 0.8));
  d.motions[0].wave->direction = -Vector3::UnitX();
  CHECK(build(d).driven[0][build(d).dofs.size() - 1] == 1);  // from the other side
  for (const std::string name : {"exact", "moreau-jean", "event-split"}) {
    CAPTURE(name);
    ModelDescription now = bridge(4e5, 2.5e5, 1000), later = now;
    now.motions = {ground_pulse()};
    later.motions = {ground_pulse()};
    later.motions[0].delay = 0.0375;  // between samples
    const Watched a = watch(now, in_scheme(name, 0.0025, 0.5)), b = watch(later, in_scheme(name, 0.0025, 0.6));
    for (std::size_t i = 0; i < a.states.size(); i += 10) CHECK(std::abs(b.u(i + 15, "s.1") - a.u(i, "s.1")) < 1e-12);
  }
}

TEST_CASE("a run on moved supports goes on from a snapshot with the same bits") {
  ModelDescription d = bridge(4e5, 2.5e5, 1000, Steel01{6e3, 4e5, 0.05});
  d.motions = {as_wave(ground_pulse(), 200)};
  const Model model = build(d);
  const AnalysisOptions o = in_scheme("moreau-jean", 0.002, 0.8);
  Recorder whole, last;
  const Summary through = ReducedSimulation(model, o).run({&whole});
  Snapshot snapshot;
  int steps = 0;
  RunControl stop, go_on;
  stop.stop_requested = [&] { return ++steps > 150; };
  stop.keep_snapshot = [&](const Snapshot& kept) { snapshot = kept; };
  CHECK_FALSE(ReducedSimulation(model, o).run({}, stop).completed);
  go_on.resume = &snapshot;
  const Summary resumed = ReducedSimulation(model, o).run({&last}, go_on);
  CHECK(last.states.back().displacement == whole.states.back().displacement);
  CHECK(resumed.energy.input == through.energy.input);
  CHECK(resumed.energy.strain == through.energy.strain);
}

TEST_CASE("moved supports that a scene or a scheme cannot take are refused by name") {
  ModelDescription d = bridge(4e5, 2.5e5, 1000);
  d.motions = {ground_pulse()};
  d.motions[0].supports = {{"s.3", at(7)}};
  CHECK(error_of(d).find("s.toml:7:3: error: node 's.3' is not defined; did you mean 's.") != std::string::npos);
  d.motions[0].supports = {{"s.1", at(8)}};
  CHECK(error_of(d).find("s.toml:8:3: error: node 's.1' is moved along (1, 0, 0), but no support holds its ux") != std::string::npos);
  d.motions[0].supports = {{"s.0", {}}};
  const auto refusal = [](const ModelDescription& description, AnalysisOptions o) {
    o.scheme_at = at(9);
    const Model model = build(description);
    try {
      ReducedSimulation simulation(model, o);
    } catch (const InputError& problem) {
      return std::string(problem.what());
    }
    return std::string();
  };
  CHECK(refusal(d, in_scheme("exact", 0.01, 1)).empty());
  ModelDescription touching = d;
  touching.contacts = {wall("s.1", 0.01, 0.5)};
  CHECK(refusal(touching, in_scheme("exact", 0.01, 1)).find("they open and close contact pairs here") != std::string::npos);
  CHECK(refusal(touching, in_scheme("moreau-jean", 0.01, 1)).empty());
  touching.contacts[0].friction = 0.3;
  CHECK(refusal(touching, in_scheme("moreau-jean", 0.01, 1)).find("friction") != std::string::npos);
  ModelDescription yielding = bridge(4e5, 2.5e5, 1000, Steel01{6e3, 4e5, 0.05});
  yielding.motions = d.motions;
  CHECK(refusal(yielding, in_scheme("exponential", 0.01, 1)).find("elements here are nonlinear") != std::string::npos);
  const Model model = build(yielding);
  ReducedSimulation automatic(model, in_scheme("auto", 0.01, 1));
  CHECK(automatic.simulation().scheme().name() == "moreau-jean");
  ModelDescription loose = d;
  loose.structures[0].springs.pop_back();
  loose.structures[0].springs[0].stiffness.setZero();
  loose.structures[0].springs[0].damping[0] = 5;
  loose.structures[0].may_move_freely = true;
  CHECK(refusal(loose, in_scheme("moreau-jean", 0.01, 1)).find("they strain dashpots") != std::string::npos);
  ModelDescription viscous = bridge(4e5, 2.5e5, 1000, Viscous{2e3, 0.5});
  viscous.motions = d.motions;
  CHECK(refusal(viscous, in_scheme("moreau-jean", 0.01, 1)).find("laws of the rate of strain") != std::string::npos);
  CHECK_THROWS_WITH_AS(Simulation(model, in_scheme("moreau-jean", 0.01, 1)), doctest::Contains("use ReducedSimulation"), InputError);
}
