#include "models/build_elements.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "elements/displacement_beam.hpp"
#include "elements/elastic_beam.hpp"
#include "elements/force_beam.hpp"
#include "elements/spring.hpp"
#include "elements/truss.hpp"

namespace nsframe {

namespace {

// Elastic constants of a fiber section: its initial tangent with E = 1 Pa carried in A and I, and GJ likewise.
ElasticSection elastic_constants(const FiberSection& section) {
  const Matrix3 k = initial_tangent(section);
  const auto shear = [&section](std::size_t axis) { return section.added[axis] ? initial_tangent(*section.added[axis]) : 0; };
  return {1.0, 1.0, k(0, 0), k(1, 1), k(2, 2), section.torsion_stiffness, shear(0), shear(1)};
}

// True when axial force and bending, or the two bendings, are coupled: A, Iz, Iy alone cannot describe the section.
bool couples(const FiberSection& section) {
  const Matrix3 k = initial_tangent(section);
  const auto coupled = [&k](int i, int j) { return std::abs(k(i, j)) > 1e-6 * std::sqrt(k(i, i) * k(j, j)); };
  return coupled(0, 1) || coupled(0, 2) || coupled(1, 2);
}

// Rows: local axes with x along `x` and y in the plane of `x` and `in_plane`, on the side of the latter.
Matrix3 axes_in_plane(const Vector3& x, const Vector3& in_plane) {
  if (!(x.norm() > 0)) throw std::invalid_argument("zero length");
  Matrix3 axes;
  axes.row(0) = x.normalized();
  const Vector3 z = axes.row(0).transpose().cross(in_plane);
  if (!(z.norm() > 1e-6 * in_plane.norm())) throw std::invalid_argument("the vector in the x-y plane is parallel to x");
  axes.row(2) = z.normalized();
  axes.row(1) = axes.row(2).cross(axes.row(0));
  return axes;
}

// Four elastic fibers with the area and second moments of a section of constants: the same section exactly.
std::shared_ptr<const FiberSection> elastic_fibers(const ElasticSection& s) {
  const double y = std::sqrt(s.Iz / s.A), z = std::sqrt(s.Iy / s.A);
  std::vector<Fiber> fibers;
  for (const auto& [at_y, at_z] : {std::pair{-y, -z}, {y, -z}, {-y, z}, {y, z}}) fibers.push_back({at_y, at_z, s.A / 4, Elastic{s.E}});
  AddedLaws shear;
  if (s.Ay > 0) shear[0] = Elastic{s.G * s.Ay};
  if (s.Az > 0) shear[1] = Elastic{s.G * s.Az};
  return std::make_shared<FiberSection>(fibers, s.G * s.J, std::move(shear));
}

MassSection mass_section(const std::vector<Fiber>& fibers) {
  MassSection m;
  for (const Fiber& f : fibers) {
    m.A += f.area;
    m.Iz += f.area * f.y * f.y;
    m.Iy += f.area * f.z * f.z;
  }
  return m;
}

// The law of torsion or shear of a section; nothing after an error.
std::optional<UniaxialLaw> added_law(const SectionDescription& section, const Reference& reference, const Materials& materials,
                                     Diagnostics& diagnostics) {
  const auto law = materials.find(reference.name);
  if (law == materials.end()) {
    diagnostics.error(reference.at, fmt::format("material '{}' is not defined{}", reference.name,
                                                did_you_mean(reference.name, keys(materials))));
    return {};
  }
  if (is_rate_dependent(law->second) || !(initial_tangent(law->second) > 0)) {
    diagnostics.error(reference.at, fmt::format("section '{}': material '{}' has no stiffness at rest, which torsion and shear need",
                                                section.name, reference.name));
    return {};
  }
  return law->second;
}

Library::Section resolve(const SectionDescription& section, const Materials& materials, double screening,
                         Diagnostics& diagnostics) {
  Library::Section resolved{&section, {}, nullptr, {}};
  const auto error = [&](const std::string& what) {
    if (!section.faulty) diagnostics.error(section.at, fmt::format("section '{}'{}", section.name, what));
  };
  if (const auto* elastic = std::get_if<ElasticSection>(&section.kind)) {
    resolved.elastic = *elastic;
    for (const auto& [value, name] : {std::pair{elastic->E, "E"}, {elastic->G, "G"}, {elastic->A, "A"},
                                      {elastic->Iz, "Iz"}, {elastic->Iy, "Iy"}, {elastic->J, "J"}}) {
      if (!(value > 0)) error(fmt::format(": {} must be positive", name));
    }
    for (const auto& [value, name] : {std::pair{elastic->Ay, "Ay"}, {elastic->Az, "Az"}}) {
      if (!(value >= 0)) error(fmt::format(": {} must not be negative", name));
    }
    resolved.is_elastic = true;
    resolved.fibers = elastic_fibers(*elastic);
    resolved.mass = {elastic->A, elastic->Iz, elastic->Iy};
    return resolved;
  }
  const auto& description = std::get<FiberSectionDescription>(section.kind);
  std::vector<Fiber> fibers;
  std::string unknown;
  for (const FiberDescription& fiber : description.fibers) {
    const auto law = materials.find(fiber.material.name);
    if (law == materials.end()) {
      if (unknown != fiber.material.name) {
        diagnostics.error(fiber.material.at, fmt::format("material '{}' is not defined{}", fiber.material.name,
                                                         did_you_mean(fiber.material.name, keys(materials))));
      }
      unknown = fiber.material.name;
      continue;
    }
    if (is_rate_dependent(law->second)) {
      if (unknown != fiber.material.name) {
        diagnostics.error(fiber.material.at,
                          fmt::format("section '{}': the stress of material '{}' depends on the rate of strain, which only "
                                      "springs, links and trusses follow", section.name, fiber.material.name));
      }
      unknown = fiber.material.name;
      continue;
    }
    if (!(fiber.area > 0)) error(": a fiber's area must be positive");
    fibers.push_back({fiber.y, fiber.z, fiber.displaced ? -fiber.area : fiber.area, law->second, fiber.material.name});
  }
  if (description.fibers.empty()) error(" has no fibers");
  AddedLaws added;
  for (const auto& [law, reference] : {std::pair{0, description.shear_y}, {1, description.shear_z}, {2, description.torsion}}) {
    if (reference) added[static_cast<std::size_t>(law)] = added_law(section, *reference, materials, diagnostics);
  }
  // without its material there is no G
  if (!description.torsion && !(description.torsion_stiffness > 0) && unknown.empty()) error(": the torsion stiffness GJ must be positive");
  auto built = std::make_shared<FiberSection>(fibers, description.torsion_stiffness, std::move(added), screening);
  resolved.elastic = elastic_constants(*built);
  if (const ElasticSection& e = resolved.elastic; e.A < 0 || e.Iz < 0 || e.Iy < 0) {
    error(": more is displaced than there is");
  }
  resolved.mass = mass_section(fibers);
  resolved.fibers = std::move(built);
  return resolved;
}

template <class Table>
const typename Table::mapped_type* find(const Table& table, const Reference& reference, const char* what,
                                        Diagnostics& diagnostics) {
  const auto found = table.find(reference.name);
  if (found != table.end()) return &found->second;
  diagnostics.error(reference.at, fmt::format("{} '{}' is not defined{}", what, reference.name,
                                              did_you_mean(reference.name, keys(table))));
  return nullptr;
}

}  // namespace

Library build_library(const ModelDescription& description, Diagnostics& diagnostics) {
  Library library;
  library.materials = resolve_materials(description.materials, diagnostics);
  for (const SectionDescription& section : description.sections) {
    if (!library.sections.emplace(section.name, resolve(section, library.materials, description.screening, diagnostics)).second) {
      diagnostics.error(section.at, fmt::format("section '{}' is defined twice", section.name));
    }
  }
  return library;
}

template <class Group, class... Arguments>
Group& GroupBuilder::group(const std::string& key, Arguments&&... arguments) {
  for (auto& [name, existing] : groups_) {
    if (name == key) return static_cast<Group&>(*existing);
  }
  groups_.emplace_back(key, std::make_unique<Group>(std::forward<Arguments>(arguments)...));
  return static_cast<Group&>(*groups_.back().second);
}

void GroupBuilder::add(const ElementDescription& element, const ElementNodes& nodes, const Vector3& node_i,
                       const Vector3& node_j, const std::string& id, const std::vector<const LoadDescription*>& loads) {
  const Vector3 end_i = node_i + element.offset[0], end_j = node_j + element.offset[1];
  Matrix3 axes;
  try {
    axes = beam_axes(end_i, end_j, element.orientation);
  } catch (const std::invalid_argument& problem) {
    return error(element.at, "element", id, fmt::format(": {}", problem.what()));
  }
  const BeamFrame frame(end_i, end_j, axes, element.offset);
  if (element.kind == ElementKind::truss || element.kind == ElementKind::cable) {
    for (const LoadDescription* load : loads) {
      diagnostics_.error(load->at, fmt::format("element '{}' is a truss or cable, which carries no load between its ends", id));
    }
    return add_truss(element, nodes, frame, id);
  }
  const Library::Section* section = find(library_.sections, element.section, "section", diagnostics_);
  if (!section) return;
  Beam beam{element, id, nodes, frame, section, {}};
  for (const LoadDescription* load : loads) {
    (load->local ? beam.load.uniform : beam.load.dead_uniform) += load->uniform;
    if (!load->force.isZero(0)) (load->local ? beam.load.points : beam.load.dead_points).push_back({load->position, load->force});
  }
  add_mass(beam);
  if (element.kind == ElementKind::elastic_beam) {
    add_elastic(beam);
  } else {
    add_fiber(beam);
  }
}

void GroupBuilder::error(const Location& at, std::string_view kind, const std::string& id, const std::string& what) {
  const auto same = [&](const Fault& told) {
    return !at.file.empty() && told.at.file == at.file && told.at.line == at.line && told.at.column == at.column && told.what == what;
  };
  if (const auto found = std::find_if(faults_.begin(), faults_.end(), same); found != faults_.end()) {
    ++found->others;
  } else {
    faults_.push_back({at, fmt::format("{} '{}'", kind, id), what});
  }
}

void GroupBuilder::tell_errors() {
  for (const Fault& fault : faults_) {
    const std::string others = fault.others > 0 ? fmt::format(" (and {} more)", fault.others) : "";
    diagnostics_.error(fault.at, fault.subject + others + fault.what);
  }
  faults_.clear();
}

// The matrix of the member's own mass, and its weight as a load along the member.
void GroupBuilder::add_mass(Beam& beam) {
  const MemberMass& mass = beam.element.mass;
  if (!mass.any()) return;
  const auto& released = beam.element.releases.basic;
  if (mass.consistent && (released[0] || released[5])) {
    return error(beam, "a consistent mass needs the axial force and the torsion of both ends tied; use a lumped mass");
  }
  const double L = beam.frame.length;
  const ElasticSection& s = beam.section->elastic;
  MassSection section = beam.section->mass;
  if (s.Ay > 0) section.shear_ratio_y = 12 * s.E * s.Iz / (s.G * s.Ay * L * L);
  if (s.Az > 0) section.shear_ratio_z = 12 * s.E * s.Iy / (s.G * s.Az * L * L);
  Matrix12 to_local = Matrix12::Zero();
  for (int block = 0; block < 12; block += 3) to_local.block<3, 3>(block, block) = beam.frame.axes;
  to_local = to_local * member_ends(beam.element.releases, elastic_basic_stiffness(s, L), beam.frame);
  masses_.push_back({beam.id, beam.nodes, to_local.transpose() * member_mass_matrix(mass, section, L) * to_local});
  beam.load.dead_uniform += gravity_ * mass_per_length(mass, section);
}

void GroupBuilder::add_elastic(const Beam& beam) {
  const ElementDescription& element = beam.element;
  const Library::Section& section = *beam.section;
  if (!section.is_elastic && couples(*section.fibers)) {
    return error(element.section.at, "element", beam.id,
                 fmt::format(" is elastic, but the fibers of section '{}' are not centred on their principal axes; use a fiber element, "
                             "or give A, Iz, Iy, J", element.section.name));
  }
  if (element.integration.rule != Integration{}.rule) return error(beam, "an elastic beam has no integration points");
  if (element.inner_iterations) return error(beam, "an elastic beam has no inner_iterations, element = \"force-based\" has");
  if (!element.sections.empty()) return error(beam, "an elastic beam has one section throughout");
  group<ElasticBeams>(fmt::format("elastic {}", static_cast<int>(element.geometry)), element.geometry)
      .add(beam.nodes, beam.id, {beam.frame, section.elastic, section.description->outline, beam.load, element.releases});
}

// Sections of a fiber beam by integration point; empty after an error.
std::vector<const Library::Section*> GroupBuilder::sections_at_points(const Beam& beam, int points) {
  const std::vector<Reference>& named = beam.element.sections;
  const auto count = static_cast<std::size_t>(points);
  if (named.empty()) return std::vector<const Library::Section*>(count, beam.section);
  if (named.size() != 3 && named.size() != count) {
    error(beam, fmt::format("{} sections, must be 3 (first point, interior, last) or {}, one a point", named.size(), points));
    return {};
  }
  std::vector<const Library::Section*> sections;
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t which = named.size() == count ? i : i == 0 ? 0 : i + 1 == count ? 2 : 1;
    sections.push_back(find(library_.sections, named[which], "section", diagnostics_));
    if (!sections.back()) return {};
  }
  return sections;
}

