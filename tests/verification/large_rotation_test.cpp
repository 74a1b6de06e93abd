// Corotational members at large rotations against closed forms, published values and OpenSees.
#include <fmt/format.h>

#include <cmath>

#include "elements/elastic_beam.hpp"
#include "integrators/simulation.hpp"
#include "integrators/static_analysis.hpp"
#include "tests/support/reference_data.hpp"
#include "tests/support/small_models.hpp"
#include "tests/verification/registry.hpp"

using namespace nsframe;
using namespace nsframe::test;

namespace {

// Members along a curve x(s), s in [0, 1], of constant section, clamped at s = 0.
template <class Curve>
ModelDescription clamped(int elements, const ElasticSection& section, const Curve& curve, bool plane = false) {
  ModelDescription d;
  d.sections = {elastic_section("c", section)};
  StructureDescription s;
  s.name = "a";
  for (int i = 0; i <= elements; ++i) {
    s.nodes.push_back({std::to_string(i), {}, curve(double(i) / elements)});
    if (plane && i > 0) s.supports.push_back(fixed(std::to_string(i), {false, false, true, true, true, false}));
  }
  s.supports.push_back(fixed("0"));
  for (int i = 0; i < elements; ++i) {
    s.elements.push_back(beam(std::to_string(i), std::to_string(i), std::to_string(i + 1), "c"));
    s.elements.back().geometry = Geometry::corotational;
    s.elements.back().orientation = Vector3::UnitZ();
  }
  d.structures = {s};
  return d;
}

// Displacements (6) of the last node under `load` (6) there, in equal steps; `each` sees them after every step.
template <class Each>
Vector6 pushed(const ModelDescription& description, const Vector6& load, int steps, const Each& each,
               const StaticOptions& options = {}) {
  const Model model = build(description);
  System system(model, 1);
  State state = virgin_state(system);
  VectorX full = VectorX::Zero(model.dofs.full);
  full.tail<6>() = load;
  const VectorX reduced = model.dofs.transformation_transposed * full;
  Vector6 tip = Vector6::Zero();
  for (int step = 1; step <= steps; ++step) {
    solve_static(system, double(step) / steps * reduced, options, state);
    tip = model.dofs.expand(state.displacement).tail<6>();
    each(step, tip);
  }
  return tip;
}
Vector6 pushed(const ModelDescription& description, const Vector6& load, int steps) {
  return pushed(description, load, steps, [](int, const Vector6&) {});
}

Vector3 straight(double s) { return {s, 0, 0}; }

// EI = 1, L = 1, stiff along the axis.
ElasticSection slender(double EA) { return {1.0, 1.0, EA, 1.0, 1.0, 1.0}; }

double order(double coarse, double fine) { return std::log2(coarse / fine); }

}  // namespace

VERIFICATION_CASE("Large displacements", "Roll-up of a cantilever to a full circle",
                  "Sixteen corotational elements under 2 pi EI/L at the tip in a hundred steps, in the plane and in space. Closed form of the "
                  "circle, from which sixteen chords lie off by (pi/16)^2 / 24 of the length at most; OpenSees 3.7.1 with the same elements "
                  "up to 0.51 of the moment, where it stops.") {
  const Table opensees = read_reference("rollup_16");
  for (const bool plane : {true, false}) {
    const std::string where = plane ? "in the plane: " : "in space: ";
    double difference = 0, error = 0, turn = 0;
    const Vector6 tip = pushed(clamped(16, slender(1e4), straight, plane), 2 * pi * Vector6::Unit(5), 100,
                               [&](int step, const Vector6& u) {
      const double t = 2 * pi * step / 100;
      error = std::max(error, std::hypot(u[0] - (std::sin(t) / t - 1), u[1] - (1 - std::cos(t)) / t));
      turn = std::max(turn, std::abs(u[5] / t - 1));
      if (static_cast<std::size_t>(step) > opensees.size()) return;
      const auto& row = opensees[static_cast<std::size_t>(step - 1)];
      difference = std::max({difference, std::abs(u[0] - row[1]), std::abs(u[1] - row[2]), std::abs(u[5] - row[3]) / pi});
    });
    // sixteen equal chords close
    rows.add(where + "1 - distance of the tip from the foot at the end / L", 1 - std::hypot(tip[0] + 1, tip[1]), 1, absolute(1e-8));
    rows.add(where + "1 - what leaves the plane at the end", 1 - Vector3(tip[2], tip[3], tip[4]).norm(), 1, absolute(1e-6));
    rows.add(where + "largest distance from the circle / L", error, 0, absolute(2.1e-3));
    rows.add(where + "1 - largest error of the rotation", 1 - turn, 1, absolute(1e-8));
    rows.add(where + "1 - largest difference from OpenSees / L", 1 - difference, 1, absolute(1e-6));
  }
}

