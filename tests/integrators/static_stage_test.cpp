// Static stages: arc length past limit points against closed forms, plastic limit loads, cycles, the ladder, errors.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "integrators/static_stage.hpp"
#include "tests/integrators/oscillators.hpp"

using namespace nsframe;
using namespace nsframe::test;

namespace {

class Curve : public StageObserver {
 public:
  void point(const StagePoint& point, const State& state) override {
    points.push_back(point);
    states.push_back(state);
  }
  std::vector<StagePoint> points;
  std::vector<State> states;
};

constexpr double E = 1e5, yield = 1000, b = -0.1, k = 2e4;  // [N/m], [N], [-], [N/m]

// A softening spring from the ground to node 1, an elastic one on to node 2, both along x.
ModelDescription softening_chain() {
  ModelDescription d = nonlinear_oscillator(1, Steel01{yield, E, b});
  StructureDescription& s = d.structures[0];
  s.nodes.push_back(node("2", 0, 0, 0));
  s.supports.push_back(fixed("2", {false, true, true, true, true, true}));
  SpringDescription elastic = ground_spring("e", "1", k * Vector6::Unit(0));
  elastic.node_j = Reference{"2", {}};
  s.springs.push_back(elastic);
  StageDescription stage;
  stage.name = "push";
  stage.at = at(20);
  stage.loads = {{{"s.2", {}}, 0, 100}};
  stage.control_node = Reference{"s.1", {}};
  stage.options.control = "arc-length";
  stage.options.targets = {0.2};
  stage.options.step = 1e-4;
  d.stages = {stage};
  return d;
}

double softening_force(double u) { return u < yield / E ? E * u : yield + b * E * (u - yield / E); }

}  // namespace

TEST_CASE("the arc length follows a softening chain past its limit point, on the closed form") {
  for (const ArcKind arc : {ArcKind::spherical, ArcKind::cylindrical}) {
    ModelDescription d = softening_chain();
    d.stages[0].options.arc = arc;
    const Model model = build(d);
    Simulation simulation(model, options(1, 1e-3, 1));
    Curve curve;
    std::vector<StageResult> results;
    REQUIRE_MESSAGE(simulation.run_stages(1, {{"newton"}, {&curve}, {}}, results), results.back().stop_reason);
    double largest = 0;
    for (std::size_t i = 0; i < curve.points.size(); ++i) {
      const double force = 100 * curve.points[i].load_factor, u = curve.states[i].displacement[0];
      CHECK(force == doctest::Approx(softening_force(u)).epsilon(1e-8));
      CHECK(curve.states[i].displacement[1] == doctest::Approx(u + force / k).epsilon(1e-8));
      largest = std::max(largest, force);
    }
    CHECK(largest > 0.9 * yield);
    CHECK(curve.states.back().displacement[0] == doctest::Approx(0.2).epsilon(1e-9));
    CHECK(results[0].points.back().load_factor < 0);
  }
}

TEST_CASE("where the arc length stops at a kink that snaps back, displacement control goes on, as it says") {
  const double soft = 5e3;  // gives back more than the softening spring takes
  ModelDescription d = softening_chain();
  d.structures[0].springs.back().stiffness = soft * Vector6::Unit(0);
  d.stages[0].options.targets = {0.08};
  {
    const Model model = build(d);
    Simulation simulation(model, options(1, 1e-3, 1));
    std::vector<StageResult> results;
    REQUIRE_FALSE(simulation.run_stages(1, {{"newton"}, {}, {}}, results));
    CHECK(results[0].points.back().load_factor == doctest::Approx(10).epsilon(1e-3));
    CHECK(results[0].stop_reason.find("displacement control of a DOF that goes on moving there") != std::string::npos);
  }
  d.stages[0].options.control = "displacement";
  const Model model = build(d);
  Simulation simulation(model, options(1, 1e-3, 1));
  Curve curve;
  std::vector<StageResult> results;
  REQUIRE_MESSAGE(simulation.run_stages(1, {{"newton"}, {&curve}, {}}, results), results.back().stop_reason);
  for (std::size_t i = 0; i < curve.points.size(); ++i) {
    const double force = 100 * curve.points[i].load_factor, u = curve.states[i].displacement[0];
    CHECK(force == doctest::Approx(softening_force(u)).epsilon(1e-8));
    CHECK(curve.states[i].displacement[1] == doctest::Approx(u + force / soft).epsilon(1e-8));
  }
}

