// From the tables of a scene to the descriptions of the model, and back for structures.
#pragma once

#include <filesystem>
#include <utility>

#include "base/diagnostics.hpp"
#include "models/materials.hpp"
#include "scene/scene.hpp"
#include "scene/tables.hpp"

namespace nsframe {

// Fills scene.model from scene.tables: resolves short forms, cuts sections into fibers, expands parametric structures
// and reads the records.
void describe_model(Scene& scene, Diagnostics& diagnostics);

SectionDescription describe(const SectionTable& section, const std::vector<MaterialDescription>& materials);
StructureDescription describe(const ExplicitStructure& structure);
StructureDescription describe(const StoryFrameTable& frame);
// Laws of its own that the structure's elements name: of struts.
std::vector<MaterialDescription> own_materials(const ExplicitStructure& structure);
DampingDescription describe(const DampingTable& damping);
ContactDescription describe(const ContactTable& contact);

// The two sides of a contact, and its kind, however they are written.
std::pair<Reference, Reference> sides(const ContactTable& contact);
ContactKind contact_kind(const ContactTable& contact);

// The tables that describe() turns into this structure.
ExplicitStructure tables(const StructureDescription& structure);
DampingTable table(const DampingDescription& damping);

}  // namespace nsframe