TEST_CASE("a cantilever under end moment tends to its circle at second order") {
  std::vector<double> errors;
  for (const int elements : {8, 16, 32}) {
    const double t = 0.6 * 2 * pi;
    const Vector6 u = pushed(clamped(elements, slender(1e4), straight), t * Vector6::Unit(5), 30);
    errors.push_back(std::hypot(u[0] - (std::sin(t) / t - 1), u[1] - (1 - std::cos(t)) / t));
  }
  CHECK(order(errors[0], errors[1]) == doctest::Approx(2).epsilon(0.02));
  CHECK(order(errors[1], errors[2]) == doctest::Approx(2).epsilon(0.02));
}

VERIFICATION_CASE("Large displacements", "Elastica",
                  "Cantilever under a transverse tip load; 8, 16 and 32 corotational elements, extrapolated by their second order. Closed form "
                  "in elliptic integrals, five digits (Bisshopp and Drucker 1945).") {
  // P L^2 / EI, deflection / L, shortening / L
  for (const auto& [load, w, u] : {std::tuple{1.0, 0.30172, -0.05643}, {2.0, 0.49346, -0.16064}}) {
    std::vector<Vector6> tips;
    for (const int elements : {8, 16, 32}) {
      // rounding of the elongations alone leaves 1e-10 of the load
      tips.push_back(pushed(clamped(elements, slender(1e6), straight), load * Vector6::Unit(1), 4, [](int, const Vector6&) {},
                            StaticOptions{1e-8, 50, 10}));
    }
    const Vector6 limit = tips[2] + (tips[2] - tips[1]) / 3;
    const std::string at = fmt::format("P L^2/EI = {:g}: ", load);
    rows.add(at + "deflection / L", limit[1], w, absolute(5e-6));
    rows.add(at + "shortening / L", -limit[0], -u, absolute(5e-6));
    rows.add(at + "order of convergence", order((tips[0] - limit).norm(), (tips[1] - limit).norm()), 2, relative(0.03));
  }
}

VERIFICATION_CASE("Large displacements", "45-degree bend",
                  "Radius 100, square of 1, E = 1e7, G = E/2, GJ = 5e6/6, 600 across the tip (Bathe and Bolourchi 1979); corotational elements "
                  "in six steps. Printed values are those of eight straight elements; the limit, by second order, is the curved Kirchhoff rod "
                  "with the same EA, EI, GJ by shooting.") {
  const ElasticSection square{1e7, 5e6, 1.0, 1.0 / 12, 1.0 / 12, 1.0 / 6};
  const auto bend = [](double s) { return Vector3(100 * (1 - std::cos(s * pi / 4)), 100 * std::sin(s * pi / 4), 0); };
  std::vector<Vector3> tips;
  for (const int elements : {8, 16, 32})
    tips.push_back(pushed(clamped(elements, square, bend), 600 * Vector6::Unit(2), 6).head<3>());
  // Values printed elsewhere have other torsion constants: J = 0.1406 gives (-13.731, -23.817, 53.604).
  const Vector3 limit = tips[2] + (tips[2] - tips[1]) / 3, rod(-13.60396611, -23.55852791, 53.47176295), printed(-13.4, -23.5, 53.4);
  for (const int axis : {0, 1, 2}) {
    const std::string tip = fmt::format("tip along {}", "xyz"[axis]);
    rows.add(tip + ", eight elements", tips[0][axis], printed[axis], relative(0.02));
    rows.add(tip + ", limit", limit[axis], rod[axis], relative(4e-5));
  }
  rows.add("order of convergence", order((tips[0] - limit).norm(), (tips[1] - limit).norm()), 2, relative(0.05));
}

TEST_CASE("a cantilever with axial and lateral load has AISC Design Guide 25's sway and base moment") {
  const double L = 2.5, E = 210e9, I = 1.033e-5, H = 10;
  const double euler = pi * pi * E * I / (L * L);
  for (const Geometry geometry : {Geometry::p_delta, Geometry::corotational}) {
    for (const double ratio : {0.02, 0.1, 0.2}) {
      CAPTURE(ratio);
      const double u2 = pi * std::sqrt(ratio);  // 2u of the guide
      const double sway = H * L * L * L / (3 * E * I) * 3 * (std::tan(u2) - u2) / std::pow(u2, 3);
      const double base_moment = H * L * std::tan(u2) / u2;
      ModelDescription d = clamped(16, {E, 81e9, 3.142e-1, I, I, 8e-8}, [L](double s) { return Vector3(L * s, 0, 0); }, true);
      for (ElementDescription& e : d.structures[0].elements) e.geometry = geometry;
      Vector6 load = Vector6::Zero();
      load[0] = -ratio * euler;
      load[1] = H;
      const double tip = pushed(d, load, 1)[1];
      // the critical load of 16 elements is 8e-4 high; near it the amplification grows
      const double tolerance = 1e-3 * ratio / (0.25 - ratio) + 1e-5;
      CHECK(std::abs(tip / sway - 1) < tolerance);
      CHECK(std::abs((H * L + ratio * euler * tip) / base_moment - 1) < tolerance);
    }
  }
}