TEST_CASE("the arc length follows a shallow truss behind a spring through its snap-back, on the closed form") {
  // two corotational bars of half span 1 m and rise h, pushed down at their crown through a spring k: the crown's sag w carries
  // P(w) = 2 EA (L - l)/L (h - w)/l, and the spring's end goes u = w + P/k, back where P falls faster than k
  const double h = 0.2, stretch = 200e9 * 1e-4, L = std::hypot(1, h), soft = 3e5;
  const auto load = [&](double w) { return 2 * stretch * (L - std::hypot(1, h - w)) / L * (h - w) / std::hypot(1, h - w); };
  const auto way = [&](double w) { return w + load(w) / soft; };
  for (const ArcKind arc : {ArcKind::spherical, ArcKind::cylindrical}) {
    CAPTURE(int(arc));
    ModelDescription d;
    d.materials = {{"m", {}, Elastic{200e9}}};
    StructureDescription s;
    s.name = "s";
    s.nodes = {node("1", -1, 0, 0), node("2", 0, 0, h), node("3", 1, 0, 0), node("4", 0, 0, h)};
    s.supports = {fixed("1"), fixed("3"), fixed("2", {true, true, false, true, true, true}), fixed("4", {true, true, false, true, true, true})};
    s.elements = {bar("l", "1", "2", "m", 1e-4), bar("r", "2", "3", "m", 1e-4)};
    for (ElementDescription& e : s.elements) e.geometry = Geometry::corotational;
    SpringDescription spring = ground_spring("k", "2", soft * Vector6::Unit(2));
    spring.node_j = Reference{"4", {}};
    s.springs = {spring};
    s.masses = {mass("2", 1), mass("4", 1)};
    d.structures = {s};
    StageDescription stage;
    stage.name = "push";
    stage.loads = {{{"s.4", {}}, 2, -1000}};
    stage.control_node = Reference{"s.4", {}};  // the end that snaps back
    stage.control_dof = 2;
    stage.options.control = "arc-length";
    stage.options.arc = arc;
    stage.options.targets = {-0.6};
    stage.options.step = 2e-3;
    d.stages = {stage};
    const Model model = build(d);
    Simulation simulation(model, options(1, 1e-3, 1));
    Curve curve;
    std::vector<StageResult> results;
    REQUIRE_MESSAGE(simulation.run_stages(1, {{"newton"}, {&curve}, {}}, results), results.back().stop_reason);
    const std::size_t n = curve.points.size();
    std::vector<double> sag(n), force(n), end(n);
    for (std::size_t i = 0; i < n; ++i) {
      sag[i] = -curve.states[i].displacement[0];
      end[i] = -curve.states[i].displacement[1];
      force[i] = 1000 * curve.points[i].load_factor;
      CHECK(std::abs(force[i] - load(sag[i])) < 1e-7 * load(0.08));
      CHECK(std::abs(end[i] - way(sag[i])) < 1e-8);
      if (i > 0) CHECK(sag[i] > sag[i - 1]);  // on and on, whatever the load and the end do
    }
    CHECK(end.back() == doctest::Approx(0.6).epsilon(1e-9));
    // extremes of the path, by golden sections of the closed form, and by parabolas through the points around them
    const auto extreme = [](const auto& f, double low, double high, double sign) {
      for (int i = 0; i < 200; ++i) {
        const double a = low + (high - low) / 3, b = high - (high - low) / 3;
        (sign * f(a) < sign * f(b) ? low : high) = sign * f(a) < sign * f(b) ? a : b;
      }
      return f(0.5 * (low + high));
    };
    const auto found = [&](const std::vector<double>& values, double sign) {
      std::vector<double> all;
      for (std::size_t i = 1; i + 1 < n; ++i) {
        const double before = values[i - 1] - values[i], after = values[i + 1] - values[i];
        if (sign * before > 0 || sign * after >= 0) continue;
        const double x = sag[i - 1] - sag[i], y = sag[i + 1] - sag[i];
        const double curve_of = (before / x - after / y) / (x - y), slope = after / y - curve_of * y;
        all.push_back(values[i] - slope * slope / (4 * curve_of));
      }
      return all;
    };
    for (const double sign : {1.0, -1.0}) {  // the limit of the load and the first of the end; those on the way back
      const double low = sign > 0 ? 0 : h, high = sign > 0 ? h : 2 * h;
      const auto of_load = found(force, sign), of_end = found(end, sign);
      REQUIRE(of_load.size() == 1);
      REQUIRE(of_end.size() == 1);
      CHECK(of_load[0] == doctest::Approx(extreme(load, low, high, sign)).epsilon(1e-3));
      CHECK(of_end[0] == doctest::Approx(extreme(way, low, high, sign)).epsilon(1e-3));
    }
    CHECK(found(end, 1)[0] - found(end, -1)[0] > 0.1);  // a snap-back by more than half the rise
  }
}

