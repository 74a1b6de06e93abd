// Slabs of either structure against columns of the other, between its floors: pounding at mid-height. The point of the
// column is a node where there is one at the slab's level, else it moves by the shape functions of an elastic beam.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "models/contact_geometry.hpp"

namespace nsframe {

namespace {

constexpr double least_upright = 0.9;      // cosine between a column's axis and the vertical
constexpr double bare_half_width = 0.1;    // [m] of columns whose section has no outline

struct ColumnPoint {
  ContactPoint point;
  std::string name;
  double half_width = 0;                   // across the direction of the contact [m]
  SlidingRoom vertical;                    // of a slab along it
};

double half_width(const ElementShape& shape, const Vector3& side) {
  if (!shape.outline || shape.outline->empty()) return bare_half_width;
  double most = 0;
  for (const Vector2& corner : *shape.outline) {
    most = std::max(most, std::abs(side.dot(shape.axes.transpose() * Vector3(0, corner.x(), corner.y()))));
  }
  return most;
}

// The column at a level; nothing when it does not reach it.
std::optional<ColumnPoint> at_level(const ContactScene& scene, const ElementGroup& group, int element, double level, const Vector3& side) {
  const ElementNodes& nodes = group.nodes(element);
  if (nodes[0] < 0 || nodes[1] < 0) return std::nullopt;
  const ElementShape shape = group.shape(element);
  if (!shape.beam || std::abs(shape.axes(0, 2)) < least_upright) return std::nullopt;
  ColumnPoint found;
  found.half_width = half_width(shape, side);
  for (const int node : nodes) {
    if (std::abs(scene.position(node).z() - level) > level_tolerance) continue;
    found.point = node_point(node, scene.position(node), true);
    found.name = scene.node_id(node);
    return found;
  }
  const double low = std::min(scene.position(nodes[0]).z(), scene.position(nodes[1]).z());
  const double high = std::max(scene.position(nodes[0]).z(), scene.position(nodes[1]).z());
  if (level < low || level > high) return std::nullopt;
  const Vector3 start = scene.position(nodes[0]) + shape.offset[0];
  const double along = (level - start.z()) / (shape.length * shape.axes(0, 2));
  // within a rigid end the point moves with the member's end
  found.point = beam_point(nodes, shape, scene.position(nodes[0]), std::clamp(along, 0.0, 1.0));
  found.name = fmt::format("{}@z={:.4g}", group.id(element), level);
  found.vertical = {low - level, high - level};
  return found;
}

std::vector<ColumnPoint> columns_at(const ContactScene& scene, int description, double level, const Vector3& side) {
  std::vector<ColumnPoint> columns;
  for (const auto& group : scene.model().groups) {
    for (int e = 0; e < group->size(); ++e) {
      if (!scene.belongs(std::max(group->nodes(e)[0], group->nodes(e)[1]), description)) continue;
      auto column = at_level(scene, *group, e, level, side);
      const auto same = [&](const ColumnPoint& other) { return other.name == column->name; };
      if (column && std::none_of(columns.begin(), columns.end(), same)) columns.push_back(*std::move(column));
    }
  }
  return columns;
}

// A slab against the columns that stand in front of its facing edges.
class SlabAgainstColumns {
 public:
  SlabAgainstColumns(const ContactDescription& contact, const ContactScene& scene) : contact_(contact), scene_(scene) {}

  void add(const Slab& slab, bool slab_first, int other) {
    const Vector3 towards = slab_first ? contact_.direction : Vector3(-contact_.direction);
    for (const SlabEdge& edge : scene_.facing_edges(slab, towards)) {
      for (const ColumnPoint& column : columns_at(scene_, other, scene_.level(slab), edge.axis())) add(edge, column, slab_first);
    }
  }

  std::vector<PairDraft> drafts;
  double left_out = std::numeric_limits<double>::infinity();

