// Builds the transformation u = T q from supports and constraints.
#pragma once

#include <array>
#include <vector>

#include "base/diagnostics.hpp"
#include "models/dof_map.hpp"

namespace nsframe {

// A constraint with its references resolved to node indices.
struct NodeConstraint {
  Location at;
  int master = -1;
  int slave = -1;
  // For every constrained direction of the slave: the combination of the master's six directions that it follows.
  std::array<bool, 6> constrained{};
  Matrix6 follows = Matrix6::Zero();
  Matrix6 own = Matrix6::Zero();      // and of the slave's directions that are not constrained
};

// Rigid body: u_s = u_m + r_m x arm, r_s = r_m, with arm from master to slave [m].
NodeConstraint rigid_body_constraint(int master, int slave, const Vector3& arm, const Location& at);
// Rigid diaphragm: the two displacements in its plane and the rotation about `normal` (of any length) follow.
NodeConstraint diaphragm_constraint(int master, int slave, const Vector3& arm, const Vector3& normal, const Location& at);
NodeConstraint equal_dof_constraint(int master, int slave, const std::array<bool, 6>& dofs, const Location& at);

// `fixed`: full DOFs without freedom. `order`: nodes in the order in which their free DOFs are numbered.
// Reports constraints that contradict supports or each other, or that follow each other in a circle.
DofMap build_dof_map(const std::vector<bool>& fixed, const std::vector<NodeConstraint>& constraints,
                     const std::vector<int>& order, const std::vector<std::string>& node_names, Diagnostics& diagnostics);

}  // namespace nsframe