TEST_CASE("an arc length that would turn back says where, and doesn't go over to another branch") {
  // behind a spring so soft that beyond the limit the way on is all but the way back; algorithms after Newton's find the branch of
  // the law in compression, far away in the control DOF
  ModelDescription d = softening_chain();
  d.structures[0].springs.back().stiffness = 50 * Vector6::Unit(0);
  const Model model = build(d);
  Simulation simulation(model, options(1, 1e-3, 1));
  std::vector<StageResult> results;
  REQUIRE_FALSE(simulation.run_stages(1, {{"auto"}, {}, {}}, results));
  CHECK(results[0].points.back().load_factor == doctest::Approx(10).epsilon(1e-3));
  CHECK(results[0].points.back().displacement == doctest::Approx(0.01).epsilon(1e-3));
  CHECK(results[0].stop_reason.starts_with("stage 'push' cannot go on from load factor 10, s.1 ux = 0.01 "));
  CHECK(results[0].stop_reason.find("snaps back at a kink") != std::string::npos);
  const auto& records = results[0].ladder;
  CHECK(std::any_of(records.begin(), records.end(), [](const LadderRecord& record) {
    return record.attempts.back().reason.find("times as far as the last increment leads") != std::string::npos;
  }));
}

TEST_CASE("load control cannot pass the limit point, and says where it stopped and what was tried") {
  for (const std::string algorithm : {"newton", "auto"}) {  // but for Newton's they find the law's second branch, far away
    CAPTURE(algorithm);
    ModelDescription d = softening_chain();
    d.stages[0].options.control = "load";
    d.stages[0].options.targets = {11};
    d.stages[0].options.step = 1;
    const Model model = build(d);
    AnalysisOptions analysis = options(1, 1e-3, 1);
    analysis.algorithm = {algorithm};
    Simulation simulation(model, analysis);
    const Summary summary = simulation.run({});
    CHECK_FALSE(summary.completed);
    CHECK(summary.steps == 0);
    REQUIRE(summary.stages.size() == 1);
    CHECK(summary.stages[0].points.back().load_factor == doctest::Approx(10).epsilon(1e-3));
    CHECK(summary.stop_reason.starts_with("stage 'push' cannot go on from load factor"));
    CHECK(summary.stop_reason.find("s.1 ux = 0.0") != std::string::npos);
    CHECK(summary.stop_reason.find("tried: newton (") != std::string::npos);
    const auto& records = summary.stages[0].ladder;
    const bool refused = std::any_of(records.begin(), records.end(), [](const LadderRecord& record) {
      return record.attempts.back().reason.find("times as far as the last increment leads") != std::string::npos;
    });
    CHECK(refused == (algorithm == "auto"));
  }
}

