// Points of structures that may touch: each moves with a few nodes, u = sum of S_k u_k (theory.md, "Contact geometry").
#pragma once

#include <array>
#include <vector>

#include "base/types.hpp"
#include "elements/element_group.hpp"

namespace nsframe {

// What a node's six DOFs add to displacement and rotation of a point (6 x 6), global axes.
struct PointShare {
  int node = -1;  // index into Model::nodes
  Matrix6 of_node = Matrix6::Identity();
};

struct ContactPoint {
  Vector3 position = Vector3::Zero();  // [m]
  std::vector<PointShare> shares;      // empty: fixed
  bool face = false;                   // lies in a face that the other side may slide along; else a corner

  bool fixed() const { return shares.empty(); }
  int first_node() const { return fixed() ? -1 : shares.front().node; }
};

ContactPoint node_point(int node, const Vector3& position, bool face);
// Between two nodes of an edge, at `along` in [0, 1]: linear in displacements; turns with the chord, and about it by the
// linear mean of the nodes' rotations. At an end it is that node.
ContactPoint edge_point(int first, int second, const Vector3& start, const Vector3& end, double along);
// On the axis of a beam, by the shape functions of an elastic one, carried to the nodes by its rigid arms.
ContactPoint beam_point(const ElementNodes& nodes, const ElementShape& shape, const Vector3& first_node, double along);

// Two unit vectors across a normal; the first is horizontal unless the normal is vertical.
std::array<Vector3, 2> tangents(const Vector3& normal);

// Adds w . (displacement, rotation) of the point to a row of triplets over the full DOFs.
void add_row(const ContactPoint& point, const Vector6& w, int row, std::vector<Eigen::Triplet<double>>& entries);

}  // namespace nsframe
