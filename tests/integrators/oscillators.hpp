// Models and runs for the tests of integrators.
#pragma once

#include "integrators/simulation.hpp"
#include "tests/support/recorder.hpp"
#include "tests/support/small_models.hpp"

namespace nsframe::test {

// A mass that is free in x only, node "s.1", on springs that the caller adds.
inline ModelDescription single_mass(double m, double x0 = 0, double v0 = 0) {
  ModelDescription d;
  StructureDescription s;
  s.name = "s";
  s.at = at(1);
  s.nodes = {node("1", 0, 0, 0)};
  s.supports = {fixed("1", {false, true, true, true, true, true})};
  s.masses = {mass("1", m)};
  if (x0 != 0) s.initial_displacements = {{{"1", {}}, 0, x0}};
  if (v0 != 0) s.initial_velocities = {{{"1", {}}, 0, v0}};
  d.structures = {s};
  return d;
}

inline ModelDescription linear_oscillator(double m, double k, double xi, double x0 = 0, double v0 = 0) {
  ModelDescription d = single_mass(m, x0, v0);
  SpringDescription spring = ground_spring("k", "1", k * Vector6::Unit(0));
  spring.damping[0] = 2 * xi * std::sqrt(k * m);
  d.structures[0].springs = {spring};
  return d;
}

inline ModelDescription nonlinear_oscillator(double m, const UniaxialLaw& law, double x0 = 0, double v0 = 0) {
  ModelDescription d = single_mass(m, x0, v0);
  d.materials = {{"law", {}, law}};
  SpringDescription spring = ground_spring("k", "1", Vector6::Zero());
  spring.law[0] = Reference{"law", {}};
  d.structures[0].springs = {spring};
  return d;
}

inline ContactDescription wall(const std::string& node, double gap, double e) {
  ContactDescription c;
  c.kind = ContactKind::nodes;
  c.a = {node, {}};
  c.gap = {gap};
  c.restitution = e;
  return c;
}

// A yielding mass thrown at another one, both on springs with hardening: impacts while both yield.
inline ModelDescription yielding_masses(const UniaxialLaw& law) {
  ModelDescription d = nonlinear_oscillator(1000, law, 0, 1.5);
  ModelDescription other = nonlinear_oscillator(700, law);
  d.structures.push_back(other.structures[0]);
  d.structures[1].name = "t";
  ContactDescription c = wall("s.1", 0.01, 0.6);
  c.b = Reference{"t.1", {}};
  d.contacts = {c};
  return d;
}

// Two fiber cantilevers of three elements each side by side, the first moving towards the second, 1 cm apart.
inline ModelDescription fiber_pair(const UniaxialLaw& law, ElementKind kind, double velocity, Geometry geometry = Geometry::linear) {
  ModelDescription d;
  d.materials = {{"steel", {}, law}};
  FiberSectionDescription section;
  for (int i = 0; i < 6; ++i) {
    for (int j = 0; j < 4; ++j) section.fibers.push_back({0.02 * (i - 2.5), 0.02 * (j - 1.5), 1e-4, {"steel", {}}});
  }
  section.torsion_stiffness = 1e5;
  d.sections.resize(1);
  d.sections[0].name = "f";
  d.sections[0].kind = section;
  for (int b = 0; b < 2; ++b) {
    StructureDescription s;
    s.name = b == 0 ? "a" : "b";
    for (int i = 0; i <= 3; ++i) s.nodes.push_back(node(std::to_string(i), 0.5 * b, 0, i));
    s.supports = {fixed("0")};
    for (int i = 0; i < 3; ++i) {
      s.elements.push_back(beam(std::to_string(i), std::to_string(i), std::to_string(i + 1), "f", kind));
      s.elements.back().geometry = geometry;
      s.masses.push_back(mass(std::to_string(i + 1), 300 + 200 * b));
      if (b == 0) s.initial_velocities.push_back({{std::to_string(i + 1), {}}, 0, velocity * (i + 1) * (i + 1) / 9});
    }
    d.structures.push_back(s);
  }
  ContactDescription c = wall("a.3", 0.01, 0.6);
  c.b = Reference{"b.3", {}};
  d.contacts = {c};
  return d;
}

inline AnalysisOptions options(double theta, double dt, double duration) {
  AnalysisOptions o;
  o.scheme = "moreau-jean";
  o.theta = theta;
  o.dt = dt;
  o.duration = duration;
  return o;
}

struct Run {
  Summary summary;
  std::vector<State> states;
  std::vector<Impact> observed;
};

inline Run run(const ModelDescription& description, const AnalysisOptions& options) {
  const Model model = build(description);
  Simulation simulation(model, options);
  Recorder recorder;
  Run result;
  result.summary = simulation.run({&recorder});
  result.states = std::move(recorder.states);
  result.observed = std::move(recorder.impacts);
  return result;
}

// Masses of 2 and 3 kg, 0.1 m apart; the first moves at 1.5 m/s.
inline ModelDescription two_free_masses(double e) {
  ModelDescription d = single_mass(2, 0, 1.5);
  d.structures[0].may_move_freely = true;
  d.structures.push_back(d.structures[0]);
  d.structures[1].name = "r";
  d.structures[1].masses = {mass("1", 3)};
  d.structures[1].initial_velocities.clear();
  ContactDescription c = wall("s.1", 0.1, e);
  c.b = Reference{"r.1", {}};
  d.contacts = {c};
  return d;
}

}  // namespace nsframe::test