 private:
  void add(const SlabEdge& edge, const ColumnPoint& column, bool slab_first) {
    const Vector3 arm = column.point.position - edge.start;
    const double along = arm.dot(edge.axis()), distance = arm.dot(edge.outward), length = edge.length();
    if (along < -column.half_width || along > length + column.half_width) return;
    if (std::abs(distance) > contact_.reach) {
      left_out = std::min(left_out, std::abs(distance));
      return;
    }
    PairDraft& draft = drafts.emplace_back();
    draft.at = contact_.at;
    draft.distance = distance;
    draft.level = scene_.level(*edge.slab);
    ContactPair& pair = draft.pair;
    const ContactPoint on_edge = scene_.point_on(edge, std::clamp(along, 0.0, length));
    pair.a = slab_first ? on_edge : column.point;
    pair.b = slab_first ? column.point : on_edge;
    pair.normal = slab_first ? edge.outward : Vector3(-edge.outward);
    const bool at_corner = on_edge.shares.size() == 1;
    const std::string slab_side = at_corner ? scene_.corner_name({edge.slab, on_edge.first_node(), {}}) : scene_.edge_name(edge);
    pair.name = slab_first ? slab_side + "|" + column.name : column.name + "|" + slab_side;
    // seen from the column, the edge reaches from `least` to `most` along the tangent
    const Vector3 tangent = tangents(pair.normal)[0];
    const double p = tangent.dot(edge.start - column.point.position), q = tangent.dot(edge.end - column.point.position);
    const double least = std::min(p, q) - column.half_width, most = std::max(p, q) + column.half_width;
    pair.room[0] = slab_first ? SlidingRoom{least, most} : SlidingRoom{-most, -least};
    // b slides up: a slab b climbs the column, a column b takes its point at the slab down
    pair.room[1] = slab_first ? SlidingRoom{-column.vertical.most, -column.vertical.least} : column.vertical;
  }

  const ContactDescription& contact_;
  const ContactScene& scene_;
};

std::vector<PairDraft> against_columns(const ContactDescription& contact, const ContactScene& scene, std::pair<int, int> sides,
                                       double& left_out) {
  SlabAgainstColumns pairs(contact, scene);
  for (const bool first : {true, false}) {
    const int own = first ? sides.first : sides.second, other = first ? sides.second : sides.first;
    const auto others = scene.slabs_of(other);
    for (const Slab* slab : scene.slabs_of(own)) {
      const auto meets = [&](const Slab* against) { return scene.meet(*slab, *against); };
      if (std::none_of(others.begin(), others.end(), meets)) pairs.add(*slab, first, other);
    }
  }
  left_out = std::min(left_out, pairs.left_out);
  return std::move(pairs.drafts);
}

}  // namespace

std::vector<PairDraft> find_slab_columns(const ContactDescription& contact, const ContactScene& scene) {
  const auto sides = scene.structures(contact, "slab-columns");
  if (!sides) return {};
  double left_out = std::numeric_limits<double>::infinity();
  std::vector<PairDraft> drafts = against_columns(contact, scene, *sides, left_out);
  if (drafts.empty()) {
    scene.error(contact.at, fmt::format("no slab of '{}' or '{}' faces a column of the other between its floors{}", contact.a.name,
                                        contact.b->name, beyond_reach(left_out, contact)));
  }
  return drafts;
}

std::vector<PairDraft> find_facing(const ContactDescription& contact, const ContactScene& scene) {
  const auto sides = scene.structures(contact, "facing");
  if (!sides) return {};
  double left_out = std::numeric_limits<double>::infinity();
  std::vector<PairDraft> drafts = against_columns(contact, scene, *sides, left_out);
  for (const Slab* a : scene.slabs_of(sides->first)) {
    for (const Slab* b : scene.slabs_of(sides->second)) {
      if (!scene.meet(*a, *b)) continue;
      for (PairDraft& draft : edge_pairs(*a, *b, contact, scene, left_out)) drafts.push_back(std::move(draft));
    }
  }
  if (drafts.empty()) {
    scene.error(contact.at, fmt::format("no slab of '{}' or '{}' faces a slab or a column of the other{}", contact.a.name,
                                        contact.b->name, beyond_reach(left_out, contact)));
  }
  return drafts;
}

}  // namespace nsframe
