#include "models/wall.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "elements/torsion.hpp"

namespace nsframe {

namespace {

constexpr double within = 1e-3;  // tolerance of places [m]

const NodeDescription* find(const StructureDescription& structure, const std::string& id) {
  const auto found = std::find_if(structure.nodes.begin(), structure.nodes.end(), [&](const auto& node) { return node.id == id; });
  return found == structure.nodes.end() ? nullptr : &*found;
}

// The axis node at this level; nothing when there is none.
const Reference* at_level(const Wall& wall, const StructureDescription& structure, double z) {
  for (const Reference& on_axis : wall.nodes) {
    const NodeDescription* node = find(structure, on_axis.name);
    if (node && std::abs(node->position.z() - z) <= within) return &on_axis;
  }
  return nullptr;
}

// Of an attached node; empty: none.
std::string fault(const Wall& wall, const StructureDescription& structure, const NodeDescription& node) {
  const Reference* level = at_level(wall, structure, node.position.z());
  if (!level)
    return fmt::format("node '{}' at z = {:.6g} m is at the level of no node of wall '{}'", node.id, node.position.z(), wall.member.id);
  const Vector3 arm = node.position - find(structure, level->name)->position;
  const double along = std::abs(arm.dot(wall.direction));
  const double across = std::abs(arm.dot(wall.direction.cross(Vector3::UnitZ())));
  if (along > wall.length / 2 + within)
    return fmt::format("node '{}' is {:.6g} m from the axis of wall '{}', whose edges are at {:.6g} m", node.id, along, wall.member.id,
                       wall.length / 2);
  if (across > wall.width / 2 + within)
    return fmt::format("node '{}' is {:.6g} m out of the plane of wall '{}'; use rigid_links", node.id, across, wall.member.id);
  return "";
}

}  // namespace

ElasticSection wall_section(double length, double thickness, double E, double poisson) {
  ElasticSection section;
  section.E = E;
  section.G = E / (2 * (1 + poisson));
  section.A = length * thickness;
  section.Iz = thickness * std::pow(length, 3) / 12;
  section.Iy = length * std::pow(thickness, 3) / 12;
  section.J = rectangle_torsion(length, thickness);
  section.Ay = section.Az = 5.0 / 6 * section.A;
  return section;
}

std::vector<std::pair<Reference, std::string>> faults(const Wall& wall, const StructureDescription& structure) {
  std::vector<std::pair<Reference, std::string>> out;
  const NodeDescription* below = nullptr;
  for (const Reference& reference : wall.nodes) {
    const NodeDescription* node = find(structure, reference.name);
    if (node && below) {
      const Vector3 rise = node->position - below->position;
      if (!(rise.z() > within) || std::hypot(rise.x(), rise.y()) > within)
        out.emplace_back(reference,
                         fmt::format("node '{}' is not above '{}': the axis of a wall is vertical, its nodes go from the foot upwards",
                                     node->id, below->id));
    }
    if (node) below = node;
    for (const char side : {'-', '+'})
      if (node && find(structure, node->id + side))
        out.emplace_back(reference, fmt::format("the edge of wall '{}' at node '{}' would be called '{}{}', which is another node's name",
                                                wall.member.id, node->id, node->id, side));
  }
  for (const Reference& reference : wall.attached) {
    const NodeDescription* node = find(structure, reference.name);
    if (!node) continue;
    if (std::string what = fault(wall, structure, *node); !what.empty()) out.emplace_back(reference, std::move(what));
  }
  return out;
}

void expand(const Wall& wall, StructureDescription& structure) {
  for (std::size_t story = 1; story < wall.nodes.size(); ++story) {
    ElementDescription& member = structure.elements.emplace_back(wall.member);
    member.id += "-" + std::to_string(story);
    member.node_i = wall.nodes[story - 1];
    member.node_j = wall.nodes[story];
    if (!wall.section.empty()) member.section = wall.section[std::min(story, wall.section.size()) - 1];
    member.orientation = Vector3::UnitZ().cross(wall.direction);
  }
  std::vector<ConstraintDescription> arms;
  for (const Reference& on_axis : wall.nodes) {
    ConstraintDescription& arm = arms.emplace_back();
    arm.at = on_axis.at;
    arm.kind = ConstraintKind::rigid_body;
    arm.master = on_axis;
    const NodeDescription* node = find(structure, on_axis.name);
    if (!node) continue;
    const Vector3 axis = node->position, half = wall.length / 2 * wall.direction;
    arm.slaves = {{on_axis.name + "-", on_axis.at}, {on_axis.name + "+", on_axis.at}};
    structure.nodes.push_back({arm.slaves[0].name, on_axis.at, axis - half});
    structure.nodes.push_back({arm.slaves[1].name, on_axis.at, axis + half});
  }
  for (const Reference& reference : wall.attached) {
    const NodeDescription* node = find(structure, reference.name);
    const Reference* level = node ? at_level(wall, structure, node->position.z()) : nullptr;
    const std::size_t place = level ? static_cast<std::size_t>(level - wall.nodes.data()) : 0;  // an unknown name somewhere, to be reported
    if (place < arms.size()) arms[place].slaves.push_back(reference);
  }
  for (ConstraintDescription& arm : arms)
    if (!arm.slaves.empty()) structure.constraints.push_back(std::move(arm));
}

}  // namespace nsframe
