// Names of the six DOFs of a node, in their order.
#pragma once

#include <array>
#include <string_view>

namespace nsframe {

inline constexpr std::array<std::string_view, 6> node_dof_names{"ux", "uy", "uz", "rx", "ry", "rz"};

// Some of the six DOFs of a node.
struct DofSet {
  std::array<bool, 6> dofs{};
};

}  // namespace nsframe
