#include "scene/describe.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "motion/record.hpp"
#include "motion/spline.hpp"
#include "scene/describe_stage.hpp"

namespace nsframe {

namespace {

// What is wrong with the file is reported at its line, what is wrong with what the scene says of it at the motion.
std::optional<Record> read(const MotionTable& motion, const std::filesystem::path& directory, Diagnostics& diagnostics) {
  if (motion.file.name.empty()) return std::nullopt;  // reported by the reader
  try {
    ReadOptions options{motion.dt, motion.unit, motion.channel, motion.format ? motion.format->name : ""};
    if (motion.quantity == MotionQuantity::displacement) options.unit = AccelerationUnit::metres;  // the numbers as they are
    return read_record(directory / motion.file.name, options);
  } catch (const RecordError& fault) {
    diagnostics.error(fault.at.line > 0 ? fault.at : motion.file.at, fault.text);
  } catch (const IoError&) {
    diagnostics.error(motion.file.at, "cannot open the record '" + (directory / motion.file.name).string() + "'");
  }
  return std::nullopt;
}

std::optional<MotionDescription> describe(const MotionTable& motion, const std::filesystem::path& directory,
                                          Diagnostics& diagnostics) {
  const auto record = read(motion, directory, diagnostics);
  if (!record) return std::nullopt;
  double factor = motion.factor.value_or(1);
  if (motion.pga) {
    double peak = 0;
    for (const double a : record->acceleration) peak = std::max(peak, std::abs(a));
    if (peak == 0) {
      diagnostics.error(motion.file.at,
                        "record '" + motion.file.name + "' is zero throughout and can't be scaled to a pga");
      return std::nullopt;
    }
    factor = *motion.pga / peak;
  }
  MotionDescription out{motion.at, motion.file.name, record->dt, record->acceleration, motion.direction.vector, motion.delay, motion.supports, {}};
  for (double& a : out.acceleration) a *= factor;
  if (motion.wave) out.wave = WaveDescription{motion.wave->at, motion.wave->direction.vector, motion.wave->velocity};
  if (motion.quantity == MotionQuantity::displacement) {
    double peak = 0;
    for (const double u : out.acceleration) peak = std::max(peak, std::abs(u));
    if (std::abs(out.acceleration.front()) > 1e-6 * peak) {
      diagnostics.error(motion.file.at, "displacements of record '" + motion.file.name + "' must begin at zero");
      return std::nullopt;
    }
    out.acceleration = spline_accelerations(out.acceleration, out.dt);
  }
  return out;
}

}  // namespace

SectionDescription describe(const SectionTable& section, const std::vector<MaterialDescription>& materials) {
  SectionDescription out;
  out.name = section.name;
  out.at = section.at;
  const auto find = [&materials](const Reference& material) {
    return std::find_if(materials.begin(), materials.end(), [&](const auto& m) { return m.name == material.name; });
  };
  // 0 when there is no material of that name, which build_model() reports
  const ElasticModulus modulus = [&](const Reference& material) {
    const auto found = find(material);
    return found == materials.end() ? 0 : initial_tangent(found->law);
  };
  std::visit([&](const auto& kind) { describe(kind, modulus, out); }, section.kind);
  out.faulty = section.faulty;
  if (const auto* fibers = std::get_if<FiberSectionDescription>(&out.kind)) {
    for (const FiberDescription& fiber : fibers->fibers) {
      const auto found = find(fiber.material);
      if (found != materials.end() && found->faulty) out.faulty = true;
    }
  }
  return out;
}

std::vector<ContactSides> sides(const ContactTable& contact) {
  if (contact.a && contact.b) return {{*contact.a, *contact.b}};
  std::vector<ContactSides> out;
  for (std::size_t i = 0; i + 1 < contact.between.size(); ++i) out.emplace_back(contact.between[i], contact.between[i + 1]);
  return out;
}

ContactKind contact_kind(const ContactTable& contact, const ContactSides& sides) {
  if (contact.kind) return *contact.kind;
  if (contact.a || sides.first.name.find('.') != std::string::npos) return ContactKind::nodes;
  return sides.second.name == "ground" ? ContactKind::wall : ContactKind::slab_corners;
}

std::vector<ContactDescription> describe(const ContactTable& contact) {
  std::vector<ContactDescription> out;
  for (const ContactSides& pair : sides(contact)) {
    ContactDescription& one = out.emplace_back();
    one.at = contact.at;
    one.name = contact.name;
    one.kind = contact_kind(contact, pair);
    one.a = pair.first;
    if (pair.second.name != "ground") one.b = pair.second;
    one.direction = contact.direction.vector;
    one.gap = contact.gap.values;
    if (!contact.restitution.values.empty()) one.restitution = contact.restitution.values.front();
    if (contact.restitution.values.size() > 1) one.restitutions = contact.restitution.values;
    one.friction = contact.friction;
    if (faults(contact.law, {}).empty()) one.law = contact.law;  // else the checks of the scene have told it
    one.wall = contact.wall;
    one.reach = contact.reach;
    one.gap_tolerance = contact.gap_tolerance;
    one.sliding_error = contact.sliding_error;
  }
  return out;
}

namespace {

void fill_restitution(ContactTable& contact) {
  const ContactForceLaw* law = contact_force_law(contact.law.name);
  const bool elastic = law != nullptr && law->coefficient == nullptr;
  if (contact.restitution.values.empty() && !elastic && !contact.law.damping_ratio) contact.restitution.values = {ContactDescription{}.restitution};
}

// The outline of a wall's section must be that of the wall: depth and width are easily exchanged.
void check_walls(const ExplicitStructure& structure, const std::vector<SectionDescription>& sections, Diagnostics& diagnostics) {
  constexpr double rounding = 0.01;  // of the length
  for (const WallTable& wall : structure.walls) {
    for (const Reference& name : wall.section) {
      const auto found = std::find_if(sections.begin(), sections.end(), [&](const auto& section) { return section.name == name.name; });
      if (found == sections.end() || found->outline.empty() || found->faulty) continue;
      const auto [least, most] = std::minmax_element(found->outline.begin(), found->outline.end(),
                                                     [](const Vector2& a, const Vector2& b) { return a.x() < b.x(); });
      if (const double depth = most->x() - least->x(); std::abs(depth - wall.length) > rounding * wall.length)
        diagnostics.error(name.at, fmt::format("section '{}' is {:.4g} m deep (local y), wall '{}' is {:.4g} m long", name.name, depth,
                                               wall.id.name, wall.length));
    }
  }
}

}  // namespace

void describe_model(Scene& scene, Diagnostics& diagnostics) {
  ModelDescription& model = scene.model;
  model = {};
  for (const MaterialTable& m : scene.tables.materials) model.materials.push_back({m.name, m.at, m.law, m.faulty});
  for (const StructureTable& structure : scene.tables.structures) {
    if (const auto* s = std::get_if<ExplicitStructure>(&structure)) {
      for (MaterialDescription& own : own_materials(*s)) model.materials.push_back(std::move(own));
    }
  }
  resolve_in_place(model.materials, diagnostics);
  for (const SectionTable& s : scene.tables.sections) model.sections.push_back(describe(s, model.materials));
  for (const StructureTable& structure : scene.tables.structures) {
    const auto* s = std::get_if<ExplicitStructure>(&structure);
    if (!s) continue;
    for (SectionDescription& own : own_sections(*s)) model.sections.push_back(std::move(own));
    check_walls(*s, model.sections, diagnostics);
  }
  for (const StructureTable& structure : scene.tables.structures) {
    if (const auto* frame = std::get_if<StoryFrameTable>(&structure); frame && !faults(frame->frame).empty()) {
      // Reported where it was read; the name stays known to contacts.
      StructureDescription& empty = model.structures.emplace_back();
      empty.name = frame->frame.name;
      empty.at = frame->frame.at;
      continue;
    }
    std::visit([&](const auto& s) { model.structures.push_back(describe(s)); }, structure);
  }
  for (ContactTable& contact : scene.tables.contacts) fill_restitution(contact);
  for (const ContactTable& contact : scene.tables.contacts)
    for (ContactDescription& described : describe(contact)) model.contacts.push_back(std::move(described));
  for (const MotionTable& motion : scene.tables.motions)
    if (auto described = describe(motion, scene.directory, diagnostics)) model.motions.push_back(std::move(*described));
  for (const StageTable& stage : scene.tables.stages)
    if (auto described = describe(stage, model.stages.size() + 1, scene.directory, diagnostics))
      model.stages.push_back(std::move(*described));
  if (const auto& gravity = scene.tables.gravity)
    model.gravity = {gravity->acceleration * gravity->direction.vector, gravity->statically_first};
}

}  // namespace nsframe
