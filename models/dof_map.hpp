// From the six DOFs of every node (full vector, 6 per node: ux uy uz rx ry rz) to the free DOFs, by the linear
// transformation u = T q that supports, rigid bodies, diaphragms and equal DOFs define. The ground moves with the
// base: all displacements are relative to it.
#pragma once

#include <vector>

#include "base/types.hpp"

namespace nsframe {

struct FreeDof {
  int node = -1;       // node that carries it (the master of a constraint)
  int direction = 0;   // 0..5
};

struct DofMap {
  int full = 0;                       // 6 * nodes
  std::vector<FreeDof> free;          // in the order of q; DOFs of one structure are contiguous
  SparseRows transformation;          // T (full x free)
  SparseRows transformation_transposed;

  int size() const { return static_cast<int>(free.size()); }
  VectorX expand(const VectorX& q) const { return transformation * q; }
  // Full DOF `6 node + direction` is fixed when its row of T is empty.
  bool fixed(int full_dof) const { return transformation.row(full_dof).nonZeros() == 0; }
};

}  // namespace nsframe
