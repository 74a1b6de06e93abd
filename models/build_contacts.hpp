// Contact descriptions to contact pairs and their Jacobian. A new kind of contact geometry is registered here.
#pragma once

#include "models/model.hpp"

namespace nsframe {

Contacts build_contacts(const ModelDescription& description, const Model& model, Diagnostics& diagnostics);

}  // namespace nsframe
