// Corners of the slabs of one structure against a fixed plane across the direction of the contact.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "models/contact_geometry.hpp"

namespace nsframe {

std::vector<PairDraft> find_wall(const ContactDescription& contact, const ContactScene& scene) {
  const int structure = scene.structure(contact.a);
  if (structure < 0) return {};
  if (contact.b) {
    scene.error(contact.b->at, fmt::format("a wall is between a structure and the ground, not '{}'", contact.b->name));
    return {};
  }
  if (contact.gap.empty() && !contact.wall) {
    scene.error(contact.at, "a wall needs its gap, or a point of its plane");
    return {};
  }
  const auto slabs = scene.slabs_of(structure);
  if (slabs.empty()) {
    scene.error(contact.a.at, fmt::format("structure '{}' has no slabs; contacts of its nodes are written \"{}.node\"", contact.a.name, contact.a.name));
    return {};
  }
  std::vector<PairDraft> drafts;
  double left_out = std::numeric_limits<double>::infinity();
  for (const Slab* slab : slabs) {
    const auto corners = scene.facing_corners(*slab, contact.direction);
    double farthest = -std::numeric_limits<double>::infinity();
    for (const SlabCorner& corner : corners) farthest = std::max(farthest, corner.position.dot(contact.direction));
    for (const SlabCorner& corner : corners) {
      PairDraft draft;
      if (contact.wall) draft.distance = (*contact.wall - corner.position).dot(contact.direction);
      if (draft.distance && std::abs(*draft.distance) > contact.reach) {
        left_out = std::min(left_out, std::abs(*draft.distance));
        continue;
      }
      // a gap alone is that of the foremost corners
      if (!contact.wall && corner.position.dot(contact.direction) < farthest - level_tolerance) continue;
      draft.at = contact.at;
      draft.level = scene.level(*slab);
      draft.pair.name = scene.corner_name(corner) + "|wall";
      draft.pair.a = node_point(corner.node, corner.position, false);
      draft.pair.normal = contact.direction;
      draft.pair.rigid_bodies = slab->rigid;
      drafts.push_back(std::move(draft));
    }
  }
  if (drafts.empty()) {
    scene.error(contact.at, fmt::format("no corner of a slab of '{}' faces the wall{}", contact.a.name, beyond_reach(left_out, contact)));
  }
  return drafts;
}

}  // namespace nsframe
