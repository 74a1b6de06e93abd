// Plane frames of the verification manuals: modes and static response.
#include <fmt/format.h>

#include "integrators/simulation.hpp"
#include "integrators/static_analysis.hpp"
#include "output/member_forces.hpp"
#include "tests/support/small_models.hpp"
#include "tests/verification/registry.hpp"

using namespace nsframe;
using namespace nsframe::test;

namespace {

// ux, uz and ry are free: a frame in the x-z plane.
constexpr std::array<bool, 6> out_of_plane{false, true, false, true, false, true};

// Only A and Iz matter in the plane.
SectionDescription plane_section(const std::string& name, double E, double A, double I) {
  return elastic_section(name, {E, E, A, I, I, I});
}

// Nodes "<column>.<floor>" on a grid, the lowest fixed.
StructureDescription grid(int bays, double bay, const std::vector<double>& levels) {
  StructureDescription s;
  s.name = "frame";
  for (int column = 0; column <= bays; ++column) {
    for (std::size_t floor = 0; floor < levels.size(); ++floor) {
      const std::string id = fmt::format("{}-{}", column, floor);
      s.nodes.push_back(node(id, bay * column, 0, levels[floor]));
      s.supports.push_back(floor == 0 ? fixed(id) : fixed(id, out_of_plane));
    }
  }
  return s;
}

VectorX circular_frequencies(const Model& model, int modes) {
  return Simulation(model, AnalysisOptions{}, modes).modes()[0].modes.circular_frequency;
}

ModelDescription bathe_wilson() {
  ModelDescription d;
  d.sections = {plane_section("all", 432000, 3, 1)};
  StructureDescription s = grid(10, 20, {0, 10, 20, 30, 40, 50, 60, 70, 80, 90});
  for (int column = 0; column <= 10; ++column) {
    for (int floor = 1; floor <= 9; ++floor) {
      const std::string id = fmt::format("{}-{}", column, floor);
      s.elements.push_back(beam("c" + id, fmt::format("{}-{}", column, floor - 1), id, "all"));
      if (column > 0) s.elements.push_back(beam("b" + id, fmt::format("{}-{}", column - 1, floor), id, "all"));
      const double columns = floor == 9 ? 1 : 2, beams = column == 0 || column == 10 ? 1 : 2;
      s.masses.push_back(mass(id, 3 * (columns * 10 + beams * 20) / 2));  // half of each member
    }
  }
  d.structures = {s};
  return d;
}

ModelDescription seven_story_portal() {
  ModelDescription d;
  for (const auto& [name, A, I] : {std::tuple{"W14X176", 51.7, 2150.0}, {"W14X211", 62.1, 2670.0}, {"W14X246", 72.3, 3230.0},
                                   {"W14X287", 84.4, 3910.0}, {"W24X110", 32.5, 3330.0}, {"W24X130", 38.3, 4020.0},
                                   {"W24X160", 47.1, 5120.0}}) {
    d.sections.push_back(plane_section(name, 29500, A, I));
  }
  const std::array<const char*, 7> outer{"W14X246", "W14X246", "W14X246", "W14X211", "W14X211", "W14X176", "W14X176"},
      inner{"W14X287", "W14X287", "W14X287", "W14X246", "W14X246", "W14X211", "W14X211"},
      beams{"W24X160", "W24X160", "W24X130", "W24X130", "W24X110", "W24X110", "W24X110"};
  StructureDescription s = grid(2, 360, {0, 162, 324, 480, 636, 792, 948, 1104});
  for (std::size_t floor = 1; floor <= 7; ++floor) {
    for (int column = 0; column <= 2; ++column) {
      const std::string id = fmt::format("{}-{}", column, floor);
      s.elements.push_back(beam("c" + id, fmt::format("{}-{}", column, floor - 1), id, (column == 1 ? inner : outer)[floor - 1]));
      if (column > 0) s.elements.push_back(beam("b" + id, fmt::format("{}-{}", column - 1, floor), id, beams[floor - 1]));
    }
    ConstraintDescription level = constraint(ConstraintKind::equal_dof, fmt::format("1-{}", floor), {fmt::format("0-{}", floor), fmt::format("2-{}", floor)});
    level.dofs = {true, false, false, false, false, false};
    s.constraints.push_back(level);
    s.masses.push_back({{fmt::format("1-{}", floor), {}}, Vector3(0.49, 0, 0), Vector3::Zero()});
  }
  d.structures = {s};
  return d;
}

State at_rest_under(System& system, const std::vector<std::pair<int, double>>& loads) {
  const Model& model = system.model;
  VectorX load = VectorX::Zero(model.dofs.full);
  for (const auto& [dof, force] : loads) load[dof] += force;
  State state = virgin_state(system);
  solve_static(system, model.dofs.transformation_transposed * load, StaticOptions{}, state);
  return state;
}

Vector12 end_forces_of(const Model& model, const State& state, const std::string& element) {
  const VectorX displacement = model.dofs.expand(state.displacement);
  EndForces forces;
  for (std::size_t g = 0; g < model.groups.size(); ++g) {
    for (int e = 0; e < model.groups[g]->size(); ++e) {
      if (model.groups[g]->id(e) == element) return forces.evaluate(model, g, e, state, displacement);
    }
  }
  FAIL("no element " << element);
  return Vector12::Zero();
}

}  // namespace

