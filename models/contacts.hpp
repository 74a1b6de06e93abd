// Contact pairs of a model: unilateral constraints g = H q + g0 >= 0 (theory.md, eq. 10), one row of H a pair.
#pragma once

#include <array>
#include <limits>
#include <string>
#include <vector>

#include "base/types.hpp"
#include "models/contact_law.hpp"
#include "models/contact_point.hpp"

namespace nsframe {

// How far b may slide against a along one tangent and still be in front of it [m].
struct SlidingRoom {
  double least = -std::numeric_limits<double>::infinity(), most = std::numeric_limits<double>::infinity();
};

struct ContactPair {
  std::string name;
  ContactPoint a, b;                     // b fixed: a wall
  Vector3 normal = Vector3::UnitX();     // from a to b
  bool rigid_bodies = false;             // both sides belong to rigid bodies, so restitution acts on whole slabs
  std::array<SlidingRoom, 2> room;       // along tangents(normal)
  double sliding_error = 1e-3;           // of the gap, beyond which a run warns [m]
  ContactLawChoice law;
};

struct Contacts {
  std::vector<ContactPair> pairs;
  SparseRows jacobian;                   // H (pairs x free DOFs): gap rate = H velocity
  VectorX initial_gap;                   // g0 [m], positive open
  VectorX restitution;                   // e of Newton's or Poisson's law, or what the damping of a law of force is meant to give [-]
  VectorX friction;                      // Coulomb's mu [-]; empty when no pair has any
  SparseRows tangents;                   // (2 pairs x free DOFs): rows 2i, 2i + 1 give the slip rate of b on a along tangents(normal);
                                         // without rows when no pair has friction, rows of zeros where a pair has none

  int size() const { return static_cast<int>(pairs.size()); }
  bool frictional() const { return friction.size() > 0; }
};

// A row of the Jacobian: the velocity of b relative to a along `direction`, full DOFs.
inline void add_row(const ContactPair& pair, const Vector3& direction, int row, std::vector<Eigen::Triplet<double>>& entries) {
  Vector6 along = Vector6::Zero();
  along.head<3>() = direction;
  add_row(pair.a, -along, row, entries);
  add_row(pair.b, along, row, entries);
}

}  // namespace nsframe