TEST_CASE("arc length gives up after its most points") {
  ModelDescription d = softening_chain();
  d.stages[0].control_node = Reference{"s.2", {}};
  d.stages[0].options.targets = {0.3};
  d.stages[0].options.step = 1e-3;
  d.stages[0].options.max_points = 5;
  const Model model = build(d);
  Simulation simulation(model, options(1, 1e-3, 1));
  const Summary summary = simulation.run({});
  CHECK_FALSE(summary.completed);
  CHECK(summary.stop_reason.find("the target is not reached after 5 points") != std::string::npos);
}

TEST_CASE("a force-based member whose whole end section flows goes on at its plastic moment, forth and back") {
  const double depth = 0.2, width = 0.1, fy = 235e6, height = 2;
  ModelDescription d;
  d.materials = {{"m", {}, Steel01{fy, 210e9, 0}}};
  FiberSectionDescription section;
  for (int i = 0; i < 20; ++i)
    for (const double z : {-0.25 * width, 0.25 * width}) section.fibers.push_back({depth * ((i + 0.5) / 20 - 0.5), z, depth / 20 * width / 2, {"m", {}}});
  section.torsion_stiffness = 1e5;
  d.sections = {{"c", {}, section, {}}};
  StructureDescription structure;
  structure.name = "s";
  structure.nodes = {node("1", 0, 0, 0), node("2", 0, 0, height)};
  structure.supports = {fixed("1"), fixed("2", {false, true, false, true, false, true})};
  structure.elements = {beam("e", "1", "2", "c", ElementKind::force_beam)};
  structure.masses = {mass("2", 100)};
  d.structures = {structure};
  StageDescription stage;
  stage.name = "push";
  stage.loads = {{{"s.2", {}}, 0, fy * width * depth * depth / 4 / height}};
  stage.control_node = Reference{"s.2", {}};
  stage.options.control = "displacement";
  stage.options.targets = {0.2, -0.2, 0.1};
  stage.options.steps = 40;
  d.stages = {stage};
  const Model model = build(d);
  Simulation simulation(model, options(1, 1e-3, 1));
  std::vector<StageResult> results;
  REQUIRE_MESSAGE(simulation.run_stages(1, {{"newton"}, {}, {}}, results), results.back().stop_reason);
  CHECK(results[0].halved == 0);
  REQUIRE(results[0].points.size() == 121);
  CHECK(results[0].points[40].load_factor == doctest::Approx(1).epsilon(1e-8));  // stands for the stiffness: 1e-10 of it
  CHECK(results[0].points[80].load_factor == doctest::Approx(-1).epsilon(1e-8));
  CHECK(results[0].points[120].load_factor == doctest::Approx(1).epsilon(1e-8));
}

TEST_CASE("loads of earlier stages stay, and the time history begins under all of them") {
  ModelDescription d = linear_oscillator(100, 1e4, 0);
  d.gravity.acceleration = Vector3(1, 0, 0);  // 100 N
  StageDescription first, second;
  first.name = "first";
  first.loads = {{{"s.1", {}}, 0, 50}};
  first.options.targets = {1, 2};
  first.options.steps = 1;
  second.name = "second";
  second.masses = Vector3(1, 0, 0);
  second.control_node = Reference{"s.1", {}};
  second.options = {"displacement", {}, {0.05}};
  second.options.steps = 1;
  d.stages = {first, second};
  const Model model = build(d);
  Simulation simulation(model, options(0.5, 1e-3, 0.1));
  const Summary summary = simulation.run({});
  REQUIRE(summary.completed);
  CHECK(summary.stages[0].points.size() == 3);
  CHECK(summary.stages[0].points[2].load_factor == 2);
  CHECK(summary.stages[1].points[0].displacement == doctest::Approx((100 + 100) / 1e4).epsilon(1e-9));
  CHECK(summary.stages[1].points[1].load_factor == doctest::Approx((1e4 * 0.05 - 200) / 100).epsilon(1e-9));
  CHECK(summary.steps == 100);
  CHECK(simulation.state().displacement[0] == doctest::Approx(0.05).epsilon(1e-9));  // at rest under all loads
  CHECK(std::abs(simulation.state().velocity[0]) < 1e-9);
}

