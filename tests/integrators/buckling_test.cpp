// Linear buckling against closed forms. Cantilevers by the number of elements: tests/verification/buckling_test.cpp; the
// ratios to Euler's load come from there.
#include <doctest/doctest.h>

#include <cmath>

#include "base/errors.hpp"
#include "integrators/buckling.hpp"
#include "integrators/static_analysis.hpp"
#include "tests/integrators/oscillators.hpp"

using namespace nsframe;
using namespace nsframe::test;

namespace {

constexpr double height = 2.5, E = 210e9, I = 1.033e-5;  // [m], [Pa], [m4]
enum class End { free, guided, pinned, fixed };

// A column in the x-z plane, fixed or pinned at its foot.
ModelDescription column(int elements, End foot, End head) {
  ModelDescription d;
  d.sections = {elastic_section("c", {E, 81e9, 3.142e-3, I, I, 8e-8})};
  StructureDescription s;
  s.name = "a";
  for (int i = 0; i <= elements; ++i) s.nodes.push_back(node(std::to_string(i), 0, 0, height * i / elements));
  const bool foot_turns = foot == End::pinned;
  s.supports = {fixed("0", {true, true, true, true, !foot_turns, true})};
  for (int i = 0; i < elements; ++i) {
    s.elements.push_back(beam(std::to_string(i), std::to_string(i), std::to_string(i + 1), "c"));
    s.elements.back().geometry = Geometry::p_delta;
    const bool last = i + 1 == elements;
    const bool held = last && (head == End::pinned || head == End::fixed), clamped = last && (head == End::guided || head == End::fixed);
    s.supports.push_back(fixed(std::to_string(i + 1), {held, true, false, true, clamped, true}));
  }
  d.structures = {s};
  return d;
}

double critical(const ModelDescription& d, const std::string& top) {
  const Model model = build(d);
  System system(model, 1);
  VectorX load = VectorX::Zero(model.dofs.full);
  load[full_dof(model, top, 2)] = -1;
  return buckling_modes(system, virgin_state(system), model.dofs.transformation_transposed * load, 1).at(0).load_factor;
}

}  // namespace

TEST_CASE("columns that are two or four cantilevers have their critical loads") {
  const double unit = pi * pi * E * I / (height * height);
  // effective lengths L, L and L/2, made of two, two and four cantilevers
  CHECK(critical(column(8, End::pinned, End::pinned), "a.8") / unit == doctest::Approx(1.0129150629).epsilon(2e-6));
  CHECK(critical(column(8, End::fixed, End::guided), "a.8") / unit == doctest::Approx(1.0129150629).epsilon(2e-6));
  CHECK(critical(column(16, End::fixed, End::fixed), "a.16") / (4 * unit) == doctest::Approx(1.0129150629).epsilon(2e-6));
}

TEST_CASE("the critical load of a fixed and pinned column tends to 20.19 EI/L^2 at second order") {
  const double root = 4.493409457909064;  // tan x = x
  const double exact = root * root * E * I / (height * height);
  const double coarse = critical(column(8, End::fixed, End::pinned), "a.8") / exact - 1;
  const double fine = critical(column(16, End::fixed, End::pinned), "a.16") / exact - 1;
  CHECK(fine > 0);
  CHECK(fine < 0.01);
  CHECK(std::log2(coarse / fine) == doctest::Approx(2).epsilon(0.03));
}