void GroupBuilder::add_fiber(const Beam& beam) {
  const ElementDescription& element = beam.element;
  if (element.inner_iterations && element.kind == ElementKind::displacement_beam) {
    return error(beam, "a displacement-based beam has no inner_iterations, element = \"force-based\" has");
  }
  FiberMember member{beam.frame, {}, {}, beam.section->description->outline, beam.load, element.releases, element.inner_iterations};
  try {
    member.rule = make_quadrature(element.integration, element.points, beam.frame.length);
  } catch (const std::invalid_argument& problem) {
    return error(beam, problem.what());
  }
  bool has_fibers = false, aggregated = false;
  for (const Library::Section* section : sections_at_points(beam, member.rule.size())) {
    const AddedLaws& added = section->fibers->added;
    if (element.kind == ElementKind::displacement_beam && (added[0] || added[1])) {
      return error(beam, fmt::format("section '{}' deforms in shear, which elastic and force-based beams do, and "
                                     "displacement-based ones don't", section->description->name));
    }
    aggregated = aggregated || added[0] || added[1] || added[2];
    has_fibers = has_fibers || !section->is_elastic;
    member.sections.push_back(section->fibers);
  }
  if (member.sections.empty()) return;
  if (!has_fibers) {
    return error(element.section.at, "element", beam.id,
                 fmt::format(" needs fibers, section '{}' has elastic constants only", element.section.name));
  }
  const std::string key = fmt::format("fiber {} {}", static_cast<int>(element.kind), static_cast<int>(element.geometry));
  if (element.kind == ElementKind::displacement_beam) {
    group<DisplacementBeams>(key, element.geometry).add(beam.nodes, beam.id, std::move(member));
  } else if (aggregated) {
    group<AggregatedForceBeams>("aggregated " + key, element.geometry).add(beam.nodes, beam.id, std::move(member));
  } else {
    group<ForceBeams>(key, element.geometry).add(beam.nodes, beam.id, std::move(member));
  }
}

