// Static equilibrium: P-Delta against beam-column theory, buckling, slack cables, pretension.
#include <doctest/doctest.h>

#include <cmath>

#include "base/decompositions.hpp"
#include "integrators/algorithms.hpp"
#include "integrators/static_analysis.hpp"
#include "tests/integrators/oscillators.hpp"
#include "tests/support/numbers.hpp"
#include "tests/support/reference_data.hpp"

using namespace nsframe;
using namespace nsframe::test;

namespace {

constexpr double height = 2.5, steel_E = 210e9, I = 1.033e-5;  // [m], [Pa], [m4]

ModelDescription plane_cantilever(int elements, Geometry geometry = Geometry::p_delta) {
  ModelDescription d;
  d.sections = {elastic_section("c", {steel_E, 81e9, 3.142e-3, I, I, 8e-8})};
  StructureDescription s;
  s.name = "a";
  for (int i = 0; i <= elements; ++i) s.nodes.push_back(node(std::to_string(i), 0, 0, height * i / elements));
  s.supports = {fixed("0")};
  for (int i = 0; i < elements; ++i) {
    s.elements.push_back(beam(std::to_string(i), std::to_string(i), std::to_string(i + 1), "c"));
    s.elements.back().geometry = geometry;
    s.supports.push_back(fixed(std::to_string(i + 1), {false, true, false, true, false, true}));
  }
  d.structures = {s};
  return d;
}

// Tip displacement under the lateral load 1000 N and the axial load `axial`, compressive.
double tip_displacement(int elements, double axial) {
  const Model model = build(plane_cantilever(elements));
  System system(model, 1);
  State state = virgin_state(system);
  VectorX load = VectorX::Zero(model.dofs.full);
  load[6 * elements] = 1000;
  load[6 * elements + 2] = -axial;
  solve_static(system, model.dofs.transformation_transposed * load, StaticOptions{}, state);
  return model.dofs.expand(state.displacement)[6 * elements];
}

bool stable_under(int elements, double axial, Geometry geometry) {
  const Model model = build(plane_cantilever(elements, geometry));
  System system(model, 1);
  State state = virgin_state(system);
  VectorX load = VectorX::Zero(model.dofs.full);
  load[6 * elements + 2] = -axial;
  solve_static(system, model.dofs.transformation_transposed * load, StaticOptions{}, state);
  const MatrixX K(system.assembler.tangent());
  return K.eigenvalues().real().minCoeff() > 0;
}

}  // namespace

TEST_CASE("a P-Delta cantilever of one element sways as H / (3 EI/L^3 - P/L)") {
  const double stiffness = 3 * steel_E * I / std::pow(height, 3);
  for (const double axial : {0.0, 1e5, 3e5, -2e5}) {
    CHECK(tip_displacement(1, axial) == doctest::Approx(1000 / (stiffness - axial / height)).epsilon(1e-9));  // static tolerance 1e-10
  }
}

TEST_CASE("a P-Delta cantilever of several elements tends to the beam-column solution, at second order") {
  for (const double ratio : {0.1, 0.4, 0.7}) {
    const double axial = ratio * pi * pi * steel_E * I / (4 * height * height);
    const double u = height * std::sqrt(axial / (steel_E * I));
    const double exact = 1000 * std::pow(height, 3) / (3 * steel_E * I) * 3 * (std::tan(u) - u) / std::pow(u, 3);
    const double coarse = std::abs(tip_displacement(4, axial) / exact - 1), fine = std::abs(tip_displacement(16, axial) / exact - 1);
    CHECK(fine < 1e-3 * ratio / (1 - ratio) * 1.5);  // the critical load of 16 elements is 8e-4 high
    CHECK(std::log(coarse / fine) / std::log(4.0) == doctest::Approx(2).epsilon(0.05));
  }
}

TEST_CASE("a cantilever loses its stability at OpenSees' load, P-Delta and corotational") {
  const double euler = pi * pi * steel_E * I / (4 * height * height);
  CHECK(euler == doctest::Approx(856405.313).epsilon(1e-9));
  for (const auto& row : read_reference("buckling")) {
    const Geometry geometry = row[0] == 0 ? Geometry::p_delta : Geometry::corotational;
    const int elements = static_cast<int>(row[1]);
    CAPTURE(elements);
    CAPTURE(row[0]);
    CHECK(stable_under(elements, row[2] * (1 - 2e-6), geometry));  // OpenSees' loads were bisected to 1e-6
    CHECK_FALSE(stable_under(elements, row[2] * (1 + 2e-6), geometry));
    // a corotational column is shortened by P/EA when it buckles: P (1 - P/EA) is Euler's load
    const double shortened = row[0] == 0 ? 1 : 1 / (1 - row[2] / (steel_E * 3.142e-3));
    if (elements == 16) CHECK(std::abs(row[2] / euler / shortened - 1) < 9e-4);  // (pi/32)^2/12
  }
}

