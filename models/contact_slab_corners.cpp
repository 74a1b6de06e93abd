// Two facing corners of the slabs at one level, each against the one opposite: the eight-DOF contact of T. Langlade et al.,
// Engineering Structures 241 (2021) 112426.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "models/contact_geometry.hpp"

namespace nsframe {

namespace {

// Of the corners that face, those farthest along `direction`.
std::vector<SlabCorner> front_corners(const ContactScene& scene, const Slab& slab, const Vector3& direction) {
  std::vector<SlabCorner> corners = scene.facing_corners(slab, direction);
  double farthest = -std::numeric_limits<double>::infinity();
  for (const SlabCorner& corner : corners) farthest = std::max(farthest, corner.position.dot(direction));
  std::erase_if(corners, [&](const SlabCorner& corner) { return corner.position.dot(direction) <= farthest - level_tolerance; });
  return corners;
}

}  // namespace

std::vector<PairDraft> find_slab_corners(const ContactDescription& contact, const ContactScene& scene) {
  const auto sides = scene.structures(contact, "slab-corners");
  if (!sides) return {};
  std::vector<PairDraft> drafts;
  bool level = false;
  for (const Slab* left : scene.slabs_of(sides->first)) {
    for (const Slab* right : scene.slabs_of(sides->second)) {
      if (std::abs(scene.level(*left) - scene.level(*right)) >= level_tolerance) continue;
      level = true;
      const auto near = front_corners(scene, *left, contact.direction), far = front_corners(scene, *right, -contact.direction);
      if (near.size() != 2 || far.size() != 2) {
        scene.error(contact.at, fmt::format("slabs '{}' and '{}' do not face each other with two corners each; kind = \"slab-edges\" "
                                            "takes slabs that are turned", left->id, right->id));
        return {};
      }
      const double length = std::min((near[1].position - near[0].position).norm(), (far[1].position - far[0].position).norm());
      for (std::size_t i = 0; i < 2; ++i) {
        PairDraft& draft = drafts.emplace_back();
        draft.at = contact.at;
        draft.level = scene.level(*left);
        draft.pair.name = scene.node_id(near[i].node) + "|" + scene.node_id(far[i].node);
        draft.pair.a = node_point(near[i].node, near[i].position, true);
        draft.pair.b = node_point(far[i].node, far[i].position, true);
        draft.pair.normal = contact.direction;
        draft.pair.rigid_bodies = left->rigid && right->rigid;
        draft.pair.room = {SlidingRoom{-length, length},
                           vertical_room(scene.level(*left), scene.level(*right), 0.5 * (left->thickness + right->thickness))};
        draft.distance = (far[i].position - near[i].position).dot(contact.direction);
      }
    }
  }
  if (!level) {
    scene.error(contact.at, fmt::format("structures '{}' and '{}' have no slabs at the same level; kind = \"slab-columns\" or \"facing\" "
                                        "takes slabs between the floors of the other", contact.a.name, contact.b->name));
  }
  return drafts;
}

}  // namespace nsframe
