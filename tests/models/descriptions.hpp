// Descriptions that the tests of errors start from.
#pragma once

#include "tests/support/small_models.hpp"

namespace nsframe::test {

inline StructureDescription& only(ModelDescription& d) { return d.structures.front(); }

inline SectionDescription fibers(const std::string& name, double shift, const std::string& material) {
  FiberSectionDescription section;
  for (const double y : {-0.1, 0.1}) {
    for (const double z : {-0.05, 0.05}) section.fibers.push_back({y + shift, z, 1e-3, {material, at(30)}});
  }
  section.torsion_stiffness = 1e4;
  return {name, at(31), section, {}};
}

// Two columns with a slab of four nodes each, side by side; no contact yet.
inline ModelDescription two_slabs(double height_of_second = 3) {
  ModelDescription d;
  for (int i = 0; i < 2; ++i) {
    StructureDescription s;
    s.name = i == 0 ? "left" : "right";
    s.at = at(40 + i);
    const double x = 2.1 * i, z = i == 0 ? 3 : height_of_second;
    s.nodes = {node("1", x, 0, z), node("2", x + 2, 0, z), node("3", x + 2, 1, z), node("4", x, 1, z), node("5", x + 1, 0.5, z)};
    s.constraints = {constraint(ConstraintKind::rigid_body, "5", {"1", "2", "3", "4"})};
    s.masses = {mass("5", 1000, Vector3(100, 200, 300))};
    s.slabs.push_back({"1", at(45), {{"1", {}}, {"2", {}}, {"3", {}}, {"4", {}}}, Reference{"5", {}}, 0.12, true});
    s.may_move_freely = true;
    d.structures.push_back(s);
  }
  return d;
}

inline ContactDescription slab_contact(std::vector<double> gap = {}) {
  ContactDescription c;
  c.at = at(50);
  c.a = {"left", at(51)};
  c.b = Reference{"right", at(52)};
  c.gap = std::move(gap);
  return c;
}

inline ContactDescription node_contact(const std::string& a, const std::string& b, std::vector<double> gap = {0.1}) {
  ContactDescription c = slab_contact(std::move(gap));
  c.kind = ContactKind::nodes;
  c.a.name = a;
  if (b.empty()) {
    c.b.reset();
  } else {
    c.b->name = b;
  }
  return c;
}

}  // namespace nsframe::test