TEST_CASE("gravity on a mass between two pretensioned cables makes the lower one slack") {
  const double EA = 160e9 * 1e-4, L = 2, weight = 1000 * 9.81;
  for (const double pretension : {2e3, 1e4}) {
    ModelDescription d = single_mass(1000);
    StructureDescription& s = d.structures[0];
    s.nodes = {node("1", 0, 0, 0), node("low", 0, 0, -L), node("high", 0, 0, L)};
    s.supports = {fixed("low"), fixed("high"), fixed("1", {true, true, false, true, true, true})};
    d.materials = {{"wire", {}, Elastic{160e9}}};
    s.elements = {bar("upper", "1", "high", "wire", 1e-4, ElementKind::cable), bar("lower", "1", "low", "wire", 1e-4, ElementKind::cable)};
    for (ElementDescription& cable : s.elements) cable.pretension = pretension;
    d.gravity.acceleration = Vector3(0, 0, -9.81);
    const Model model = build(d);
    Simulation simulation(model, options(1, 1e-3, 1));
    const bool slack = weight > 2 * pretension;
    CHECK(simulation.state().displacement[0] == doctest::Approx(slack ? -(weight - pretension) * L / EA : -weight * L / (2 * EA)).epsilon(1e-9));
    CHECK(simulation.initial_stiffness().coeff(0, 0) == doctest::Approx(slack ? EA / L : 2 * EA / L).epsilon(64 * epsilon));
  }
}

TEST_CASE("what stays at rest under gravity has no energy whose balance could be off") {
  ModelDescription d = single_mass(100, 0, 0);
  d.structures[0].supports = {fixed("1", {true, true, false, true, true, true})};
  d.structures[0].masses = {mass("1", 100)};
  d.materials = {{"soil", {}, ENT{1e6}}};
  SpringDescription spring = ground_spring("s", "1", Vector6::Zero());
  spring.law[2] = Reference{"soil", {}};
  d.structures[0].springs = {spring};
  d.gravity.acceleration = Vector3(0, 0, -9.81);
  for (const std::string scheme : {"moreau-jean", "exponential", "event-split"}) {
    CAPTURE(scheme);
    AnalysisOptions o = options(0.5, 1e-3, 0.05);
    o.scheme = scheme;
    const Run run = test::run(d, o);
    REQUIRE(run.summary.completed);
    CHECK(run.states.back().displacement[0] == doctest::Approx(-981e-6).epsilon(1e-9));
    CHECK(run.summary.worst_balance_error == 0);
  }
}

TEST_CASE("a pretensioned cable pulls a mass on a spring into equilibrium without other loads") {
  const double EA = 160e9 * 1e-4, L = 2, k = 3e5, pretension = 5e3;
  ModelDescription d = linear_oscillator(1000, k, 0);
  StructureDescription& s = d.structures[0];
  s.nodes.push_back(node("anchor", L, 0, 0));
  s.supports.push_back(fixed("anchor"));
  d.materials = {{"wire", {}, Elastic{160e9}}};
  s.elements = {bar("c", "1", "anchor", "wire", 1e-4, ElementKind::cable)};
  s.elements[0].pretension = pretension;
  const Model model = build(d);
  Simulation simulation(model, options(1, 1e-3, 1));
  CHECK(simulation.state().displacement[0] == doctest::Approx(pretension / (k + EA / L)).epsilon(1e-9));
}

TEST_CASE("a load that a perfectly plastic spring cannot carry ends with the element's name") {
  const Model model = build(nonlinear_oscillator(1, ElasticPP{1e5, 1e-2}));
  System system(model, 1);
  State state = virgin_state(system);
  solve_static(system, VectorX::Constant(1, 900), StaticOptions{}, state);
  CHECK(state.displacement[0] == doctest::Approx(9e-3).epsilon(1e-9));
  CHECK_THROWS_WITH_AS(solve_static(system, VectorX::Constant(1, 1100), StaticOptions{}, state), doctest::Contains("largest in element 's.k'"),
                       ConvergenceError);
  CHECK(state.internal_force[0] <= 1000);
}

TEST_CASE("a residual that is not finite is called so, with an element, in place of a number that is none") {
  const Model model = build(nonlinear_oscillator(1, ElasticPP{1e5, 1e-2}));
  System system(model, 1);
  State state = virgin_state(system);
  const VectorX load = VectorX::Constant(1, 1e200);  // whose square is beyond all numbers
  CHECK_THROWS_WITH_AS(solve_static(system, load, StaticOptions{}, state),
                       doctest::Contains("(the residual is not finite), first in element 's.k'"), ConvergenceError);
  CHECK(told_residual(std::nan(""), "s.k") == "(the residual is not finite), first in element 's.k'");
  CHECK(told_residual(1.23e-3, "s.k") == "(relative residual 1.2e-03), largest in element 's.k'");
  // an element of the first DOF that has no number, whatever the others have
  const Model two = build(yielding_masses(Steel01{1e4, 1e6, 0.1}));
  const Assembler assembler(two);
  CHECK(assembler.worst_element(VectorX{{1e9, 1.0}}) == "s.k");
  CHECK(assembler.worst_element(VectorX{{1e9, std::nan("")}}) == "t.k");
}

TEST_CASE("gravity cannot act statically on a structure that may move freely") {
  ModelDescription d = single_mass(1);
  d.structures[0].may_move_freely = true;
  d.gravity.acceleration = Vector3(9.81, 0, 0);
  const Model model = build(d);
  CHECK_THROWS_WITH_AS(Simulation(model, options(1, 1e-3, 1)), doctest::Contains("s.toml:1:3: error: gravity cannot act statically on structure 's'"),
                       InputError);
}
