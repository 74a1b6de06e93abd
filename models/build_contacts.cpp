#include "models/build_contacts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "models/contact_geometry.hpp"

namespace nsframe {

namespace {

struct KindOfContact {
  ContactKind kind;
  PairFinder find;
};

// The registry.
constexpr KindOfContact kinds_of_contact[] = {
    {ContactKind::nodes, find_nodes},
    {ContactKind::slab_corners, find_slab_corners},
    {ContactKind::slab_edges, find_slab_edges},
    {ContactKind::slab_columns, find_slab_columns},
    {ContactKind::facing, find_facing},
    {ContactKind::wall, find_wall},
};

struct FinishedPair {
  PairDraft draft;
  double gap = 0, restitution = 0, friction = 0;
};

// Floor by floor from the lowest, and on each by rising position across the contact. Returns the floor of each.
std::vector<int> sort_by_floor(std::vector<PairDraft>& drafts, const Vector3& direction) {
  const Vector3 side = across(direction);
  std::stable_sort(drafts.begin(), drafts.end(), [&](const PairDraft& p, const PairDraft& q) {
    if (std::abs(p.level - q.level) > level_tolerance) return p.level < q.level;
    return p.pair.a.position.dot(side) < q.pair.a.position.dot(side) - level_tolerance;
  });
  std::vector<int> floor;
  for (std::size_t i = 0; i < drafts.size(); ++i) {
    const bool next = i > 0 && drafts[i].level - drafts[i - 1].level > level_tolerance;
    floor.push_back(i == 0 ? 0 : floor.back() + next);
  }
  return floor;
}

// Values listed one for all, one a pair of a floor, or one a pair: spread over the pairs. Empty after an error.
std::vector<double> spread(const std::vector<double>& values, const std::vector<int>& floor, std::string_view what, const Location& at,
                           Diagnostics& diagnostics) {
  const std::size_t pairs = floor.size(), floors = static_cast<std::size_t>(floor.back()) + 1;
  std::vector<std::size_t> of_floor(floors, 0);
  for (const int f : floor) ++of_floor[static_cast<std::size_t>(f)];
  const bool regular = std::all_of(of_floor.begin(), of_floor.end(), [&](std::size_t n) { return n == of_floor[0]; });
  const std::size_t period = values.size() == 1 || values.size() == pairs || (regular && values.size() == of_floor[0]) ? values.size() : 0;
  if (period == 0) {
    const std::string by_floor = regular && floors > 1 && of_floor[0] > 1 ? fmt::format(", {}", of_floor[0]) : "";
    diagnostics.error(at, fmt::format("{} {} for {} pairs on {} floor{}: give one{}, or {}", values.size(), what, pairs, floors,
                                      floors == 1 ? "" : "s", by_floor, pairs));
    return {};
  }
  std::vector<double> all(pairs);
  for (std::size_t i = 0; i < pairs; ++i) all[i] = values[i % period];
  return all;
}

// The gap as given or from the coordinates; both must agree as far as slabs may overhang.
double gap_of(const PairDraft& draft, const ContactDescription& contact, const std::vector<double>& given, std::size_t i, Diagnostics& diagnostics) {
  if (given.empty()) {
    if (*draft.distance < 0) {
      diagnostics.error(draft.at, fmt::format("contact '{}': the coordinates overlap by {:g} m; give the gap or move a structure",
                                              draft.pair.name, -*draft.distance));
    }
    return *draft.distance;
  }
  if (draft.distance && std::abs(given[i] - *draft.distance) > contact.gap_tolerance) {
    diagnostics.error(draft.at, fmt::format("contact '{}': a gap of {:g} m is given, but the coordinates are {:g} m apart; they may differ by "
                                            "gap_tolerance = {:g} m", draft.pair.name, given[i], *draft.distance, contact.gap_tolerance));
  }
  return given[i];
}

void check_numbers(const ContactDescription& contact, Diagnostics& diagnostics) {
  std::vector<double> restitutions = contact.restitutions;
  restitutions.push_back(contact.restitution);
  for (const double e : restitutions) {
    if (!(e >= 0 && e <= 1)) diagnostics.error(contact.at, fmt::format("restitution = {}, must lie in [0, 1]", e));
  }
  if (!(contact.friction >= 0 && std::isfinite(contact.friction))) {
    diagnostics.error(contact.at, fmt::format("friction = {}, must not be negative", contact.friction));
  }
  for (const ContactLawFault& fault : faults(contact.law, {})) diagnostics.error(contact.at, fault.message);
  const ContactLawChoice& law = contact.law;
  for (const auto& number : {law.stiffness, law.stiffness_ratio, law.hertz_stiffness, law.effective_mass}) {
    if (number && !(*number > 0 && std::isfinite(*number))) {
      diagnostics.error(contact.at, fmt::format("contact law '{}': stiffness and mass must be positive, not {:g}", law.name, *number));
    }
  }
  if (law.damping_ratio && !(*law.damping_ratio >= 0 && std::isfinite(*law.damping_ratio))) {
    diagnostics.error(contact.at, fmt::format("damping_ratio = {:g}, must not be negative", *law.damping_ratio));
  }
  if (!(std::abs(contact.direction.norm() - 1) < 1e-9)) diagnostics.error(contact.at, "the direction of a contact must be a unit vector");
}

// What the law makes of the restitutions: those of its damping ratio, 1 of an elastic one.
void apply_law(const ContactDescription& contact, std::vector<double>& restitution, Diagnostics& diagnostics) {
  const ContactForceLaw* law = contact_force_law(contact.law.name);
  if (law == nullptr) return;
  const bool elastic = law->coefficient == nullptr;
  for (double& e : restitution) {
    if (elastic) e = 1;
    if (contact.law.damping_ratio) e = restitution_of(*law, *contact.law.damping_ratio);
    if (elastic || e >= law->least_restitution) continue;
    diagnostics.error(contact.at, fmt::format("contact law '{}' needs a restitution of at least {:g}", law->name, law->least_restitution));
  }
}

void add(const ContactDescription& contact, const ContactScene& scene, std::vector<FinishedPair>& pairs, Diagnostics& diagnostics) {
  check_numbers(contact, diagnostics);
  const auto geometry = std::ranges::find(kinds_of_contact, contact.kind, &KindOfContact::kind);
  std::vector<PairDraft> drafts = geometry->find(contact, scene);
  if (drafts.empty()) return;
  const std::vector<int> floor = sort_by_floor(drafts, contact.direction);
  std::vector<double> gap, restitution(drafts.size(), contact.restitution);
  if (!contact.gap.empty()) {
    gap = spread(contact.gap, floor, "gaps", contact.at, diagnostics);
    if (gap.empty()) return;
  }
  if (!contact.restitutions.empty()) {
    restitution = spread(contact.restitutions, floor, "restitutions", contact.at, diagnostics);
    if (restitution.empty()) return;
  }
  apply_law(contact, restitution, diagnostics);
  for (std::size_t i = 0; i < drafts.size(); ++i) {
    PairDraft& draft = drafts[i];
    ContactPair& pair = draft.pair;
    const double open = gap_of(draft, contact, gap, i, diagnostics);
    pair.sliding_error = contact.sliding_error;
    pair.law = contact.law;
    if (pair.b.fixed()) pair.b.position = pair.a.position + open * pair.normal;
    if (!contact.name.empty()) pair.name = contact.name + ":" + pair.name;
    pairs.push_back({std::move(draft), open, restitution[i], contact.friction});
  }
}

// Slip rates of the pairs with friction; none when there is no such pair.
void add_friction(const std::vector<FinishedPair>& pairs, const Model& model, Contacts& contacts) {
  if (std::none_of(pairs.begin(), pairs.end(), [](const FinishedPair& pair) { return pair.friction > 0; })) return;
  const int count = static_cast<int>(pairs.size());
  contacts.friction.resize(count);
  std::vector<Eigen::Triplet<double>> entries;
  for (int i = 0; i < count; ++i) {
    const FinishedPair& finished = pairs[static_cast<std::size_t>(i)];
    contacts.friction[i] = finished.friction;
    if (finished.friction == 0) continue;
    const std::array<Vector3, 2> along = tangents(finished.draft.pair.normal);
    for (int k = 0; k < 2; ++k) add_row(finished.draft.pair, along[static_cast<std::size_t>(k)], 2 * i + k, entries);
  }
  SparseRows full(2 * count, model.dofs.full);
  full.setFromTriplets(entries.begin(), entries.end());
  contacts.tangents = full * model.dofs.transformation;
}

Contacts finish(const std::vector<FinishedPair>& pairs, const Model& model, Diagnostics& diagnostics) {
  Contacts contacts;
  const int count = static_cast<int>(pairs.size());
  contacts.initial_gap.resize(count);
  contacts.restitution.resize(count);
  std::vector<Eigen::Triplet<double>> entries;
  for (int i = 0; i < count; ++i) {
    const auto& [draft, gap, restitution, friction] = pairs[static_cast<std::size_t>(i)];
    contacts.pairs.push_back(draft.pair);
    contacts.initial_gap[i] = gap;
    contacts.restitution[i] = restitution;
    add_row(draft.pair, draft.pair.normal, i, entries);
  }
  SparseRows full(count, model.dofs.full);
  full.setFromTriplets(entries.begin(), entries.end());
  contacts.jacobian = full * model.dofs.transformation;
  add_friction(pairs, model, contacts);
  for (int i = 0; i < count; ++i) {
    if (contacts.jacobian.row(i).norm() == 0) {
      const PairDraft& draft = pairs[static_cast<std::size_t>(i)].draft;
      diagnostics.error(draft.at, fmt::format("contact '{}': both sides are held by supports in its direction", draft.pair.name));
    }
  }
  return contacts;
}

}  // namespace

Contacts build_contacts(const ModelDescription& description, const Model& model, Diagnostics& diagnostics) {
  const ContactScene scene(description, model, diagnostics);
  std::vector<FinishedPair> pairs;
  for (const ContactDescription& contact : description.contacts) add(contact, scene, pairs, diagnostics);
  return finish(pairs, model, diagnostics);
}

}  // namespace nsframe
