#include "models/build_contacts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace nsframe {

namespace {

constexpr double level_tolerance = 1e-3;  // [m] nodes nearer than this count as one level or one face

struct PairDraft {
  ContactPair pair;
  double gap, restitution;
  Location at;
};

class ContactBuilder {
 public:
  ContactBuilder(const ModelDescription& description, const Model& model, Diagnostics& diagnostics)
      : description_(description), model_(model), diagnostics_(diagnostics) {}

  void add(const ContactDescription& contact) {
    if (!(contact.restitution >= 0 && contact.restitution <= 1)) {
      diagnostics_.error(contact.at, fmt::format("restitution = {}, must lie in [0, 1]", contact.restitution));
    }
    if (!(std::abs(contact.direction.norm() - 1) < 1e-9)) {
      diagnostics_.error(contact.at, "the direction of a contact must be a unit vector");
    }
    if (contact.kind == ContactKind::nodes) {
      add_nodes(contact);
    } else {
      add_slab_corners(contact);
    }
  }
  Contacts finish() const;

 private:
  void add_nodes(const ContactDescription& contact);
  void add_slab_corners(const ContactDescription& contact);
  // `index`: of the pair within its contact, for its own gap.
  void add_pair(const ContactDescription& contact, int a, int b, std::size_t index, bool rigid);
  int node(const Reference& reference);
  int structure(const Reference& reference);
  std::vector<const Slab*> slabs_of(int description) const;
  // The corners of a slab farthest along `direction`, in the order of rising position across it.
  std::vector<int> facing_corners(const Slab& slab, const Vector3& direction) const;
  double level(const Slab& slab) const;
  const Vector3& position(int node) const { return model_.nodes.position[static_cast<std::size_t>(node)]; }

