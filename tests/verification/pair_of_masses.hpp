// Masses on springs in a row along x, the smallest pounding models.
#pragma once

#include <fmt/format.h>

#include "models/model.hpp"
#include "tests/support/recorder.hpp"

namespace nsframe::test {

struct Oscillator {
  double mass, stiffness, damping_ratio, displacement = 0, velocity = 0;  // [kg], [N/m], [-], [m], [m/s]
};

// One structure "s<i>" an oscillator, with one node "1" that is free in x only.
inline StructureDescription oscillator(int index, const Oscillator& o) {
  StructureDescription s;
  s.name = fmt::format("s{}", index);
  s.nodes.push_back({"1", {}, Vector3(index, 0, 0)});
  s.supports.push_back({{"1", {}}, {false, true, true, true, true, true}});
  s.masses.push_back({{"1", {}}, Vector3::Constant(o.mass), Vector3::Zero()});
  s.may_move_freely = o.stiffness == 0;
  if (o.stiffness > 0) {
    SpringDescription spring;
    spring.id = "k";
    spring.node_i = {"1", {}};
    spring.stiffness[0] = o.stiffness;
    s.springs.push_back(spring);
  }
  if (o.damping_ratio > 0) {
    s.damping.kind = DampingKind::modal;
    s.damping.ratios = {o.damping_ratio};
  }
  if (o.displacement != 0) s.initial_displacements.push_back({{"1", {}}, 0, o.displacement});
  if (o.velocity != 0) s.initial_velocities.push_back({{"1", {}}, 0, o.velocity});
  return s;
}

inline ContactDescription contact_of(int a, int b, double gap, double restitution) {
  ContactDescription c;
  c.kind = ContactKind::nodes;
  c.a = {fmt::format("s{}.1", a), {}};
  if (b >= 0) c.b = Reference{fmt::format("s{}.1", b), {}};
  c.gap = {gap};
  c.gap_tolerance = 10;  // the masses stand apart to be told from each other
  c.restitution = restitution;
  return c;
}

inline ModelDescription row(const std::vector<Oscillator>& bodies) {
  ModelDescription d;
  for (std::size_t i = 0; i < bodies.size(); ++i) d.structures.push_back(oscillator(static_cast<int>(i), bodies[i]));
  return d;
}

inline ModelDescription pull_back(double e, double xi) {
  ModelDescription d = row({{4600, 2.11e6, xi, -0.024}, {3500, 5.31e6, xi}});
  d.contacts = {contact_of(0, 1, 0.02, e)};
  return d;
}

}  // namespace nsframe::test
