// Corners of the slabs of either structure against facing edges of the other's, at one level: plans of unequal width,
// shifted or turned against each other.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "models/contact_geometry.hpp"

namespace nsframe {

namespace {

// A corner against an edge in front of it; nothing when it lies beside the edge.
std::optional<PairDraft> corner_on_edge(const SlabCorner& corner, const SlabEdge& edge, bool corner_first, const ContactScene& scene) {
  const Vector3 arm = corner.position - edge.start;
  const double along = arm.dot(edge.axis()), length = edge.length();
  if (along < -level_tolerance || along > length + level_tolerance) return std::nullopt;
  PairDraft draft;
  draft.distance = arm.dot(edge.outward);
  ContactPoint on_edge = scene.point_on(edge, std::clamp(along, 0.0, length));
  const bool at_corner = along < level_tolerance || along > length - level_tolerance;
  const ContactPoint at = node_point(corner.node, corner.position, at_corner);
  ContactPair& pair = draft.pair;
  pair.normal = corner_first ? Vector3(-edge.outward) : edge.outward;
  pair.a = corner_first ? at : on_edge;
  pair.b = corner_first ? on_edge : at;
  const SlabCorner opposite{edge.slab, along < length / 2 ? edge.first : edge.last, {}};
  const std::string edge_side = at_corner ? scene.corner_name(opposite) : scene.edge_name(edge);
  const std::string corner_side = scene.corner_name(corner);
  pair.name = corner_first ? corner_side + "|" + edge_side : edge_side + "|" + corner_side;
  pair.rigid_bodies = corner.slab->rigid && edge.slab->rigid;
  const Vector3 tangent = tangents(pair.normal)[0];
  const double p = tangent.dot(edge.start - corner.position), q = tangent.dot(edge.end - corner.position);
  const double least = std::min(p, q), most = std::max(p, q);
  pair.room[0] = at_corner ? SlidingRoom{-length, length} : corner_first ? SlidingRoom{-most, -least} : SlidingRoom{least, most};
  const Slab &a = corner_first ? *corner.slab : *edge.slab, &b = corner_first ? *edge.slab : *corner.slab;
  pair.room[1] = vertical_room(scene.level(a), scene.level(b), 0.5 * (a.thickness + b.thickness));
  draft.level = std::min(scene.level(a), scene.level(b));
  return draft;
}

// Two corners opposite each other are found from both sides.
bool same_nodes(const ContactPair& p, const ContactPair& q) {
  const auto alone = [](const ContactPair& pair) { return pair.a.shares.size() == 1 && pair.b.shares.size() == 1; };
  return alone(p) && alone(q) && p.a.first_node() == q.a.first_node() && p.b.first_node() == q.b.first_node();
}

}  // namespace

std::vector<PairDraft> edge_pairs(const Slab& a, const Slab& b, const ContactDescription& contact, const ContactScene& scene,
                                  double& nearest_left_out) {
  std::vector<PairDraft> drafts;
  const auto add = [&](std::optional<PairDraft> draft) {
    if (!draft) return;
    if (std::abs(*draft->distance) > contact.reach) {
      nearest_left_out = std::min(nearest_left_out, std::abs(*draft->distance));
      return;
    }
    for (const PairDraft& other : drafts) {
      if (same_nodes(other.pair, draft->pair)) return;
    }
    draft->at = contact.at;
    drafts.push_back(*std::move(draft));
  };
  const auto of_a = scene.facing_corners(a, contact.direction), of_b = scene.facing_corners(b, -contact.direction);
  for (const SlabEdge& edge : scene.facing_edges(b, -contact.direction)) {
    for (const SlabCorner& corner : of_a) add(corner_on_edge(corner, edge, true, scene));
  }
  for (const SlabEdge& edge : scene.facing_edges(a, contact.direction)) {
    for (const SlabCorner& corner : of_b) add(corner_on_edge(corner, edge, false, scene));
  }
  return drafts;
}

std::vector<PairDraft> find_slab_edges(const ContactDescription& contact, const ContactScene& scene) {
  const auto sides = scene.structures(contact, "slab-edges");
  if (!sides) return {};
  std::vector<PairDraft> drafts;
  double left_out = std::numeric_limits<double>::infinity();
  bool level = false;
  for (const Slab* a : scene.slabs_of(sides->first)) {
    for (const Slab* b : scene.slabs_of(sides->second)) {
      if (!scene.meet(*a, *b)) continue;
      level = true;
      for (PairDraft& draft : edge_pairs(*a, *b, contact, scene, left_out)) drafts.push_back(std::move(draft));
    }
  }
  if (!level) {
    scene.error(contact.at, fmt::format("structures '{}' and '{}' have no slabs at the same level; kind = \"slab-columns\" or \"facing\" "
                                        "takes slabs between the floors of the other", contact.a.name, contact.b->name));
  } else if (drafts.empty()) {
    scene.error(contact.at, fmt::format("no corner of a slab of '{}' or '{}' faces an edge of the other along the direction{}",
                                        contact.a.name, contact.b->name, beyond_reach(left_out, contact)));
  }
  return drafts;
}

}  // namespace nsframe
