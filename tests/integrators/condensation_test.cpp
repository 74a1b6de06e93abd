// Static condensation of DOFs without mass: the same results as without, what it cures, and what it must leave alone.
#include <doctest/doctest.h>

#include <functional>

#include "integrators/reduced_simulation.hpp"
#include "tests/integrators/oscillators.hpp"

using namespace nsframe;
using namespace nsframe::test;

namespace {

MotionDescription shaking() {
  MotionDescription motion;
  motion.dt = 0.02;
  for (int i = 0; i <= 60; ++i) motion.acceleration.push_back(3 * std::sin(0.9 * i) * (60 - i) / 60);
  motion.direction = Vector3(0.8, 0.6, 0);
  return motion;
}

// Portals of two columns and a loaded beam, one behind the other along y and tied there, each column in two pieces whose middle has
// no mass; masses at the columns' heads, each frame `heavier` than the one before [kg], no rotational inertia anywhere.
ModelDescription portals(int count, double heavier = 40) {
  ModelDescription d;
  d.sections = {elastic_section("c", {210e9, 81e9, 3e-3, 1e-5, 4e-6, 8e-8})};
  d.motions = {shaking()};
  StructureDescription s;
  s.name = "a";
  s.at = at(1);
  for (int i = 0; i < count; ++i) {
    const auto id = [i](const char* name) { return name + std::to_string(i); };
    for (const int side : {0, 1}) {
      const std::string foot = id(side ? "r" : "l"), middle = id(side ? "rm" : "lm"), head = id(side ? "rh" : "lh");
      s.nodes.insert(s.nodes.end(), {node(foot, 4.0 * side, 3.0 * i, 0), node(middle, 4.0 * side, 3.0 * i, 1.5), node(head, 4.0 * side, 3.0 * i, 3)});
      s.elements.insert(s.elements.end(), {beam("e" + foot, foot, middle, "c"), beam("f" + foot, middle, head, "c")});
      s.supports.push_back(fixed(foot));
      s.masses.push_back(mass(head, 500 + heavier * i + 100 * side));
      if (i > 0) s.elements.push_back(beam("t" + head, (side ? "rh" : "lh") + std::to_string(i - 1), head, "c"));
    }
    s.elements.push_back(beam(id("b"), id("lh"), id("rh"), "c"));
    LoadDescription load;
    load.elements = {{id("b"), {}}};
    load.uniform = Vector3(0, 0, -5000);
    s.loads.push_back(load);
  }
  s.damping.kind = DampingKind::modal;
  s.damping.ratios = {0.03, 0.02, 0.01};
  d.structures = {s};
  d.gravity.acceleration = Vector3(0, 0, -9.81);
  return d;
}

struct Both {
  Summary with, without;
  std::vector<State> condensed, kept;
  std::vector<VectorX> condensed_stages, kept_stages;  // displacements at every point
};

class StageRecorder : public StageObserver {
 public:
  explicit StageRecorder(std::vector<VectorX>& displacements) : displacements_(displacements) {}
  void start(const Model& model, const StaticStage&, const State& state) override { CHECK(state.displacement.size() == model.dofs.size()); }
  void point(const StagePoint&, const State& state) override { displacements_.push_back(state.displacement); }
  void finish(const StageResult&) override {}

 private:
  std::vector<VectorX>& displacements_;
};

Both run_both(const ModelDescription& d, const AnalysisOptions& o) {
  const Model model = build(d);
  Both both;
  Recorder condensed, kept;
  StageRecorder condensed_stages(both.condensed_stages), kept_stages(both.kept_stages);
  both.with = ReducedSimulation(model, o).run({&condensed}, {}, {&condensed_stages});
  both.condensed = std::move(condensed.states);
  both.without = Simulation(model, o).run({&kept}, {}, {&kept_stages});
  both.kept = std::move(kept.states);
  REQUIRE(both.with.completed);
  REQUIRE(both.condensed.size() == both.kept.size());
  return both;
}

double apart(const Both& both, VectorX State::*part) {
  double difference = 0, size = 0;
  for (std::size_t i = 0; i < both.kept.size(); ++i) {
    REQUIRE((both.condensed[i].*part).size() == (both.kept[i].*part).size());
    difference = std::max(difference, (both.condensed[i].*part - both.kept[i].*part).cwiseAbs().maxCoeff());
    size = std::max(size, (both.kept[i].*part).cwiseAbs().maxCoeff());
  }
  return difference / size;
}

// A mass at the end of two springs, with a node without mass between them.
ModelDescription springs_in_series(double k1, double k2, double m, double v0) {
  ModelDescription d = single_mass(m, 0, v0);
  StructureDescription& s = d.structures[0];
  s.nodes.push_back(node("0", 0, 0, 0));
  s.supports.push_back(fixed("0", {false, true, true, true, true, true}));
  SpringDescription between = ground_spring("k2", "0", k2 * Vector6::Unit(0));
  between.node_j = Reference{"1", {}};
  s.springs = {ground_spring("k1", "0", k1 * Vector6::Unit(0)), between};
  return d;
}

int condensed(const ModelDescription& d) { return find_condensation(build(d)).condensed; }

}  // namespace