TEST_CASE("a portal with a rigid beam sways at the load of its guided columns, one with hinged feet at a quarter") {
  for (const bool hinged : {false, true}) {
    ModelDescription d = column(8, hinged ? End::pinned : End::fixed, End::free);
    // columns so stiff along their axis that the beam doesn't turn
    d.sections = {elastic_section("c", {E, 81e9, 3.142, I, I, 8e-8})};
    d.sections.push_back(elastic_section("rigid", {E, 81e9, 3.142, 1e6 * I, 1e6 * I, 8e-8}));
    StructureDescription& s = d.structures[0];
    const auto elements = s.elements;
    const auto supports = s.supports;
    for (int i = 0; i <= 8; ++i) s.nodes.push_back(node("r" + std::to_string(i), 4, 0, height * i / 8));
    for (ElementDescription e : elements) {
      e.id = "r" + e.id;
      e.node_i.name = "r" + e.node_i.name;
      e.node_j.name = "r" + e.node_j.name;
      s.elements.push_back(e);
    }
    for (SupportDescription support : supports) {
      support.node.name = "r" + support.node.name;
      s.supports.push_back(support);
    }
    s.elements.push_back(beam("top", "8", "r8", "rigid"));
    const Model model = build(d);
    System system(model, 1);
    VectorX load = VectorX::Zero(model.dofs.full);
    load[full_dof(model, "a.8", 2)] = load[full_dof(model, "a.r8", 2)] = -1;
    const auto modes = buckling_modes(system, virgin_state(system), model.dofs.transformation_transposed * load, 2);
    const double euler = pi * pi * E * I / (height * height) * (hinged ? 0.25 : 1);
    // a guided column of eight elements is two cantilevers of four; a hinged one is a cantilever of eight.
    REQUIRE_FALSE(modes.empty());
    CHECK(modes[0].load_factor / euler == doctest::Approx(hinged ? 1.0032166167 : 1.0129150629).epsilon(2e-5));
    const VectorX full = model.dofs.expand(modes[0].shape);
    CHECK(std::abs(full[full_dof(model, "a.8", 0)]) == doctest::Approx(1).epsilon(1e-6));
  }
}

TEST_CASE("constant loads take their part of the critical load") {
  const Model model = build(column(4, End::fixed, End::free));
  System system(model, 1);
  VectorX load = VectorX::Zero(model.dofs.full);
  load[full_dof(model, "a.4", 2)] = -1;
  const VectorX pattern = model.dofs.transformation_transposed * load;
  const double whole = buckling_modes(system, virgin_state(system), pattern, 1).at(0).load_factor;
  State state = virgin_state(system);
  solve_static(system, 0.4 * whole * pattern, {}, state);
  CHECK(buckling_modes(system, state, pattern, 1).at(0).load_factor == doctest::Approx(0.6 * whole).epsilon(1e-6));
  State beyond = virgin_state(system);
  solve_static(system, 1.2 * whole * pattern, {}, beyond);
  CHECK_THROWS_WITH_AS(buckling_modes(system, beyond, pattern, 1), doctest::Contains("not stable under the constant loads"), ConvergenceError);
}

TEST_CASE("tension and linear geometry have no critical load") {
  const auto modes_of = [](Geometry geometry, double force) {
    ModelDescription d = column(4, End::fixed, End::free);
    for (ElementDescription& e : d.structures[0].elements) e.geometry = geometry;
    const Model model = build(d);
    System system(model, 1);
    VectorX load = VectorX::Zero(model.dofs.full);
    load[full_dof(model, "a.4", 2)] = force;
    return buckling_modes(system, virgin_state(system), model.dofs.transformation_transposed * load, 3);
  };
  CHECK(modes_of(Geometry::p_delta, 1).empty());
  CHECK(modes_of(Geometry::linear, -1).empty());
}

namespace {

constexpr double concrete_area = 5e-3, arm = 0.06, strength = 30e6;  // of each of four fibers [m2]; [m], [Pa]
constexpr double four_elements = 1.0129150629;                        // their critical load over Euler's

// A cantilever of four elements of four fibers of Concrete02, whose envelope is a parabola up to its strength.
ModelDescription concrete_column(ElementKind kind) {
  const Concrete02 concrete{-strength, -0.002, -6e6, -0.006, 0.1, 2.5e6, 2.5e9};
  ModelDescription d = column(4, End::fixed, End::free);
  d.materials = {{"m", {}, concrete}};
  FiberSectionDescription section;
  for (const double y : {-arm, arm})
    for (const double z : {-arm, arm}) section.fibers.push_back({y, z, concrete_area, {"m", {}}});
  section.torsion_stiffness = 1e6;
  d.sections = {{"c", {}, section, {}}};
  for (ElementDescription& e : d.structures[0].elements) e.kind = kind;
  return d;
}

// Euler's load of it by the tangent modulus on the envelope, E_c sqrt(1 - P/(A f_c)), under the axial force P.
double euler_under(double force) {
  const double modulus = 2 * strength / 0.002 * std::sqrt(1 - force / (4 * concrete_area * strength));
  return pi * pi * modulus * 4 * concrete_area * arm * arm / (4 * height * height);
}

VectorX unit_weight(const Model& model) {
  VectorX load = VectorX::Zero(model.dofs.full);
  load[full_dof(model, "a.4", 2)] = -1;
  return model.dofs.transformation_transposed * load;
}

}  // namespace

