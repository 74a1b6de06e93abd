#include "models/build_elements.hpp"

#include <fmt/format.h>

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
  return {1.0, 1.0, k(0, 0), k(1, 1), k(2, 2), section.torsion_stiffness};
}

// True when axial force and bending, or the two bendings, are coupled: A, Iz, Iy alone cannot describe the section.
bool couples(const FiberSection& section) {
  const Matrix3 k = initial_tangent(section);
  const auto coupled = [&k](int i, int j) { return std::abs(k(i, j)) > 1e-6 * std::sqrt(k(i, i) * k(j, j)); };
  return coupled(0, 1) || coupled(0, 2) || coupled(1, 2);
}

Library::Section resolve(const SectionDescription& section, const Materials& materials,
                         Diagnostics& diagnostics) {
  Library::Section resolved{&section, {}, nullptr};
  if (const auto* elastic = std::get_if<ElasticSection>(&section.kind)) {
    resolved.elastic = *elastic;
    for (const auto& [value, name] : {std::pair{elastic->E, "E"}, {elastic->G, "G"}, {elastic->A, "A"},
                                      {elastic->Iz, "Iz"}, {elastic->Iy, "Iy"}, {elastic->J, "J"}}) {
      if (!(value > 0)) diagnostics.error(section.at, fmt::format("section '{}': {} must be positive", section.name, name));
    }
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
    if (!(fiber.area > 0)) diagnostics.error(section.at, fmt::format("section '{}': a fiber's area must be positive", section.name));
    fibers.push_back({fiber.y, fiber.z, fiber.area, law->second});
  }
  if (description.fibers.empty()) diagnostics.error(section.at, fmt::format("section '{}' has no fibers", section.name));
  if (!(description.torsion_stiffness > 0)) {
    diagnostics.error(section.at, fmt::format("section '{}': the torsion stiffness GJ must be positive", section.name));
  }
  auto built = std::make_shared<FiberSection>(fibers, description.torsion_stiffness);
  resolved.elastic = elastic_constants(*built);
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
    if (!library.sections.emplace(section.name, resolve(section, library.materials, diagnostics)).second) {
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
                       const Vector3& node_j, const std::string& id) {
  const Vector3 end_i = node_i + element.offset[0], end_j = node_j + element.offset[1];
  Matrix3 axes;
  try {
    axes = beam_axes(end_i, end_j, element.orientation);
  } catch (const std::invalid_argument& problem) {
    diagnostics_.error(element.at, fmt::format("element '{}': {}", id, problem.what()));
    return;
  }
  const BeamFrame frame(end_i, end_j, axes, element.offset);
  if (element.kind == ElementKind::truss || element.kind == ElementKind::cable) {
    add_truss(element, nodes, frame, id);
  } else {
    add_beam(element, nodes, frame, id);
  }
}

void GroupBuilder::add_beam(const ElementDescription& element, const ElementNodes& nodes, const BeamFrame& frame,
                            const std::string& id) {
  const Library::Section* section = find(library_.sections, element.section, "section", diagnostics_);
  if (!section) return;
  const int geometry = static_cast<int>(element.geometry);
  const SectionOutline& outline = section->description->outline;
  if (element.kind == ElementKind::elastic_beam) {
    if (section->fibers && couples(*section->fibers)) {
      diagnostics_.error(element.section.at,
                         fmt::format("element '{}' is elastic, but the fibers of section '{}' are not centred on their "
                                     "principal axes; use a fiber element, or give A, Iz, Iy, J",
                                     id, element.section.name));
      return;
    }
    group<ElasticBeams>(fmt::format("elastic {}", geometry), element.geometry).add(nodes, id, frame, section->elastic, outline);
    return;
  }
  if (!section->fibers) {
    diagnostics_.error(element.section.at, fmt::format("element '{}' needs fibers, section '{}' has elastic constants only",
                                                       id, element.section.name));
    return;
  }
  if (element.points < 3 || element.points > 10) {
    diagnostics_.error(element.at, fmt::format("element '{}': points = {}, must lie in [3, 10]", id, element.points));
    return;
  }
  const std::string key = fmt::format("fiber {} {} {}", static_cast<int>(element.kind), geometry, element.points);
  if (element.kind == ElementKind::displacement_beam) {
    group<DisplacementBeams>(key, element.geometry, element.points).add(nodes, id, frame, section->fibers, outline);
  } else {
    group<ForceBeams>(key, element.geometry, element.points).add(nodes, id, frame, section->fibers, outline);
  }
}

void GroupBuilder::add_truss(const ElementDescription& element, const ElementNodes& nodes, const BeamFrame& frame,
                             const std::string& id) {
  const UniaxialLaw* law = find(library_.materials, element.material, "material", diagnostics_);
  if (!law) return;
  if (frame.has_offsets()) {
    diagnostics_.error(element.at, fmt::format("element '{}': a {} has no offsets, they would bend it", id,
                                               element.kind == ElementKind::cable ? "cable" : "truss"));
    return;
  }
  if (!(element.area > 0)) {
    diagnostics_.error(element.at, fmt::format("element '{}': the area must be positive", id));
    return;
  }
  Trusses::Kind kind = is_linear(*law) && element.pretension == 0 ? Trusses::Kind::linear : Trusses::Kind::nonlinear;
  if (element.kind == ElementKind::cable) {
    kind = Trusses::Kind::cable;
    if (!is_linear(*law)) {
      diagnostics_.error(element.material.at, fmt::format("cable '{}' needs an Elastic material; '{}' is not", id, element.material.name));
    }
    if (element.pretension < 0) diagnostics_.error(element.at, fmt::format("cable '{}': negative pretension", id));
  }
  group<Trusses>(fmt::format("truss {} {}", static_cast<int>(kind), static_cast<int>(element.geometry)), kind, element.geometry)
      .add(nodes, id, frame, *law, element.area, element.pretension);
}

void GroupBuilder::add(const SpringDescription& spring, const ElementNodes& nodes, const std::string& id) {
  SpringProperties properties;
  properties.stiffness = spring.stiffness;
  properties.damping = spring.damping;
  bool linear = true;
  for (std::size_t i = 0; i < 6; ++i) {
    if (!spring.law[i]) continue;
    const UniaxialLaw* law = find(library_.materials, *spring.law[i], "material", diagnostics_);
    if (!law) continue;
    properties.law[i] = *law;
    linear = linear && is_linear(*law);
  }
  group<Springs>(fmt::format("spring {}", linear), linear).add(nodes, id, std::move(properties));
}

std::vector<std::unique_ptr<const ElementGroup>> GroupBuilder::take() {
  std::vector<std::unique_ptr<const ElementGroup>> taken;
  for (auto& [key, group] : groups_) taken.push_back(std::move(group));
  groups_.clear();
  return taken;
}

}  // namespace nsframe
