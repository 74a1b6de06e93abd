#include "models/contact_geometry.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace nsframe {

namespace {

constexpr double least_facing = 0.5;  // cosine of the angle between an edge's normal and the direction of the contact

// Twice the area of the slab in plan, positive when its corners run counter-clockwise.
double signed_plan(const std::vector<Vector3>& corners) {
  double area = 0;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Vector3 &p = corners[i], &q = corners[(i + 1) % corners.size()];
    area += p.x() * q.y() - q.x() * p.y();
  }
  return area;
}

}  // namespace

Vector3 across(const Vector3& direction) {
  const Vector3 side = tangents(direction)[0];
  return side.x() + side.y() < 0 ? Vector3(-side) : side;
}

SlidingRoom vertical_room(double level_a, double level_b, double half_thickness) {
  return {level_a - level_b - half_thickness, level_a - level_b + half_thickness};
}

std::string beyond_reach(double nearest_left_out, const ContactDescription& contact) {
  if (!std::isfinite(nearest_left_out)) return "";
  return fmt::format("; the nearest are {:.3g} m apart, beyond the reach of {:g} m", nearest_left_out, contact.reach);
}

std::string ContactScene::short_id(int node) const {
  const std::string& id = node_id(node);
  return id.substr(id.rfind('.') + 1);
}

int ContactScene::node(const Reference& reference) const {
  const auto& ids = model_.nodes.id;
  const auto found = std::find(ids.begin(), ids.end(), reference.name);
  if (found != ids.end()) return static_cast<int>(found - ids.begin());
  error(reference.at, fmt::format("node '{}' is not defined{}", reference.name, did_you_mean(reference.name, ids)));
  return -1;
}

int ContactScene::structure(const Reference& reference) const {
  std::vector<std::string> names;
  for (const StructureDescription& item : description_.structures) {
    if (item.name == reference.name) return static_cast<int>(names.size());
    names.push_back(item.name);
  }
  error(reference.at, fmt::format("structure '{}' is not defined{}", reference.name, did_you_mean(reference.name, names)));
  return -1;
}

std::optional<std::pair<int, int>> ContactScene::structures(const ContactDescription& contact, std::string_view kind) const {
  if (!contact.b) {
    error(contact.at, fmt::format("{} needs two structures", kind));
    return std::nullopt;
  }
  const int a = structure(contact.a), b = structure(*contact.b);
  if (a < 0 || b < 0) return std::nullopt;
  if (a == b) {
    error(contact.b->at, fmt::format("structure '{}' cannot pound against itself", contact.a.name));
    return std::nullopt;
  }
  return std::pair(a, b);
}

bool ContactScene::belongs(int node, int description) const {
  return node_id(node).starts_with(description_.structures[static_cast<std::size_t>(description)].name + ".");
}

double ContactScene::level(const Slab& slab) const {
  double sum = 0;
  for (const int corner : slab.corners) sum += position(corner).z();
  return sum / static_cast<double>(slab.corners.size());
}

bool ContactScene::meet(const Slab& a, const Slab& b) const {
  return std::abs(level(a) - level(b)) < std::max(0.5 * (a.thickness + b.thickness), level_tolerance);
}

std::vector<const Slab*> ContactScene::slabs_of(int description) const {
  std::vector<const Slab*> slabs;
  for (const Slab& slab : model_.slabs) {
    const bool complete = std::find(slab.corners.begin(), slab.corners.end(), -1) == slab.corners.end();
    if (slab.description == description && complete) slabs.push_back(&slab);  // a missing corner is reported already
  }
  std::sort(slabs.begin(), slabs.end(), [this](const Slab* a, const Slab* b) { return level(*a) < level(*b); });
  return slabs;
}

std::vector<SlabEdge> ContactScene::facing_edges(const Slab& slab, const Vector3& direction) const {
  std::vector<Vector3> corners;
  for (const int corner : slab.corners) corners.push_back(position(corner));
  const double turn = signed_plan(corners) < 0 ? -1 : 1;
  std::vector<SlabEdge> edges;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const std::size_t next = (i + 1) % corners.size();
    const Vector3 axis = corners[next] - corners[i];
    const Vector3 outward = turn * Vector3(axis.y(), -axis.x(), 0);
    if (outward.norm() < level_tolerance || outward.normalized().dot(direction) < least_facing) continue;
    edges.push_back({&slab, slab.corners[i], slab.corners[next], corners[i], corners[next], outward.normalized()});
  }
  return edges;
}

std::vector<SlabCorner> ContactScene::facing_corners(const Slab& slab, const Vector3& direction) const {
  std::vector<SlabCorner> corners;
  for (const SlabEdge& edge : facing_edges(slab, direction)) {
    for (const int node : {edge.first, edge.last}) {
      const auto same = [node](const SlabCorner& corner) { return corner.node == node; };
      if (std::none_of(corners.begin(), corners.end(), same)) corners.push_back({&slab, node, position(node)});
    }
  }
  const Vector3 side = across(direction);
  std::sort(corners.begin(), corners.end(), [&](const auto& a, const auto& b) { return a.position.dot(side) < b.position.dot(side); });
  return corners;
}

ContactPoint ContactScene::point_on(const SlabEdge& edge, double from_start) const {
  struct Stop {
    double along;
    int node;
  };
  std::vector<Stop> stops{{0, edge.first}, {edge.length(), edge.last}};
  for (int i = 0; !edge.slab->rigid && i < model_.nodes.size(); ++i) {
    if (model_.nodes.structure[static_cast<std::size_t>(i)] != edge.slab->structure) continue;
    const Vector3 arm = position(i) - edge.start;
    const double along = arm.dot(edge.axis());
    const bool inside = along > level_tolerance && along < edge.length() - level_tolerance;
    if (inside && (arm - along * edge.axis()).norm() < level_tolerance) stops.push_back({along, i});
  }
  std::sort(stops.begin(), stops.end(), [](const Stop& a, const Stop& b) { return a.along < b.along; });
  std::size_t next = 1;
  while (next + 1 < stops.size() && stops[next].along < from_start) ++next;
  const Stop &before = stops[next - 1], &after = stops[next];
  double share = (from_start - before.along) / (after.along - before.along);
  if (from_start - before.along < level_tolerance) share = 0;
  if (after.along - from_start < level_tolerance) share = 1;
  return edge_point(before.node, after.node, position(before.node), position(after.node), share);
}

std::string ContactScene::edge_name(const SlabEdge& edge) const {
  return fmt::format("{}:{}-{}", edge.slab->id, short_id(edge.first), short_id(edge.last));
}

std::string ContactScene::corner_name(const SlabCorner& corner) const {
  return fmt::format("{}:{}", corner.slab->id, short_id(corner.node));
}

}  // namespace nsframe
