#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "elements/infill.hpp"
#include "scene/describe.hpp"
#include "scene/sections/section_kind.hpp"

namespace nsframe {

namespace {

Vector3 vector3(const std::vector<double>& values) {
  if (values.size() == 1) return Vector3::Constant(values[0]);
  return values.size() == 3 ? Vector3(values[0], values[1], values[2]) : Vector3::Zero();
}

Reference at_or_empty(const std::vector<Reference>& nodes, std::size_t i) {
  return i < nodes.size() ? nodes[i] : Reference{};
}

EndReleases end_releases(const Releases& releases) {
  const auto& r = releases.basic;
  return {{{r[0], false, false, r[5], r[3], r[1]}}, {{false, false, false, false, r[4], r[2]}}};
}

Vector3 vector3(const std::array<double, 3>& values) { return {values[0], values[1], values[2]}; }
std::array<double, 3> components(const Vector3& v) { return {v.x(), v.y(), v.z()}; }

LoadDescription describe(const LoadTable& load) {
  LoadDescription out;
  out.at = load.at;
  out.elements = load.beams;
  out.local = load.axes == LoadAxes::local;
  if (load.uniform) out.uniform = vector3(*load.uniform);
  if (load.force) out.force = vector3(*load.force);
  out.position = load.position.value_or(LoadDescription{}.position);
  return out;
}

LoadTable load_table(const LoadDescription& load) {
  return {load.at, load.elements, load.local ? LoadAxes::local : LoadAxes::global, components(load.uniform),
          components(load.force), load.position};
}

// With the structure's defaults.
ElementDescription describe_member(const Reference& id, const MemberKeys& member, const ExplicitStructure& structure) {
  ElementDescription out;
  out.id = id.name;
  out.at = id.at;
  out.kind = element_kind(member.element.value_or(structure.element));
  if (out.kind != ElementKind::elastic_beam) out.integration = structure.integration;
  if (member.integration) out.integration = *member.integration;
  if (out.kind == ElementKind::force_beam) out.inner_iterations = structure.inner_iterations;
  if (member.inner_iterations) out.inner_iterations = *member.inner_iterations;
  out.mass = member.mass.value_or(structure.member_mass);
  out.points = member.points.value_or(structure.points);
  out.geometry = member.geometry.value_or(structure.geometry);
  return out;
}

ElementDescription describe(const BeamTable& beam, const ExplicitStructure& structure) {
  ElementDescription out = describe_member(beam.id, beam, structure);
  out.node_i = at_or_empty(beam.nodes, 0);
  out.node_j = at_or_empty(beam.nodes, 1);
  out.section = beam.sections.empty() ? beam.section : beam.sections[beam.sections.size() / 2];
  out.sections = beam.sections;
  if (beam.releases) out.releases = basic_releases(*beam.releases);
  if (beam.orientation)
    out.orientation = Vector3((*beam.orientation)[0], (*beam.orientation)[1], (*beam.orientation)[2]);
  out.offset = {beam.offset_i.value_or(Vector3::Zero()), beam.offset_j.value_or(Vector3::Zero())};
  return out;
}

ElementDescription describe(const BarTable& bar, BarKind kind, const ExplicitStructure& structure) {
  ElementDescription out;
  out.id = bar.id.name;
  out.at = bar.id.at;
  out.kind = element_kind(kind);
  out.node_i = at_or_empty(bar.nodes, 0);
  out.node_j = at_or_empty(bar.nodes, 1);
  out.material = bar.material;
  out.area = bar.area;
  out.pretension = bar.pretension;
  out.geometry = bar.geometry.value_or(structure.geometry);
  return out;
}

// What springs and links have in common.
template <class Table>
SpringDescription describe_spring(const Table& spring) {
  SpringDescription out;
  out.id = spring.id.name;
  out.at = spring.id.at;
  out.node_i = at_or_empty(spring.nodes, 0);
  if (spring.nodes.size() == 2) out.node_j = spring.nodes[1];
  out.stiffness = Eigen::Map<const Vector6>(spring.stiffness.of_dof.data());
  out.damping = Eigen::Map<const Vector6>(spring.damping.of_dof.data());
  out.law = spring.law.of_dof;
  return out;
}

SpringDescription describe(const SpringTable& spring) {
  SpringDescription out = describe_spring(spring);
  if (!spring.orient) return out;
  out.x = vector3((*spring.orient)[0]);
  out.in_plane = vector3((*spring.orient)[1]);
  return out;
}

SpringDescription describe(const LinkTable& link) {
  SpringDescription out = describe_spring(link);
  if (link.in_plane) out.in_plane = vector3(*link.in_plane);
  out.shear_distance = Vector2(link.shear_distance[0], link.shear_distance[1]);
  out.p_delta = link.p_delta;
  return out;
}

// The section of a wall by thickness in a story, from 1: no other can have a name with a dot.
Reference wall_section_name(const WallTable& wall, const ExplicitStructure& structure, std::size_t story) {
  return {fmt::format("{}.{}-{}", structure.name, wall.id.name, story), wall.id.at};
}

// The material of a strut: no other can have a name with a dot.
std::string strut_material(const InfillTable& infill, const ExplicitStructure& structure) {
  return structure.name + "." + infill.id.name;
}

ElementDescription describe(const InfillTable& infill, const ExplicitStructure& structure) {
  ElementDescription out;
  out.id = infill.id.name;
  out.at = infill.id.at;
  out.kind = ElementKind::truss;
  out.node_i = at_or_empty(infill.nodes, 0);
  out.node_j = at_or_empty(infill.nodes, 1);
  out.material = {strut_material(infill, structure), infill.id.at};
  InfillPanel panel{infill.thickness, infill.E, infill.column_EI, infill.height, infill.length, 0};
  const auto level = [&structure](const Reference& node) {
    for (const NodeTable& n : structure.nodes)
      if (n.id.name == node.name) return n.z;
    return 0.0;  // reported by build_model()
  };
  panel.column_height = infill.column_height.value_or(std::abs(level(out.node_j) - level(out.node_i)));
  out.area = strut_width(panel) * panel.thickness;
  return out;
}

ConstraintDescription tie(const SlabTable& slab, ConstraintKind kind) {
  ConstraintDescription out{slab.id.at, kind, slab.center.value_or(Reference{}), slab.corners};
  out.slaves.insert(out.slaves.end(), slab.nodes.begin(), slab.nodes.end());
  return out;
}

// Rigid bodies, then diaphragms, then equal DOFs.
void describe_constraints(const ExplicitStructure& structure, StructureDescription& out) {
  const auto tie_slabs = [&](SlabKind kind, ConstraintKind constraint) {
    for (const SlabTable& slab : structure.slabs)
      if (slab.kind == kind && slab.center) out.constraints.push_back(tie(slab, constraint));
  };
  for (const TieTable& t : structure.rigid_links)
    out.constraints.push_back({t.master.at, ConstraintKind::rigid_body, t.master, t.slaves});
  tie_slabs(SlabKind::rigid, ConstraintKind::rigid_body);
  for (const DiaphragmTable& t : structure.diaphragms) {
    out.constraints.push_back({t.master.at, ConstraintKind::diaphragm, t.master, t.slaves});
    out.constraints.back().normal = t.normal.vector;
  }
  tie_slabs(SlabKind::diaphragm, ConstraintKind::diaphragm);
  for (const EqualDofTable& t : structure.equal_dof)
    out.constraints.push_back({t.master.at, ConstraintKind::equal_dof, t.master, t.slaves, t.dofs.dofs});
}

template <class Initial>
std::vector<InitialDescription> describe(const std::vector<Initial>& tables) {
  std::vector<InitialDescription> out;
  for (const Initial& initial : tables) out.push_back({initial.node, static_cast<int>(initial.dof), initial.value});
  return out;
}

template <class Initial>
std::vector<Initial> initial_tables(const std::vector<InitialDescription>& descriptions) {
  std::vector<Initial> out;
  for (const InitialDescription& d : descriptions) {
    Initial& initial = out.emplace_back();
    initial.node = d.node;
    initial.dof = static_cast<Dof>(d.dof);
    initial.value = d.value;
  }
  return out;
}

}  // namespace

DampingDescription describe(const DampingTable& damping) {
  DampingDescription out;
  out.at = damping.at;
  out.kind = damping.kind;
  out.mass_factor = damping.mass_factor;
  out.stiffness_factor = damping.stiffness_factor;
  out.stiffness = damping.stiffness;
  if (damping.kind == DampingKind::modal) {
    out.ratios = damping.ratios.list;
    out.named_ratios = damping.ratios.named;
  }
  if (damping.kind == DampingKind::rayleigh && damping.frequencies.size() == 2 && !damping.ratios.list.empty()) {
    out.frequencies = {damping.frequencies[0], damping.frequencies[1]};
    out.frequency_ratios = {damping.ratios.list.front(), damping.ratios.list.back()};
  }
  return out;
}

DampingTable table(const DampingDescription& damping) {
  DampingTable out;
  out.at = damping.at;
  out.kind = damping.kind;
  out.ratios = {damping.ratios, damping.named_ratios};
  out.mass_factor = damping.mass_factor;
  out.stiffness_factor = damping.stiffness_factor;
  out.stiffness = damping.stiffness;
  if (damping.frequencies) {
    out.frequencies.assign(damping.frequencies->begin(), damping.frequencies->end());
    out.ratios.list.assign(damping.frequency_ratios.begin(), damping.frequency_ratios.end());
  }
  return out;
}

StructureDescription describe(const StoryFrameTable& frame) {
  StructureDescription out = expand(frame.frame);
  out.damping = describe(frame.damping);
  return out;
}

std::vector<MaterialDescription> own_materials(const ExplicitStructure& structure) {
  std::vector<MaterialDescription> out;
  for (const InfillTable& infill : structure.infills) {
    UniaxialLaw law = ENT{infill.E};
    if (infill.fm) {
      const double fm = *infill.fm, peak = 2 * fm / infill.E;
      law = Concrete01{-fm, -peak, -infill.residual * fm, -infill.ultimate_strain.value_or(5 * peak)};
    }
    out.push_back({strut_material(infill, structure), infill.id.at, law});
  }
  return out;
}

Wall describe(const WallTable& wall, const ExplicitStructure& structure) {
  Wall out;
  ExplicitStructure defaults;
  defaults.member_mass = structure.member_mass;
  defaults.geometry = structure.geometry;
  out.member = describe_member(wall.id, wall, wall.section.empty() ? defaults : structure);
  out.nodes = wall.nodes;
  out.section = wall.section;
  for (std::size_t story = 1; story <= wall.thickness.size(); ++story) out.section.push_back(wall_section_name(wall, structure, story));
  out.direction = wall.direction.vector;
  out.length = wall.length;
  if (!wall.thickness.empty()) out.width = *std::max_element(wall.thickness.begin(), wall.thickness.end());
  out.attached = wall.attached;
  return out;
}

std::vector<SectionDescription> own_sections(const ExplicitStructure& structure) {
  std::vector<SectionDescription> out;
  for (const WallTable& wall : structure.walls) {
    for (std::size_t story = 1; story <= wall.thickness.size(); ++story) {
      const double y = wall.length / 2, z = wall.thickness[story - 1] / 2;
      out.push_back({wall_section_name(wall, structure, story).name, wall.id.at,
                     wall_section(2 * y, 2 * z, wall.E.value_or(0), wall.poisson.value_or(0.2)),
                     rectangle_outline({{-y, y}, {-z, z}})});
      out.back().faulty = !(y > 0 && z > 0 && wall.E.value_or(0) > 0);  // reported where it was read
    }
  }
  return out;
}

StructureDescription describe_nodes(const ExplicitStructure& structure) {
  StructureDescription out;
  out.name = structure.name;
  out.at = structure.at;
  for (const NodeTable& n : structure.nodes) out.nodes.push_back({n.id.name, n.id.at, Vector3(n.x, n.y, n.z)});
  return out;
}

StructureDescription describe(const ExplicitStructure& structure) {
  StructureDescription out = describe_nodes(structure);
  out.may_move_freely = structure.may_move_freely;
  for (const SupportTable& s : structure.supports) out.supports.push_back({s.node, s.fixed.dofs});
  for (const MassTable& m : structure.masses) out.masses.push_back({m.node, vector3(m.mass), vector3(m.inertia)});
  for (const BeamTable& beam : structure.beams) out.elements.push_back(describe(beam, structure));
  for (const WallTable& wall : structure.walls) expand(describe(wall, structure), out);
  for (const BarTable& bar : structure.trusses) out.elements.push_back(describe(bar, BarKind::truss, structure));
  for (const BarTable& bar : structure.cables) out.elements.push_back(describe(bar, BarKind::cable, structure));
  for (const InfillTable& infill : structure.infills) out.elements.push_back(describe(infill, structure));
  for (const SpringTable& spring : structure.springs) out.springs.push_back(describe(spring));
  for (const LinkTable& link : structure.links) out.springs.push_back(describe(link));
  for (const LoadTable& load : structure.loads) out.loads.push_back(describe(load));
  describe_constraints(structure, out);
  for (const SlabTable& s : structure.slabs)
    out.slabs.push_back(
        {s.id.name, s.id.at, s.corners, s.center, s.thickness, s.rigid_contact.value_or(s.kind != SlabKind::links)});
  out.damping = describe(structure.damping);
  out.initial_displacements = describe(structure.initial_displacement);
  out.initial_velocities = describe(structure.initial_velocity);
  return out;
}

namespace {

BeamTable beam_table(const ElementDescription& element) {
  BeamTable out;
  out.id = {element.id, element.at};
  out.nodes = {element.node_i, element.node_j};
  if (element.sections.empty()) out.section = element.section;
  out.sections = element.sections;
  out.element = BeamKind::elastic;
  out.points = element.points;
  if (element.integration != Integration{}) out.integration = element.integration;
  if (element.inner_iterations) out.inner_iterations = true;
  if (element.mass != MemberMass{}) out.mass = element.mass;
  if (element.releases.any()) out.releases = end_releases(element.releases);
  out.geometry = element.geometry;
  if (element.kind == ElementKind::displacement_beam) out.element = BeamKind::displacement;
  if (element.kind == ElementKind::force_beam) out.element = BeamKind::force_based;
  if (element.orientation) {
    const Vector3& v = *element.orientation;
    out.orientation = {v.x(), v.y(), v.z()};
  }
  if (!element.offset[0].isZero(0)) out.offset_i = element.offset[0];
  if (!element.offset[1].isZero(0)) out.offset_j = element.offset[1];
  return out;
}

template <class Table>
Table spring_table(const SpringDescription& spring) {
  Table out;
  out.id = {spring.id, spring.at};
  out.nodes = {spring.node_i};
  if (spring.node_j) out.nodes.push_back(*spring.node_j);
  Eigen::Map<Vector6>(out.stiffness.of_dof.data()) = spring.stiffness;
  Eigen::Map<Vector6>(out.damping.of_dof.data()) = spring.damping;
  out.law.of_dof = spring.law;
  return out;
}

void add_spring(const SpringDescription& spring, ExplicitStructure& out) {
  if (spring.shear_distance) {
    LinkTable& link = out.links.emplace_back(spring_table<LinkTable>(spring));
    if (spring.in_plane) link.in_plane = components(*spring.in_plane);
    link.p_delta = spring.p_delta;
    link.shear_distance = {spring.shear_distance->x(), spring.shear_distance->y()};
    return;
  }
  SpringTable& table = out.springs.emplace_back(spring_table<SpringTable>(spring));
  if (spring.in_plane) table.orient = {components(spring.x), components(*spring.in_plane)};
}

}  // namespace

ExplicitStructure tables(const StructureDescription& structure) {
  ExplicitStructure out;
  out.name = structure.name;
  out.at = structure.at;
  out.may_move_freely = structure.may_move_freely;
  for (const NodeDescription& n : structure.nodes)
    out.nodes.push_back({{n.id, n.at}, n.position.x(), n.position.y(), n.position.z()});
  for (const SupportDescription& s : structure.supports) out.supports.push_back({s.node, {s.fixed}});
  for (const MassDescription& m : structure.masses)
    out.masses.push_back({m.node, {m.mass.x(), m.mass.y(), m.mass.z()}, {m.inertia.x(), m.inertia.y(), m.inertia.z()}});
  for (const ElementDescription& e : structure.elements) {
    const BarTable bar{{e.id, e.at}, {e.node_i, e.node_j}, e.material, e.area, e.pretension, e.geometry};
    if (e.kind == ElementKind::truss)
      out.trusses.push_back(bar);
    else if (e.kind == ElementKind::cable)
      out.cables.push_back(bar);
    else
      out.beams.push_back(beam_table(e));
  }
  for (const SpringDescription& spring : structure.springs) add_spring(spring, out);
  for (const LoadDescription& load : structure.loads) out.loads.push_back(load_table(load));
  for (const ConstraintDescription& c : structure.constraints) {
    if (c.kind == ConstraintKind::rigid_body) out.rigid_links.push_back({c.master, c.slaves});
    if (c.kind == ConstraintKind::diaphragm) out.diaphragms.push_back({c.master, c.slaves, {c.normal}});
    if (c.kind == ConstraintKind::equal_dof) out.equal_dof.push_back({c.master, c.slaves, {c.dofs}});
  }
  for (const SlabDescription& s : structure.slabs)
    out.slabs.push_back({{s.id, s.at}, s.corners, s.center, {}, SlabKind::links, s.thickness, s.rigid});
  out.damping = table(structure.damping);
  out.initial_displacement = initial_tables<InitialDisplacement>(structure.initial_displacements);
  out.initial_velocity = initial_tables<InitialVelocity>(structure.initial_velocities);
  return out;
}

}  // namespace nsframe