  const ModelDescription& description_;
  const Model& model_;
  Diagnostics& diagnostics_;
  std::vector<PairDraft> drafts_;
};

int ContactBuilder::node(const Reference& reference) {
  const auto& ids = model_.nodes.id;
  const auto found = std::find(ids.begin(), ids.end(), reference.name);
  if (found != ids.end()) return static_cast<int>(found - ids.begin());
  diagnostics_.error(reference.at, fmt::format("node '{}' is not defined{}", reference.name, did_you_mean(reference.name, ids)));
  return -1;
}

int ContactBuilder::structure(const Reference& reference) {
  std::vector<std::string> names;
  for (const StructureDescription& item : description_.structures) {
    if (item.name == reference.name) return static_cast<int>(names.size());
    names.push_back(item.name);
  }
  diagnostics_.error(reference.at, fmt::format("structure '{}' is not defined{}", reference.name, did_you_mean(reference.name, names)));
  return -1;
}

double ContactBuilder::level(const Slab& slab) const {
  double sum = 0;
  for (const int corner : slab.corners) sum += position(corner).z();
  return sum / static_cast<double>(slab.corners.size());
}

std::vector<const Slab*> ContactBuilder::slabs_of(int description) const {
  std::vector<const Slab*> slabs;
  for (const Slab& slab : model_.slabs) {
    const bool complete = std::find(slab.corners.begin(), slab.corners.end(), -1) == slab.corners.end();
    if (slab.description == description && complete) slabs.push_back(&slab);  // a missing corner is reported already
  }
  std::sort(slabs.begin(), slabs.end(), [this](const Slab* a, const Slab* b) { return level(*a) < level(*b); });
  return slabs;
}

std::vector<int> ContactBuilder::facing_corners(const Slab& slab, const Vector3& direction) const {
  double farthest = -std::numeric_limits<double>::infinity();
  for (const int corner : slab.corners) farthest = std::max(farthest, position(corner).dot(direction));
  std::vector<int> corners;
  for (const int corner : slab.corners) {
    if (position(corner).dot(direction) > farthest - level_tolerance) corners.push_back(corner);
  }
  Vector3 across = Vector3::UnitZ().cross(direction);
  if (across.x() + across.y() < 0) across = -across;
  std::sort(corners.begin(), corners.end(), [&](int a, int b) { return position(a).dot(across) < position(b).dot(across); });
  return corners;
}

void ContactBuilder::add_pair(const ContactDescription& contact, int a, int b, std::size_t index, bool rigid) {
  const std::string other = b >= 0 ? model_.nodes.id[static_cast<std::size_t>(b)] : "wall";
  const bool given = !contact.gap.empty();
  const double open = given ? contact.gap[index % contact.gap.size()] : (position(b) - position(a)).dot(contact.direction);
  const std::string name = fmt::format("{}|{}", model_.nodes.id[static_cast<std::size_t>(a)], other);
  if (!given && open < 0) {
    diagnostics_.error(contact.at, fmt::format("contact '{}': the coordinates overlap by {:g} m; give the gap or move a structure", name, -open));
  }
  drafts_.push_back({{name, a, b, contact.direction, rigid}, open, contact.restitution, contact.at});
}

void ContactBuilder::add_nodes(const ContactDescription& contact) {
  const int a = node(contact.a), b = contact.b ? node(*contact.b) : -1;
  if (a < 0 || (contact.b && b < 0)) return;
  if (contact.gap.size() > 1) diagnostics_.error(contact.at, "a contact of two nodes has one gap");
  if (contact.gap.empty() && b < 0) {
    diagnostics_.error(contact.at, "a contact with the ground needs its gap");
    return;
  }
  add_pair(contact, a, b, 0, true);
}

void ContactBuilder::add_slab_corners(const ContactDescription& contact) {
  if (!contact.b) {
    diagnostics_.error(contact.at, "slab-corners needs two structures");
    return;
  }
  const int a = structure(contact.a), b = structure(*contact.b);
  if (a < 0 || b < 0) return;
  std::vector<std::pair<const Slab*, const Slab*>> floors;
  for (const Slab* left : slabs_of(a)) {
    for (const Slab* right : slabs_of(b)) {
      if (std::abs(level(*left) - level(*right)) < level_tolerance) floors.emplace_back(left, right);
    }
  }
  if (floors.empty()) {
    diagnostics_.error(contact.at, fmt::format("structures '{}' and '{}' have no slabs at the same level", contact.a.name, contact.b->name));
    return;
  }
  std::vector<std::pair<int, int>> corners;
  std::vector<bool> rigid;
  for (const auto& [left, right] : floors) {
    const auto near = facing_corners(*left, contact.direction), far = facing_corners(*right, -contact.direction);
    if (near.size() != 2 || far.size() != 2) {
      diagnostics_.error(contact.at, fmt::format("slabs '{}' and '{}' do not face each other with two corners each", left->id, right->id));
      return;
    }
    for (std::size_t i = 0; i < 2; ++i) {
      corners.emplace_back(near[i], far[i]);
      rigid.push_back(left->rigid && right->rigid);
    }
  }
  const std::size_t given = contact.gap.size();
  if (given > 2 && given != corners.size()) {
    diagnostics_.error(contact.at, fmt::format("{} gaps for {} corners on {} floors: give one, two, or {}", given,
                                               corners.size(), floors.size(), corners.size()));
    return;
  }
  for (std::size_t i = 0; i < corners.size(); ++i) {
    add_pair(contact, corners[i].first, corners[i].second, i, rigid[i]);
  }
}

Contacts ContactBuilder::finish() const {
  Contacts contacts;
  const int count = static_cast<int>(drafts_.size());
  contacts.initial_gap.resize(count);
  contacts.restitution.resize(count);
  std::vector<Eigen::Triplet<double>> entries;
  for (int i = 0; i < count; ++i) {
    const PairDraft& draft = drafts_[static_cast<std::size_t>(i)];
    contacts.pairs.push_back(draft.pair);
    contacts.initial_gap[i] = draft.gap;
    contacts.restitution[i] = draft.restitution;
    for (int k = 0; k < 3; ++k) {
      if (draft.pair.normal[k] == 0) continue;
      entries.emplace_back(i, 6 * draft.pair.node_a + k, -draft.pair.normal[k]);
      if (draft.pair.node_b >= 0) entries.emplace_back(i, 6 * draft.pair.node_b + k, draft.pair.normal[k]);
    }
  }
  SparseRows full(count, model_.dofs.full);
  full.setFromTriplets(entries.begin(), entries.end());
  contacts.jacobian = full * model_.dofs.transformation;
  for (int i = 0; i < count; ++i) {
    if (contacts.jacobian.row(i).norm() == 0) {
      const PairDraft& draft = drafts_[static_cast<std::size_t>(i)];
      diagnostics_.error(draft.at, fmt::format("contact '{}': both sides are held by supports in its direction", draft.pair.name));
    }
  }
  return contacts;
}

}  // namespace

Contacts build_contacts(const ModelDescription& description, const Model& model, Diagnostics& diagnostics) {
  ContactBuilder builder(description, model, diagnostics);
  for (const ContactDescription& contact : description.contacts) builder.add(contact);
  return builder.finish();
}

}  // namespace nsframe
