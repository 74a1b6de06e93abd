// Descriptions of small structures, and models built from them.
#pragma once

#include <string>
#include <vector>

#include "base/errors.hpp"
#include "models/model.hpp"

namespace nsframe::test {

inline constexpr std::array<bool, 6> all_dofs{true, true, true, true, true, true};

inline Location at(int line) { return {"s.toml", line, 3}; }

inline NodeDescription node(const std::string& id, double x, double y, double z) { return {id, {}, Vector3(x, y, z)}; }

inline ElementDescription beam(const std::string& id, const std::string& i, const std::string& j, const std::string& section,
                               ElementKind kind = ElementKind::elastic_beam) {
  ElementDescription e;
  e.id = id;
  e.kind = kind;
  e.node_i = {i, {}};
  e.node_j = {j, {}};
  e.section = {section, {}};
  return e;
}

inline ElementDescription bar(const std::string& id, const std::string& i, const std::string& j, const std::string& material,
                              double area, ElementKind kind = ElementKind::truss) {
  ElementDescription e = beam(id, i, j, "", kind);
  e.section = {};
  e.material = {material, {}};
  e.area = area;
  return e;
}

inline SpringDescription ground_spring(const std::string& id, const std::string& node, const Vector6& stiffness) {
  SpringDescription s;
  s.id = id;
  s.node_i = {node, {}};
  s.stiffness = stiffness;
  return s;
}

inline SectionDescription elastic_section(const std::string& name, const ElasticSection& section) { return {name, {}, section, {}}; }

inline ConstraintDescription constraint(ConstraintKind kind, const std::string& master, const std::vector<std::string>& slaves) {
  ConstraintDescription c;
  c.kind = kind;
  c.master = {master, {}};
  for (const std::string& slave : slaves) c.slaves.push_back({slave, {}});
  return c;
}

inline MassDescription mass(const std::string& node, double mass, const Vector3& inertia = Vector3::Zero()) {
  return {{node, {}}, Vector3::Constant(mass), inertia};
}

inline SupportDescription fixed(const std::string& node, const std::array<bool, 6>& dofs = all_dofs) { return {{node, {}}, dofs}; }

// A column of 2.5 m from node 1, fixed, to node 2 with a mass of 1000 kg; section "c".
inline ModelDescription column() {
  ModelDescription d;
  d.sections = {elastic_section("c", {210e9, 81e9, 3e-3, 1e-5, 4e-6, 8e-8})};
  StructureDescription s;
  s.name = "a";
  s.at = at(1);
  s.nodes = {node("1", 0, 0, 0), node("2", 0, 0, 2.5)};
  s.elements = {beam("e1", "1", "2", "c")};
  s.supports = {fixed("1")};
  s.masses = {mass("2", 1000)};
  d.structures = {s};
  return d;
}

inline Model build(const ModelDescription& description) {
  Diagnostics diagnostics;
  return build_model(description, diagnostics);
}

// What build_model() reports; empty for a valid description.
inline std::vector<std::string> errors_of(const ModelDescription& description) {
  Diagnostics diagnostics;
  try {
    build_model(description, diagnostics);
  } catch (const InputError&) {
  }
  return diagnostics.messages();
}

// The same as one text, a line a message.
inline std::string error_of(const ModelDescription& description) {
  std::string all;
  for (const std::string& message : errors_of(description)) all += (all.empty() ? "" : "\n") + message;
  return all.empty() ? "no error" : all;
}

inline int full_dof(const Model& model, const std::string& id, int direction) {
  for (int i = 0; i < model.nodes.size(); ++i) {
    if (model.nodes.id[static_cast<std::size_t>(i)] == id) return 6 * i + direction;
  }
  return -1;
}

}  // namespace nsframe::test