VERIFICATION_CASE("Large displacements", "Von Mises truss",
                  "Two corotational trusses, half span 1 m, rise 0.2 m, EA = 20 MN, under a load at the crown up to near its limit at about 0.42 "
                  "of the rise. Closed form P = 2 EA (L - l)/L (h - w)/l.") {
  const double b = 1, h = 0.2, E = 200e9, A = 1e-4, L = std::hypot(b, h);
  const auto load = [&](double w) {  // downwards, at the sag w of the crown
    const double l = std::hypot(b, h - w);
    return 2 * E * A * (L - l) / L * (h - w) / l;
  };
  ModelDescription d;
  d.materials = {{"m", {}, Elastic{E}}};
  StructureDescription s;
  s.name = "a";
  s.nodes = {node("1", -b, 0, 0), node("2", 0, 0, h), node("3", b, 0, 0)};
  s.supports = {fixed("1"), fixed("3"), fixed("2", {true, true, false, false, false, false})};
  s.elements = {bar("l", "1", "2", "m", A), bar("r", "2", "3", "m", A)};
  for (ElementDescription& e : s.elements) e.geometry = Geometry::corotational;
  d.structures = {s};
  const Model model = build(d);
  REQUIRE(model.dofs.size() == 1);
  System system(model, 1);
  State state = virgin_state(system);
  for (const double w : {0.02, 0.05, 0.08}) {  // the limit is at about 0.42 h
    solve_static(system, VectorX::Constant(1, -load(w)), StaticOptions{}, state);
    rows.add(fmt::format("sag under {:.2f} kN, m", 1e-3 * load(w)), -state.displacement[0], w, relative(1e-8));
  }
}

namespace {

// Kinetic and strain energy of a model of one group of corotational elastic beams.
double total_energy(const Model& model, const State& state) {
  const auto& beams = dynamic_cast<const ElasticBeams&>(*model.groups.front());
  const MemberGeometry& geometry = beam_geometry(Geometry::corotational);
  const VectorX full = model.dofs.expand(state.displacement);
  double energy = 0.5 * state.velocity.dot(model.mass * state.velocity);
  for (int e = 0; e < beams.size(); ++e) {
    Vector12 u;
    u << full.segment<6>(6 * beams.nodes(e)[0]), full.segment<6>(6 * beams.nodes(e)[1]);
    std::vector<double> scratch(static_cast<std::size_t>(geometry.history_size()));
    const Vector6 v = geometry.deformation(beams.frame(e), u, state.history.data() + beams.history_begin(e), scratch.data());
    const ElasticSection section{210e9, 81e9, 1e-3, 2e-7, 1e-7, 3e-7};
    energy += 0.5 * v.dot(elastic_basic_stiffness(section, beams.frame(e).length) * v);
  }
  return energy;
}

class EnergyDrift : public Observer {
 public:
  double largest = 0, turned = 0;
  void start(const Model& model, const State& state) override {
    model_ = &model;
    first_ = total_energy(model, state);
  }
  void step(const State&, const State& after, const StepReport&, const Energy&) override {
    largest = std::max(largest, std::abs(total_energy(*model_, after) / first_ - 1));
    turned = std::max(turned, model_->dofs.expand(after.displacement).tail<3>().norm());
  }

 private:
  const Model* model_ = nullptr;
  double first_ = 0;
};

EnergyDrift free_flight(double dt) {
  // hinged at one end, thrown around the hinge and out of the plane
  ModelDescription d = clamped(4, {210e9, 81e9, 1e-3, 2e-7, 1e-7, 3e-7}, [](double s) { return Vector3(2 * s, 0, 0); });
  StructureDescription& s = d.structures[0];
  s.supports = {fixed("0", {true, true, true, false, false, false})};
  s.may_move_freely = true;
  for (int i = 1; i <= 4; ++i) {
    s.masses.push_back(mass(std::to_string(i), 50, Vector3::Constant(0.5)));
    s.initial_velocities.push_back({{std::to_string(i), {}}, 1, 2.5 * i * i / 4});  // not of a rigid body
    s.initial_velocities.push_back({{std::to_string(i), {}}, 2, 1.5 * i * (4 - i)});
    s.initial_velocities.push_back({{std::to_string(i), {}}, 5, 5});
  }
  const Model model = build(d);
  AnalysisOptions options;
  options.scheme = "moreau-jean";
  options.theta = 0.5;
  options.dt = dt;
  options.duration = 1;
  Simulation simulation(model, options);
  EnergyDrift drift;
  const Summary summary = simulation.run({&drift});
  CHECK(std::abs(summary.energy.balance_error()) < 1e-6 * summary.energy.kinetic);
  return drift;
}

}  // namespace

TEST_CASE("an elastic beam that flies around a hinge keeps its energy, to second order of the step with theta = 1/2") {
  const EnergyDrift coarse = free_flight(1e-3), fine = free_flight(5e-4);
  CHECK(fine.turned > pi / 2);
  CHECK(fine.largest < 0.01);
  CHECK(order(coarse.largest, fine.largest) > 1.7);
}
