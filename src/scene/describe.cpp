#include "scene/describe.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "scene/describe_stage.hpp"
#include "scene/motion_file.hpp"

namespace nsframe {

namespace {

// Shear modulus by Poisson's ratio from a material of the scene; 0 when there is none of that name, which
// build_model() reports.
double shear_modulus(const Materials& materials, const std::string& name, double poisson) {
  const auto found = materials.find(name);
  return found == materials.end() ? 0 : initial_tangent(found->second) / (2 * (1 + poisson));
}

SectionOutline rectangle(double y0, double y1, double z0, double z1) {
  return {{y0, z0}, {y1, z0}, {y1, z1}, {y0, z1}};
}

void describe(const ShapeSection& section, const Materials& materials, SectionDescription& out) {
  const CatalogueShape* shape = find_shape(section.shape.name);
  FiberSectionDescription fibers;
  if (shape) {
    const ShapeMesh mesh{section.flange_width, section.flange_layers, section.web, section.fillets};
    fibers.fibers = shape_fibers(*shape, mesh, section.material);
    const double G = section.G ? *section.G : shear_modulus(materials, section.material.name, section.poisson);
    fibers.torsion_stiffness = G * section.J.value_or(shape->J);
    out.outline = shape_outline(*shape);
  }
  out.kind = std::move(fibers);
}

void describe(const ConstantsSection& section, const Materials&, SectionDescription& out) {
  ElasticSection constants = section.constants;
  constants.G = section.G.value_or(constants.E / (2 * (1 + section.poisson.value_or(0))));
  out.kind = constants;
  const double y = section.depth / 2, z = section.width / 2;
  if (y > 0 && z > 0) out.outline = rectangle(-y, y, -z, z);
}

// The outline is the rectangle around all patches.
void describe(const PatchSection& section, const Materials&, SectionDescription& out) {
  FiberSectionDescription fibers;
  Vector2 low = Vector2::Constant(std::numeric_limits<double>::infinity()), high = -low;
  for (const PatchTable& patch : section.patches) {
    const double dy = (patch.y[1] - patch.y[0]) / patch.ny, dz = (patch.z[1] - patch.z[0]) / patch.nz;
    for (int iy = 0; iy < patch.ny; ++iy)
      for (int iz = 0; iz < patch.nz; ++iz)
        fibers.fibers.push_back(
            {patch.y[0] + (iy + 0.5) * dy, patch.z[0] + (iz + 0.5) * dz, std::abs(dy * dz), patch.material});
    for (const int corner : {0, 1}) {
      const Vector2 point(patch.y[std::size_t(corner)], patch.z[std::size_t(corner)]);
      low = low.cwiseMin(point);
      high = high.cwiseMax(point);
    }
  }
  for (const FiberTable& fiber : section.fibers)
    fibers.fibers.push_back({fiber.y, fiber.z, fiber.area, fiber.material});
  fibers.torsion_stiffness = section.GJ ? *section.GJ : section.G.value_or(0) * section.J.value_or(0);
  out.kind = std::move(fibers);
  if (!section.patches.empty()) out.outline = rectangle(low.x(), high.x(), low.y(), high.y());
}

std::optional<MotionDescription> describe(const MotionTable& motion, const std::filesystem::path& directory,
                                          Diagnostics& diagnostics) {
  const auto record = read_record(motion, directory, diagnostics);
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
  MotionDescription out{motion.at, motion.file.name, record->dt, record->acceleration, motion.direction.vector};
  for (double& a : out.acceleration) a *= factor;
  return out;
}

}  // namespace

SectionDescription describe(const SectionTable& section, const Materials& materials) {
  SectionDescription out;
  out.name = section.name;
  out.at = section.at;
  std::visit([&](const auto& kind) { describe(kind, materials, out); }, section.kind);
  return out;
}

std::pair<Reference, Reference> sides(const ContactTable& contact) {
  if (contact.a && contact.b) return {*contact.a, *contact.b};
  if (contact.between.size() == 2) return {contact.between[0], contact.between[1]};
  return {};
}

ContactKind contact_kind(const ContactTable& contact) {
  if (contact.kind) return *contact.kind;
  const auto [a, b] = sides(contact);
  const bool nodes = contact.a || b.name == "ground" || a.name.find('.') != std::string::npos;
  return nodes ? ContactKind::nodes : ContactKind::slab_corners;
}

ContactDescription describe(const ContactTable& contact) {
  ContactDescription out;
  out.at = contact.at;
  out.name = contact.name;
  out.kind = contact_kind(contact);
  const auto [a, b] = sides(contact);
  out.a = a;
  if (b.name != "ground") out.b = b;
  out.direction = contact.direction.vector;
  out.gap = contact.gap.values;
  out.restitution = contact.restitution;
  return out;
}

void describe_model(Scene& scene, Diagnostics& diagnostics) {
  ModelDescription& model = scene.model;
  model = {};
  for (const MaterialTable& m : scene.tables.materials) model.materials.push_back({m.name, m.at, m.law});
  // build_model() finds the same errors again and reports them
  Diagnostics unreported;
  const Materials materials = resolve_materials(model.materials, unreported);
  if (unreported.empty())
    for (MaterialDescription& material : model.materials) material.law = materials.at(material.name);
  for (const SectionTable& s : scene.tables.sections) model.sections.push_back(describe(s, materials));
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
  for (const ContactTable& contact : scene.tables.contacts)
    if (!sides(contact).first.name.empty()) model.contacts.push_back(describe(contact));
  for (const MotionTable& motion : scene.tables.motions)
    if (auto described = describe(motion, scene.directory, diagnostics)) model.motions.push_back(std::move(*described));
  for (const StageTable& stage : scene.tables.stages)
    if (auto described = describe(stage, model.stages.size() + 1, scene.directory, diagnostics))
      model.stages.push_back(std::move(*described));
  if (const auto& gravity = scene.tables.gravity)
    model.gravity = {gravity->acceleration * gravity->direction.vector, gravity->statically_first};
}

}  // namespace nsframe