TEST_CASE("cycles of an elastoplastic spring enclose the work of plasticity") {
  ModelDescription d = nonlinear_oscillator(1, ElasticPP{1e5, 0.01});
  StageDescription stage;
  stage.name = "cycles";
  stage.loads = {{{"s.1", {}}, 0, 1}};
  stage.control_node = Reference{"s.1", {}};
  stage.options.control = "displacement";
  stage.options.targets = {0.03, -0.03, 0.03, -0.03};
  stage.options.step = 1e-3;
  d.stages = {stage};
  const Model model = build(d);
  Simulation simulation(model, options(1, 1e-3, 0));
  const Summary summary = simulation.run({});
  REQUIRE_MESSAGE(summary.completed, summary.stop_reason);
  const auto& points = summary.stages[0].points;
  REQUIRE(points.size() == 1 + 30 + 3 * 60);
  double work = 0;
  for (std::size_t i = 31; i <= 150; ++i) {  // one full cycle
    work += 0.5 * (points[i].load_factor + points[i - 1].load_factor) * (points[i].displacement - points[i - 1].displacement);
  }
  CHECK(work == doctest::Approx(4 * 1000 * (0.03 - 0.01)).epsilon(1e-9));  // the kinks lie on points
}

TEST_CASE("a mode-proportional load is M phi along its direction, in all 1 N") {
  ModelDescription d = softening_chain();
  d.structures[0].masses.push_back(mass("2", 3));
  d.stages[0].loads.clear();
  d.stages[0].mode = Reference{"s.L1", {}};
  const Model model = build(d);
  Simulation simulation(model, options(1, 1e-3, 1));
  const VectorX& pattern = simulation.stages()[0].pattern;
  const VectorX inertia = model.mass * simulation.modes()[0].modes.shape.col(0);
  CHECK(pattern.lpNorm<1>() == doctest::Approx(1).epsilon(1e-12));
  CHECK(pattern.sum() > 0);
  CHECK(std::abs(pattern[0] * inertia[1] - pattern[1] * inertia[0]) < 1e-12 * inertia.norm());
}

TEST_CASE("stages that cannot be are errors by place") {
  ModelDescription d = softening_chain();
  d.stages[0].loads[0].node = {"s.9", at(21)};
  CHECK(error_of(d).starts_with("s.toml:21:3: error: there is no node 's.9'; did you mean"));
  d = softening_chain();
  d.stages[0].loads[0] = {{"s.2", at(21)}, 1, 100};
  CHECK(error_of(d) == "s.toml:21:3: error: uy of node 's.2' is held: a load there does nothing");
  d = softening_chain();
  d.stages[0].control_node->at = at(22);
  d.stages[0].control_dof = 2;
  CHECK(error_of(d) == "s.toml:22:3: error: uz of node 's.1' is held: it cannot be the control displacement");
  d = softening_chain();
  d.stages[0].loads.clear();
  d.stages[0].mode = Reference{"t.L1", at(23)};
  CHECK(error_of(d) == "s.toml:23:3: error: mode = \"t.L1\": there is no structure 't'; known: s");
  const auto of_run = [](const ModelDescription& description) -> std::string {
    try {
      const Model model = build(description);
      Simulation simulation(model, options(1, 1e-3, 1));
    } catch (const InputError& problem) {
      return problem.what();
    }
    return "no error";
  };
  d.stages[0].mode = Reference{"s.T1", at(23)};
  CHECK(of_run(d).starts_with("s.toml:23:3: error: structure 's' has no mode 'T1'"));
  d = softening_chain();
  d.stages[0].options.control = "arclength";
  d.stages[0].options.control_at = at(24);
  CHECK(of_run(d) == "s.toml:24:3: error: control 'arclength' is not known; did you mean 'arc-length'?");
  d = softening_chain();
  d.stages[0].options.targets = {0.1, 0.2};
  CHECK(of_run(d) == "s.toml:20:3: error: stage 'push': control by arc-length has one target, not 2");
  d = softening_chain();
  d.structures[0].initial_displacements = {{{"1", {}}, 0, 0.1}};
  CHECK(of_run(d).find("initial displacements cannot be given beside them") != std::string::npos);
}