void GroupBuilder::add_truss(const ElementDescription& element, const ElementNodes& nodes, const BeamFrame& frame,
                             const std::string& id) {
  const UniaxialLaw* law = find(library_.materials, element.material, "material", diagnostics_);
  if (!law) return;
  if (frame.has_offsets()) {
    return error(element.at, "element", id,
                 fmt::format(": a {} has no offsets, they would bend it", element.kind == ElementKind::cable ? "cable" : "truss"));
  }
  if (!(element.area > 0)) {
    return error(element.at, "element", id, ": the area must be positive");
  }
  Trusses::Kind kind = is_linear(*law) && element.pretension == 0 ? Trusses::Kind::linear : Trusses::Kind::nonlinear;
  if (is_rate_dependent(*law)) kind = Trusses::Kind::damper;
  if (element.kind == ElementKind::cable) {
    kind = Trusses::Kind::cable;
    if (!is_linear(*law)) {
      error(element.material.at, "cable", id, fmt::format(" needs an Elastic material; '{}' is not", element.material.name));
    }
    if (element.pretension < 0) error(element.at, "cable", id, ": negative pretension");
  }
  group<Trusses>(fmt::format("truss {} {}", static_cast<int>(kind), static_cast<int>(element.geometry)), kind, element.geometry)
      .add(nodes, id, frame, *law, element.area, element.pretension);
}