TEST_CASE("condensed DOFs without mass move from rest as those that are kept") {
  // densely solved structures lose all of them, large ones those that leave their factors smaller
  for (const int count : {1, 20}) {
    const ModelDescription d = portals(count);
    for (const double theta : {0.5, 1.0}) {
      CAPTURE(count);
      CAPTURE(theta);
      const Both both = run_both(d, options(theta, 0.005, 0.6));
      const int candidates = 2 * count * 9;
      CHECK(both.with.savings.massless_dofs == candidates);
      CHECK(both.with.savings.condensed_dofs >= (count == 1 ? candidates : 2 * count * 6));
      CHECK(both.with.savings.condensed_entries < (count == 1 ? 0.2 : 0.75));
      CHECK(both.with.dofs == both.without.dofs);
      // rounding, times the ratio of stiffnesses along and across the members
      CHECK(apart(both, &State::displacement) < 1e-9);
      CHECK(apart(both, &State::velocity) < 1e-8);
      CHECK(both.with.energy.input == doctest::Approx(both.without.energy.input).epsilon(1e-8));
      CHECK(both.with.worst_balance_error < 1e-10);
    }
  }
}

namespace {

// The portals with a yielding brace at the first head, pushed there and at another head before the motion.
ModelDescription pushed_portals(int count) {
  ModelDescription d = portals(count);
  d.materials = {{"steel", {}, Steel01{4e3, 4e5, 0.1}}};
  SpringDescription brace = ground_spring("brace", "lh0", Vector6::Zero());
  brace.law[0] = Reference{"steel", {}};
  d.structures[0].springs = {brace};
  StageDescription push;
  push.name = "push";
  push.loads = {{{"a.lh0", {}}, 0, 2e3}, {{"a.rh0", {}}, 1, 500}};
  push.options.targets = {1};
  push.options.steps = 4;
  push.options.tolerance = 1e-13;
  StageDescription pull = push;
  pull.name = "pull";
  pull.options.control = "displacement";
  pull.control_node = Reference{"a.lh0", {}};
  pull.options.targets = {-0.03, 0.02};
  pull.options.step = 0.005;
  d.stages = {push, pull};
  return d;
}

}  // namespace

TEST_CASE("condensed DOFs go through static stages as those that are kept, and on from there") {
  for (const int count : {1, 20}) {
    CAPTURE(count);
    const ModelDescription d = pushed_portals(count);
    AnalysisOptions o = options(1, 0.005, 0.3);
    o.newton_tolerance = 1e-13;
    const Both both = run_both(d, o);
    CHECK(both.with.savings.massless_dofs == 2 * count * 9 - 3);  // the brace's node keeps its rotations
    CHECK(both.with.savings.condensed_dofs > count * 12 - 3);
    REQUIRE(both.with.stages.size() == 2);
    REQUIRE(both.condensed_stages.size() == both.kept_stages.size());
    REQUIRE(both.kept_stages.size() > 20);
    double apart_in_stages = 0, size = 0;
    for (std::size_t i = 0; i < both.kept_stages.size(); ++i) {
      REQUIRE(both.condensed_stages[i].size() == both.kept_stages[i].size());
      apart_in_stages = std::max(apart_in_stages, (both.condensed_stages[i] - both.kept_stages[i]).cwiseAbs().maxCoeff());
      size = std::max(size, both.kept_stages[i].cwiseAbs().maxCoeff());
    }
    CHECK(size > 0.02);
    CHECK(apart_in_stages < 1e-11 * size);
    for (std::size_t i = 0; i < both.without.stages[1].points.size(); ++i) {
      CHECK(both.with.stages[1].points[i].load_factor == doctest::Approx(both.without.stages[1].points[i].load_factor).epsilon(1e-9));
    }
    CHECK(apart(both, &State::displacement) < 1e-9);
    CHECK(apart(both, &State::velocity) < 1e-8);
    CHECK(both.with.energy.input == doctest::Approx(both.without.energy.input).epsilon(1e-8));
  }
}

