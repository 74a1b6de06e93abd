// Names of the six DOFs of a node, in their order.
#pragma once

#include <array>

namespace nsframe {

inline constexpr std::array<const char*, 6> node_dof_names{"ux", "uy", "uz", "rx", "ry", "rz"};

}  // namespace nsframe
