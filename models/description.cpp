// Special members of what is large: made here once, not in every source that holds a description.
#include "models/description.hpp"

namespace nsframe {

StructureDescription::StructureDescription() = default;
StructureDescription::StructureDescription(const StructureDescription&) = default;
StructureDescription::StructureDescription(StructureDescription&&) noexcept = default;
StructureDescription& StructureDescription::operator=(const StructureDescription&) = default;
StructureDescription& StructureDescription::operator=(StructureDescription&&) noexcept = default;
StructureDescription::~StructureDescription() = default;

ModelDescription::ModelDescription() = default;
ModelDescription::ModelDescription(const ModelDescription&) = default;
ModelDescription::ModelDescription(ModelDescription&&) noexcept = default;
ModelDescription& ModelDescription::operator=(const ModelDescription&) = default;
ModelDescription& ModelDescription::operator=(ModelDescription&&) noexcept = default;
ModelDescription::~ModelDescription() = default;

}  // namespace nsframe