TEST_CASE("what a static stage loads or is led by is not condensed, nothing is where the arc length counts all") {
  const auto found = [](const std::function<void(ModelDescription&)>& change) {
    ModelDescription d = pushed_portals(1);
    change(d);
    return find_condensation(build(d));
  };
  const Condensation pushed = found([](ModelDescription&) {});
  REQUIRE(pushed.condensed == pushed.candidates);
  const Condensation loaded = found([](ModelDescription& d) { d.stages[0].loads.push_back({{"a.rm0", {}}, 1, 10}); });
  CHECK(loaded.condensed == pushed.condensed - 1);
  const Condensation led = found([](ModelDescription& d) { d.stages[1].control_node = Reference{"a.lm0", {}}; });
  CHECK(led.condensed == pushed.condensed - 1);
  CHECK_FALSE(led.kept_for_arcs);
  const Condensation by_arc = found([](ModelDescription& d) { d.stages[1].options.control = "arc-length"; });
  CHECK(by_arc.kept_for_arcs);
  CHECK(by_arc.candidates == pushed.candidates);
  CHECK(by_arc.condensed == 0);
}

TEST_CASE("the summary says what part of the entries equal frames leave to be stored") {
  const auto stored = [](int count, double heavier) {
    const Model model = build(portals(count, heavier));
    ReducedSimulation simulation(model, options(0.5, 0.005, 0.02));
    return simulation.run({}).savings.stored_entries;
  };
  CHECK(stored(1, 0) == 1);  // solved densely
  const double alike = stored(60, 0), different = stored(60, 40);
  CHECK(alike < 0.5);
  CHECK(different > 1.3 * alike);
  CHECK(different <= 1);
}

TEST_CASE("a DOF without mass follows at once where it rings when it is stepped") {
  const double k1 = 3e5, k2 = 1e5, m = 100, v0 = 0.7, share = k2 / (k1 + k2), w = std::sqrt(k1 * share / m);
  const ModelDescription d = springs_in_series(k1, k2, m, v0);
  const double h = 1e-3;
  const Both both = run_both(d, options(0.5, h, 0.4));
  REQUIRE(both.with.savings.condensed_dofs == 1);
  const Model model = build(d);
  const auto free = [&](const std::string& id) {
    int i = 0;
    while (model.nodes.id[static_cast<std::size_t>(model.dofs.free[static_cast<std::size_t>(i)].node)] != id) ++i;
    return i;
  };
  const int middle = free("s.0"), end = free("s.1");
  const double angle = 2 * std::atan(0.5 * w * h);  // of a step: theory.md (34) at theta = 1/2
  double ringing = 0;
  for (std::size_t i = 0; i < both.kept.size(); ++i) {
    const State& state = both.condensed[i];
    CHECK(state.velocity[end] == doctest::Approx(v0 * std::cos(angle * static_cast<double>(i))).epsilon(1e-9));
    CHECK(std::abs(state.displacement[middle] - share * state.displacement[end]) < 1e-14);
    CHECK(std::abs(state.velocity[middle] - share * state.velocity[end]) < 1e-13);
    CHECK(std::abs(state.displacement[end] - both.kept[i].displacement[end]) < 1e-12);
    ringing = std::max(ringing, std::abs(both.kept[i].velocity[middle] - share * both.kept[i].velocity[end]));
  }
  CHECK(ringing == doctest::Approx(share * v0).epsilon(1e-6));  // undamped, from its first rest
}

TEST_CASE("impacts of a condensed structure are those of the whole one") {
  ModelDescription d = portals(2);
  d.gravity = {};
  ModelDescription other = single_mass(800);
  other.structures[0].springs = {ground_spring("k", "1", 2e5 * Vector6::Unit(0))};
  other.structures[0].name = "w";
  other.structures[0].nodes[0].position = Vector3(4.003, 0, 3);
  d.structures.push_back(other.structures[0]);
  ContactDescription c = wall("a.rh0", 0.003, 0.6);
  c.b = Reference{"w.1", {}};
  d.contacts = {c};
  const Both both = run_both(d, options(0.5, 0.002, 1));
  CHECK(both.with.savings.condensed_dofs > 0);
  REQUIRE(both.with.impacts.size() == both.without.impacts.size());
  REQUIRE_FALSE(both.with.impacts.empty());
  for (std::size_t i = 0; i < both.with.impacts.size(); ++i) {
    CHECK(both.with.impacts[i].impulse == doctest::Approx(both.without.impacts[i].impulse).epsilon(1e-6));
    CHECK(both.with.impacts[i].time == both.without.impacts[i].time);
  }
}