void GroupBuilder::add(const SpringDescription& spring, const ElementNodes& nodes, const Vector3& end_i, const Vector3& end_j,
                       const std::string& id) {
  SpringProperties properties;
  try {
    if (spring.shear_distance) {
      properties.length = (end_j - end_i).norm();
      properties.shear_distance = *spring.shear_distance;
      properties.axes = spring.in_plane ? axes_in_plane(end_j - end_i, *spring.in_plane) : beam_axes(end_i, end_j, {});
    } else if (spring.in_plane) {
      properties.axes = axes_in_plane(spring.x, *spring.in_plane);
    }
  } catch (const std::invalid_argument& problem) {
    diagnostics_.error(spring.at, fmt::format("spring '{}': {}", id, problem.what()));
    return;
  }
  properties.stiffness = spring.stiffness;
  properties.damping = spring.damping;
  properties.p_delta = spring.p_delta;
  Springs::Kind kind{!spring.p_delta, false, spring.p_delta.has_value()};
  for (std::size_t i = 0; i < 6; ++i) {
    if (!spring.law[i]) continue;
    const UniaxialLaw* law = find(library_.materials, *spring.law[i], "material", diagnostics_);
    if (!law) continue;
    properties.law[i] = *law;
    kind.linear = kind.linear && is_linear(*law);
    kind.rates = kind.rates || is_rate_dependent(*law);
    if (i == 0 && spring.p_delta && is_rate_dependent(*law)) {
      diagnostics_.error(spring.law[i]->at, fmt::format("spring '{}': the P-Delta moments are those of an axial force that doesn't "
                                                        "depend on the rate of deformation", id));
    }
  }
  group<Springs>(fmt::format("spring {} {} {}", kind.linear, kind.rates, kind.p_delta), kind).add(nodes, id, std::move(properties));
}

std::vector<std::shared_ptr<const ElementGroup>> GroupBuilder::take() {
  tell_errors();
  std::vector<std::shared_ptr<const ElementGroup>> taken;
  for (auto& [key, group] : groups_) taken.push_back(std::move(group));
  groups_.clear();
  return taken;
}

}  // namespace nsframe
