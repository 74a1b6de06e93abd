// A wall as a wide column (MacLeod 1967): one beam-column a story along its axis, and at every node of the axis rigid arms
// to the wall's two edges and to further nodes within it, from which beams start. expand() turns it into elements, nodes
// and rigid bodies, nothing in the rest of the program knows of it.
//
// The edges of axis node 11 are the nodes 11- and 11+, at half the length against and along `direction`; the member of
// story k, from the foot, is the element ID-k.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "models/description.hpp"

namespace nsframe {

struct Wall {
  ElementDescription member;            // id and place of the wall, and what the members of all stories share
  std::vector<Reference> nodes;         // on the axis, each above the one before
  std::vector<Reference> section;       // one, or one a story; its depth (local y) lies along `direction`
  Vector3 direction = Vector3::UnitX(); // of the wall's length, horizontal unit vector
  double length = 0;                    // between the edges [m]
  double width = 0;                     // across, within which attached nodes lie [m]
  std::vector<Reference> attached;      // further nodes that follow the axis at their level
};

// A solid rectangle of this length along local y; shear areas of 5/6 of the area (Timoshenko).
ElasticSection wall_section(double length, double thickness, double E, double poisson);

// What is wrong with the places of a wall's nodes, each with the name that it is about. Names that `structure` doesn't have
// are left to build_model().
std::vector<std::pair<Reference, std::string>> faults(const Wall& wall, const StructureDescription& structure);

// Adds the wall to a structure that has its nodes. What faults() finds is left out.
void expand(const Wall& wall, StructureDescription& structure);

}  // namespace nsframe