VERIFICATION_CASE("Modes", "Bathe-Wilson frame",
                  "Ten bays of 20 ft, nine floors of 10 ft, every member with A = 3 ft2, I = 1 ft4, E = 432000 kip/ft2 and a lumped "
                  "mass of 3 kip s2/ft2. Bathe and Wilson, J. Eng. Mech. Div. 98 (1972) 1471; Peterson (1981).") {
  const VectorX w = circular_frequencies(build(bathe_wilson()), 3);
  const std::array<double, 3> published{0.589541, 5.52695, 16.5878};
  for (int i = 0; i < 3; ++i) rows.add(fmt::format("eigenvalue {}, 1/s2", i + 1), w[i] * w[i], published[static_cast<std::size_t>(i)], relative(1e-5));
}

VERIFICATION_CASE("Modes", "Seven-story portal frame",
                  "Two bays of 30 ft, W14 columns and W24 beams, ux equal on each floor, 0.49 kip s2/in a floor (Bernoulli beams). SAP2000 "
                  "verification manual; also an example of SeismoStruct and OpenSees.") {
  const VectorX w = circular_frequencies(build(seven_story_portal()), 7);
  const std::array<double, 7> published{1.2732, 0.4313, 0.2420, 0.1602, 0.1190, 0.0951, 0.0795};
  for (int i = 0; i < 7; ++i) rows.add(fmt::format("period {}, s", i + 1), 2 * pi / w[i], published[static_cast<std::size_t>(i)], absolute(5.1e-5));
}

VERIFICATION_CASE("Frames", "Seven-story portal frame under lateral loads",
                  "The same frame under 20, 15, 12.5, 10, 7.5, 5 and 2.5 kip on its floors from the top. SAP2000 verification manual.") {
  const Model model = build(seven_story_portal());
  System system(model, 1);
  std::vector<std::pair<int, double>> loads;
  const std::array<double, 7> force{2.5, 5, 7.5, 10, 12.5, 15, 20};
  for (std::size_t floor = 1; floor <= 7; ++floor) loads.emplace_back(full_dof(model, fmt::format("frame.0-{}", floor), 0), force[floor - 1]);
  const State state = at_rest_under(system, loads);
  const Vector12 base = end_forces_of(model, state, "frame.c0-1");
  rows.add("roof displacement, in", model.dofs.expand(state.displacement)[full_dof(model, "frame.0-7", 0)], 1.45076, relative(1e-5));
  rows.add("axial force of the left column at the base, kip", std::abs(base[0]), 69.99, absolute(0.0051));
  rows.add("its moment at the base, kip in", std::abs(base[5]), 2324.68, absolute(0.0051));
}

VERIFICATION_CASE("Modes", "Chain of three masses", "Springs 30, 20, 10 from the ground on, masses 11.1, 22.2, 33.3. OpenSees verification suite.") {
  ModelDescription d;
  StructureDescription s;
  s.name = "chain";
  const std::array<double, 3> stiffness{30, 20, 10}, masses{11.1, 22.2, 33.3};
  for (std::size_t i = 0; i < 3; ++i) {
    const std::string id = std::to_string(i + 1);
    s.nodes.push_back(node(id, 0, 0, 0));
    s.supports.push_back(fixed(id, {false, true, true, true, true, true}));
    s.masses.push_back(mass(id, masses[i]));
    SpringDescription spring = ground_spring("k" + id, id, stiffness[i] * Vector6::Unit(0));
    if (i > 0) spring.node_j = Reference{std::to_string(i), {}};
    s.springs.push_back(spring);
  }
  d.structures = {s};
  const VectorX w = circular_frequencies(build(d), 3);
  const std::array<double, 3> published{0.1393006, 1.0586531, 4.9582024};
  for (int i = 0; i < 3; ++i) rows.add(fmt::format("eigenvalue {}, 1/s2", i + 1), w[i] * w[i], published[static_cast<std::size_t>(i)], relative(1e-6));
}

VERIFICATION_CASE("Frames", "P-Delta cantilever",
                  "A = 51.7 in2, I = 2150 in4, L = 196 in, E = 29500 ksi, ten elastic elements, 10 kip across the tip and a share of the "
                  "buckling load along; ten elements of this theory buckle 0.2 % high. Closed form tan(2u) of AISC Design Guide 25 (Kaehler, White, Kim 2011).") {
  const double L = 196, E = 29500, I = 2150, H = 10, buckling = pi * pi * E * I / (4 * L * L);
  constexpr int elements = 10;
  ModelDescription d;
  d.sections = {plane_section("W", E, 51.7, I)};
  StructureDescription s;
  s.name = "column";
  for (int i = 0; i <= elements; ++i) {
    s.nodes.push_back(node(std::to_string(i), 0, 0, L * i / elements));
    s.supports.push_back(i == 0 ? fixed("0") : fixed(std::to_string(i), out_of_plane));
    if (i == 0) continue;
    s.elements.push_back(beam("e" + std::to_string(i), std::to_string(i - 1), std::to_string(i), "W"));
    s.elements.back().geometry = Geometry::p_delta;
  }
  d.structures = {s};
  const Model model = build(d);
  for (const double share : {0.2, 0.4, 0.6}) {
    System system(model, 1);
    const int tip = full_dof(model, "column.10", 0);
    const State state = at_rest_under(system, {{tip, H}, {tip + 2, -share * buckling}});
    const double u2 = pi * std::sqrt(share / 4);  // 2 u
    rows.add(fmt::format("tip displacement at {:g} of the buckling load, in", share), model.dofs.expand(state.displacement)[tip],
             H * L * L * L / (3 * E * I) * 3 * (std::tan(u2) - u2) / (u2 * u2 * u2), relative(5e-3));
    rows.add(fmt::format("base moment at {:g} of the buckling load, kip in", share), std::abs(end_forces_of(model, state, "column.e1")[5]),
             H * L * std::tan(u2) / u2, relative(2e-3));
  }
}
