// All that a model description says, but for places, as text: two descriptions are the same when their texts are.
#pragma once

#include <fmt/format.h>

#include <string>

#include "models/description.hpp"

namespace nsframe::test {

inline std::string numbers(const auto& values) {
  std::string out = "(";
  for (const double v : values) out += fmt::format("{} ", v);
  return out + ")";
}
inline std::string names(const std::vector<Reference>& references) {
  std::string out;
  for (const Reference& r : references) out += r.name + " ";
  return out;
}
inline std::string name(const std::optional<Reference>& reference) { return reference ? reference->name : "-"; }

inline std::string dump(const SectionDescription& s) {
  std::string out = "section " + s.name;
  if (const auto* e = std::get_if<ElasticSection>(&s.kind))
    out += fmt::format(" {} {} {} {} {} {} {} {}", e->E, e->G, e->A, e->Iz, e->Iy, e->J, e->Ay, e->Az);
  if (const auto* f = std::get_if<FiberSectionDescription>(&s.kind)) {
    out += fmt::format(" GJ {} {} {} {}", f->torsion_stiffness, name(f->torsion), name(f->shear_y), name(f->shear_z));
    for (const auto& fiber : f->fibers)
      out += fmt::format(" ({} {} {} {}{})", fiber.y, fiber.z, fiber.area, fiber.material.name,
                         fiber.displaced ? " out" : "");
  }
  for (const Vector2& point : s.outline) out += numbers(point);
  return out + "\n";
}

inline std::string dump(const ElementDescription& e) {
  const Integration& r = e.integration;
  std::string out =
      fmt::format("sections {} rule {} {} {} {} {} releases {} mass {} {} {} {} ", names(e.sections), r.rule, r.hinge_i, r.hinge_j,
                  numbers(r.positions), numbers(r.weights), fmt::join(e.releases.basic, " "), e.mass.per_length,
                  e.mass.density, e.mass.consistent, e.mass.rotary_inertia);
  return out +
         fmt::format("element {} {} {}-{} section {} material {} area {} pretension {} points {} geometry {} {} offsets {} {}\n",
                     e.id, int(e.kind), e.node_i.name, e.node_j.name, e.section.name, e.material.name, e.area,
                     e.pretension, e.points, int(e.geometry), e.orientation ? numbers(*e.orientation) : "",
                     numbers(e.offset[0]), numbers(e.offset[1]));
}

inline std::string dump(const SpringDescription& s) {
  std::string out = fmt::format("spring {} {}-{} {} {}", s.id, s.node_i.name, name(s.node_j), numbers(s.stiffness),
                                numbers(s.damping));
  for (const auto& law : s.law) out.append(" ").append(name(law));
  out += numbers(s.x) + (s.in_plane ? numbers(*s.in_plane) : "") + (s.shear_distance ? numbers(*s.shear_distance) : "") +
         (s.p_delta ? numbers(*s.p_delta) : "");
  return out + "\n";
}

inline std::string dump(const DampingDescription& d) {
  std::string out = fmt::format("damping {} {} {} {} {}", int(d.kind), numbers(d.ratios), d.mass_factor,
                                d.stiffness_factor, d.frequencies ? numbers(*d.frequencies) : "") +
         fmt::format("stiffness {}\n", int(d.stiffness));
  for (const auto& [mode, ratio] : d.named_ratios) out += fmt::format(" {} = {}", mode.name, ratio);
  return out + numbers(d.frequency_ratios) + "\n";
}

inline std::string dump(const StructureDescription& s) {
  std::string out = fmt::format("structure {} {}\n", s.name, s.may_move_freely);
  for (const auto& n : s.nodes) out += fmt::format("node {} {}\n", n.id, numbers(n.position));
  for (const auto& p : s.supports) out += fmt::format("support {} {}\n", p.node.name, fmt::join(p.fixed, " "));
  for (const auto& m : s.masses)
    out += fmt::format("mass {} {} {}\n", m.node.name, numbers(m.mass), numbers(m.inertia));
  for (const auto& e : s.elements) out += dump(e);
  for (const auto& p : s.springs) out += dump(p);
  for (const auto& l : s.loads)
    out += fmt::format("load {} {} {} {} {}\n", names(l.elements), l.local, numbers(l.uniform), numbers(l.force), l.position);
  for (const auto& c : s.constraints)
    out +=
        fmt::format("constraint {} {}: {} {} {}\n", int(c.kind), c.master.name, names(c.slaves), fmt::join(c.dofs, " "), numbers(c.normal));
  for (const auto& p : s.slabs)
    out += fmt::format("slab {} {} center {} {} {}\n", p.id, names(p.corners), name(p.center), p.thickness, p.rigid);
  out += dump(s.damping);
  for (const auto& i : s.initial_displacements) out += fmt::format("u0 {} {} {}\n", i.node.name, i.dof, i.value);
  for (const auto& i : s.initial_velocities) out += fmt::format("v0 {} {} {}\n", i.node.name, i.dof, i.value);
  return out;
}

inline std::string dump(const ModelDescription& m) {
  std::string out;
  for (const auto& material : m.materials)
    out += fmt::format("material {} {} {}\n", material.name, material.law.index(), initial_tangent(material.law));
  for (const auto& s : m.sections) out += dump(s);
  for (const auto& s : m.structures) out += dump(s);
  for (const auto& c : m.contacts)
    out += fmt::format("contact {} {} {} {} {} gap {} e {} {} {}\n", c.name, int(c.kind), c.a.name, name(c.b),
                       numbers(c.direction), numbers(c.gap), c.restitution, c.law.name,
                       numbers(std::array{c.law.stiffness.value_or(0), c.law.stiffness_ratio.value_or(0), c.law.hertz_stiffness.value_or(0),
                                c.law.damping_ratio.value_or(-1), c.law.effective_mass.value_or(0)}));
  for (const auto& s : m.stages) {
    out += fmt::format("stage {} {} {} {} {} targets {} {} {} {} {} {}\n", s.name, s.options.control, name(s.mode),
                       name(s.control_node), s.control_dof, fmt::join(s.options.targets, " "), s.options.relative, s.options.step,
                       s.options.steps, int(s.options.arc), s.options.max_points);
    for (const auto& load : s.loads) out += fmt::format("load {} {} {}\n", load.node.name, load.dof, load.value);
    if (s.masses) out += fmt::format("masses {}\n", numbers(*s.masses));
  }
  for (const auto& g : m.motions)
    out += fmt::format("motion {} {} {} {}\n", g.source, g.dt, numbers(g.direction), numbers(g.acceleration));
  return out + fmt::format("gravity {} {}\n", numbers(m.gravity.acceleration), m.gravity.statically_first);
}

// The first line where two texts differ, of both; empty when they are the same.
inline std::string difference(const std::string& a, const std::string& b) {
  std::size_t line = 0, i = 0;
  for (; i < std::min(a.size(), b.size()) && a[i] == b[i]; ++i)
    if (a[i] == '\n') line = i + 1;
  if (i == a.size() && i == b.size()) return "";
  const auto rest = [line](const std::string& text) { return text.substr(line, text.find('\n', line) - line); };
  return rest(a) + "\n" + rest(b);
}

}  // namespace nsframe::test