TEST_CASE("what is damped, touched, nonlinear or given a start is not condensed") {
  const ModelDescription d = springs_in_series(3e5, 1e5, 100, 0.7);
  CHECK(condensed(d) == 1);
  SUBCASE("a dashpot") {
    ModelDescription changed = d;
    changed.structures[0].springs[0].damping[0] = 1;
    CHECK(condensed(changed) == 0);
  }
  SUBCASE("Rayleigh damping by stiffness, but not by mass alone") {
    ModelDescription changed = d;
    DampingDescription& damping = changed.structures[0].damping;
    damping.kind = DampingKind::rayleigh;
    damping.mass_factor = 0.1;
    CHECK(condensed(changed) == 1);
    damping.stiffness_factor = 1e-3;
    CHECK(condensed(changed) == 0);
  }
  SUBCASE("contact") {
    ModelDescription changed = d;
    changed.contacts = {wall("s.0", 0.01, 0.5)};
    CHECK(condensed(changed) == 0);
    changed.contacts = {wall("s.1", 0.01, 0.5)};
    CHECK(condensed(changed) == 1);
  }
  SUBCASE("a nonlinear law") {
    ModelDescription changed = d;
    changed.materials = {{"steel", {}, Steel01{100, 3e5, 0.1}}};
    changed.structures[0].springs[0].stiffness.setZero();
    changed.structures[0].springs[0].law[0] = Reference{"steel", {}};
    CHECK(condensed(changed) == 0);
  }
  SUBCASE("an initial value") {
    ModelDescription changed = d;
    changed.structures[0].initial_velocities.push_back({{"0", {}}, 0, 0.1});
    CHECK(condensed(changed) == 0);
  }
  SUBCASE("and schemes that condense it themselves are left alone") {
    const Model model = build(d);
    AnalysisOptions o = options(0.5, 1e-3, 0.01);
    o.scheme = "exact";
    const Summary summary = ReducedSimulation(model, o).run({});
    CHECK(summary.savings.massless_dofs == 0);
    CHECK(summary.savings.condensed_dofs == 0);
  }
}

TEST_CASE("a structure whose stiffness would fill up keeps its DOFs without mass") {
  // every node meets every other one
  ModelDescription d;
  d.sections = {elastic_section("c", {210e9, 81e9, 3e-3, 1e-5, 4e-6, 8e-8})};
  StructureDescription s;
  s.name = "a";
  s.at = at(1);
  const int n = 6;  // nodes along each edge of a grid of beams
  for (int i = 0; i < n * n; ++i) {
    const std::string id = std::to_string(i);
    s.nodes.push_back(node(id, i % n, i / n, 0.1 * (i % 3)));
    s.masses.push_back(mass(id, 10));
    if (i % n > 0) s.elements.push_back(beam("x" + id, std::to_string(i - 1), id, "c"));
    if (i >= n) s.elements.push_back(beam("y" + id, std::to_string(i - n), id, "c"));
  }
  s.supports = {fixed("0")};
  d.structures = {s};
  const Condensation found = find_condensation(build(d));
  CHECK(found.candidates == 3 * (n * n - 1));
  CHECK(found.condensed < found.candidates);
  CHECK(found.entries_after <= found.entries_before);
  const Condensation all = find_condensation(build(d), 10000);
  CHECK(all.condensed == all.candidates);
}

TEST_CASE("a condensed run goes on from a snapshot with the same bits") {
  const Model model = build(portals(1));
  const AnalysisOptions o = options(0.5, 0.005, 0.3);
  Recorder whole, last;
  ReducedSimulation(model, o).run({&whole});
  Snapshot snapshot;
  int steps = 0;
  RunControl stop;
  stop.stop_requested = [&] { return ++steps > 25; };
  stop.keep_snapshot = [&](const Snapshot& kept) { snapshot = kept; };
  CHECK_FALSE(ReducedSimulation(model, o).run({}, stop).completed);
  RunControl go_on;
  go_on.resume = &snapshot;
  CHECK(ReducedSimulation(model, o).run({&last}, go_on).completed);
  CHECK(last.states.back().displacement == whole.states.back().displacement);
  CHECK(last.states.back().velocity == whole.states.back().velocity);
}
