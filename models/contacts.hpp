// Contact pairs of a model: unilateral constraints g = H q + g0 >= 0 (theory.md, eq. 10), one row of H a pair.
#pragma once

#include <string>
#include <vector>

#include "base/types.hpp"

namespace nsframe {

struct ContactPair {
  std::string name;
  int node_a = -1;                       // index into Model::nodes
  int node_b = -1;                       // -1: a fixed wall
  Vector3 normal = Vector3::UnitX();     // from a to b
  bool rigid_bodies = false;             // both sides belong to rigid bodies, so restitution acts on whole slabs
};

struct Contacts {
  std::vector<ContactPair> pairs;
  SparseRows jacobian;                   // H (pairs x free DOFs): gap rate = H velocity
  VectorX initial_gap;                   // g0 [m], positive open
  VectorX restitution;                   // Newton's e [-]

  int size() const { return static_cast<int>(pairs.size()); }
};

}  // namespace nsframe