TEST_CASE("a column of a curved law buckles by its tangent modulus, whatever its curvature") {
  for (const ElementKind kind : {ElementKind::displacement_beam, ElementKind::force_beam}) {
    CHECK(critical(concrete_column(kind), "a.4") / euler_under(0) == doctest::Approx(four_elements).epsilon(2e-6));
  }
}

TEST_CASE("under a constant load a column of Concrete02 buckles by the tangent of loading at its stress") {
  for (const ElementKind kind : {ElementKind::displacement_beam, ElementKind::force_beam}) {
    const Model model = build(concrete_column(kind));
    for (const double force : {100e3, 250e3}) {
      System system(model, 1);
      const VectorX pattern = unit_weight(model);
      State state = virgin_state(system);
      solve_static(system, force * pattern, {}, state);
      const double more = buckling_modes(system, state, pattern, 1).at(0).load_factor;
      // a state that 1e-9 of the height has shortened: 1e-6 of the strain at the strength
      CHECK((force + more) / euler_under(force) == doctest::Approx(four_elements).epsilon(4e-6));
    }
  }
}

TEST_CASE("a column of Concrete02 that leans a little carries its tangent modulus load, and not much more") {
  // P = four_elements euler_under(P): Engesser's load; a column on its way there cannot carry the elastic one
  const double elastic = four_elements * euler_under(0), e = elastic / (4 * concrete_area * strength);
  const double engesser = 4 * concrete_area * strength * (-e * e + e * std::sqrt(e * e + 4)) / 2;
  REQUIRE(engesser < 0.8 * elastic);
  ModelDescription d = concrete_column(ElementKind::displacement_beam);
  StageDescription stage;
  stage.name = "weight";
  stage.loads = {{{"a.4", {}}, 2, -1}, {{"a.4", {}}, 0, 1e-4}};
  stage.control_node = Reference{"a.4", {}};
  stage.options.control = "displacement";
  stage.options.targets = {0.1};
  stage.options.step = 1e-4;  // larger ones meet equilibria in tension on the first points, which rounding chooses
  d.stages = {stage};
  d.structures[0].masses = {mass("4", 1)};
  const Model model = build(d);
  Simulation simulation(model, options(1, 1e-3, 0));
  std::vector<StageResult> results;
  REQUIRE_MESSAGE(simulation.run_stages(1, {{"auto"}, {}, {}}, results), results.back().stop_reason);
  double most = 0;
  for (const StagePoint& point : results[0].points) most = std::max(most, point.load_factor);
  CHECK(most > 0.97 * engesser);
  CHECK(most < 1.03 * engesser);
  // and at Engesser's load the buckling analysis has nothing left to add
  System system(model, 1);
  State state = virgin_state(system);
  solve_static(system, 0.999 * engesser * unit_weight(model), {}, state);
  const double more = buckling_modes(system, state, unit_weight(model), 1).at(0).load_factor;
  CHECK(more / engesser == doctest::Approx(four_elements * euler_under(0.999 * engesser) / engesser - 0.999).epsilon(1e-2));
}

TEST_CASE("a mast buckles under its own weight at Greenhill's height, as a load along its members") {
  // q L^3 / EI = 9/4 j^2 with the first zero j of J_{-1/3} (Greenhill 1881)
  const double j = 1.866350858873895, exact = 2.25 * j * j * E * I / (height * height * height);
  for (const Geometry geometry : {Geometry::p_delta, Geometry::corotational}) {
    const auto factor = [geometry](int elements) {
      ModelDescription d = column(elements, End::fixed, End::free);
      LoadDescription weight;
      weight.uniform = Vector3(0, 0, -1);
      for (ElementDescription& e : d.structures[0].elements) {
        e.geometry = geometry;
        weight.elements.push_back({e.id, {}});
      }
      d.structures[0].loads = {weight};
      const Model model = build(d);
      System system(model, 1);
      REQUIRE(model.loaded());
      return buckling_modes(system, virgin_state(system), VectorX::Zero(model.dofs.size()), 1, 1).at(0).load_factor;
    };
    const double coarse = factor(8) / exact - 1, fine = factor(16) / exact - 1;
    CAPTURE(coarse);
    CAPTURE(fine);
    CHECK(std::abs(fine) < 0.004);
    CHECK(std::abs(fine + (fine - coarse) / 3) < 1e-3);  // of second order
  }
}
