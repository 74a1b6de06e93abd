// From the tables of a scene to the descriptions of the model, and back for structures.
#pragma once

#include <filesystem>
#include <utility>
#include <vector>

#include "base/diagnostics.hpp"
#include "models/materials.hpp"
#include "models/wall.hpp"
#include "scene/scene.hpp"
#include "scene/tables.hpp"

namespace nsframe {

// Fills scene.model from scene.tables: resolves short forms, cuts sections into fibers, expands parametric structures
// and reads the records.
void describe_model(Scene& scene, Diagnostics& diagnostics);

SectionDescription describe(const SectionTable& section, const std::vector<MaterialDescription>& materials);
StructureDescription describe(const ExplicitStructure& structure);
StructureDescription describe(const StoryFrameTable& frame);
Wall describe(const WallTable& wall, const ExplicitStructure& structure);
// Name and nodes only.
StructureDescription describe_nodes(const ExplicitStructure& structure);
// Laws and sections of its own that the structure's elements name: of struts, and of walls by thickness.
std::vector<MaterialDescription> own_materials(const ExplicitStructure& structure);
std::vector<SectionDescription> own_sections(const ExplicitStructure& structure);
DampingDescription describe(const DampingTable& damping);
// One for two neighbours of a row of structures.
std::vector<ContactDescription> describe(const ContactTable& contact);

// Two sides of a contact, however they are written; of several in a row, each with the next.
using ContactSides = std::pair<Reference, Reference>;
std::vector<ContactSides> sides(const ContactTable& contact);
ContactKind contact_kind(const ContactTable& contact, const ContactSides& sides);

// The tables that describe() turns into this structure.
ExplicitStructure tables(const StructureDescription& structure);
DampingTable table(const DampingDescription& damping);

}  // namespace nsframe
