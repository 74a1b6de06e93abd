// One node against another, or against a fixed wall.
#include "models/contact_geometry.hpp"

namespace nsframe {

std::vector<PairDraft> find_nodes(const ContactDescription& contact, const ContactScene& scene) {
  const int a = scene.node(contact.a), b = contact.b ? scene.node(*contact.b) : -1;
  if (a < 0 || (contact.b && b < 0)) return {};
  if (contact.gap.size() > 1) {
    scene.error(contact.at, "a contact of two nodes has one gap");
    return {};
  }
  if (contact.gap.empty() && !contact.b && !contact.wall) {
    scene.error(contact.at, "a contact with the ground needs its gap, or a wall");
    return {};
  }
  PairDraft draft;
  draft.at = contact.at;
  draft.level = scene.position(a).z();
  draft.pair.name = scene.node_id(a) + "|" + (b >= 0 ? scene.node_id(b) : "wall");
  draft.pair.a = node_point(a, scene.position(a), b >= 0);
  if (b >= 0) draft.pair.b = node_point(b, scene.position(b), true);
  draft.pair.normal = contact.direction;
  draft.pair.rigid_bodies = true;
  if (!contact.gap.empty()) return {draft};  // nodes of small models often stand anywhere: a given gap counts alone
  if (b >= 0) draft.distance = (scene.position(b) - scene.position(a)).dot(contact.direction);
  if (b < 0 && contact.wall) draft.distance = (*contact.wall - scene.position(a)).dot(contact.direction);
  return {draft};
}

}  // namespace nsframe
