// A regular building frame by few parameters: stories, bays, sections, slabs, braces and masses. expand() turns it into
// explicit nodes and elements, nothing in the rest of the program knows of it.
//
// Plan: the column lines stand on a grid of `spans` in x and y; the outer corners are counted around the plan.
// Node ids: floor * 10 + i (100, 1000 ... in place of 10 when a floor has more nodes than fit), floor 0 the base;
// i = 1..4 the outer corners (-x,-y), (+x,-y), (+x,+y), (-x,+y), 5 the slab's centre, 6... the other column lines by
// rising y, then x. Where a column line passes through the centre, its node is the centre. Nodes within a column have the id
// of the node below them and a letter: 2a, 2b.
// Element ids run story by story: columns, beams along x, beams along y, slab links, braces.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "models/description.hpp"
#include "models/dof_names.hpp"

namespace nsframe {

enum class BeamKind { elastic, displacement, force_based };
enum class BarKind { truss, cable };

ElementKind element_kind(BeamKind kind);
ElementKind element_kind(BarKind kind);

// Directions that the ends of a beam release, local axes.
struct EndReleases {
  DofSet i, j;
};
// In basic directions; ux and rx are the same at both ends.
Releases basic_releases(const EndReleases& ends);

// Columns or beams. Lists have one entry a story, from the lowest.
struct FrameMembers {
  std::vector<Reference> section;  // one, or one a story
  std::vector<Reference> end_section;  // of fiber beams, at the first and last point; none, one, or one a story
  BeamKind element = BeamKind::elastic;
  int points = 5;  // integration points of a fiber beam
  Integration integration;
  bool inner_iterations = false;  // of force-based beams
  MemberMass mass;
  Geometry geometry = Geometry::linear;
  std::optional<EndReleases> releases;
  std::array<double, 2> rigid_ends{0, 0};  // lengths of rigid zones at the first and the second node [m]
};

struct FrameBeams : FrameMembers {
  std::vector<double> load;  // [N/m] downwards on every beam; none, one, or one a story
};

enum class PlanAxis { x, y };

struct FrameColumns : FrameMembers {
  PlanAxis depth = PlanAxis::x;  // direction of the section's depth (its local y)
  std::vector<double> split;     // levels above the base that have a node in every column, e.g. a neighbour's floors [m]
};

enum class SlabKind { links, rigid, diaphragm };

// How a floor is tied to its centre: by elastic links to the column lines, as one rigid body, or in its plane only.
struct FrameSlab {
  SlabKind kind = SlabKind::rigid;
  Reference section;        // links only
  double thickness = 0.12;  // [m], for drawing only
};

enum class BracePlane { x_low, x_high, y_low, y_high };

// Crossed braces, two in each story and bay of the chosen outer planes.
struct FrameBraces {
  std::vector<BracePlane> planes;
  BarKind kind = BarKind::truss;
  Reference material;
  std::vector<double> area;  // [m2], one, or one a story
  double pretension = 0;     // [N]
};

enum class BaseKind { fixed, pinned, spring };

// spring: translations and the rotation about z are fixed, the rotations about x and y held by springs.
struct FrameBase {
  BaseKind kind = BaseKind::fixed;
  double stiffness = 0;  // [N m/rad]
};

// A uniform rectangular plate has the same inertia about all axes of its plan as a third of its mass shared by its
// four corners and two thirds at its centre; vertically all is carried by the column lines, by tributary area.
struct FrameMass {
  std::vector<double> floor;           // [kg], one, or one a story
  double centre_share = 2.0 / 3;       // of the horizontal mass; the outer corners have the rest
  std::vector<double> centre_inertia;  // [kg m2], extra, about z at the centre; none, one, or one a story
};

struct StoryFrame {
  std::string name;
  Location at;
  int stories = 1;
  std::vector<double> height{3.0};          // [m], one, or one a story
  std::array<std::vector<double>, 2> plan;  // [m] spans along x and y; one value: a length shared by `bays`
  std::array<int, 2> bays{1, 1};
  Vector3 origin = Vector3::Zero();  // [m], of the plan's corner (-x, -y) at the base
  FrameColumns columns;
  std::optional<FrameBeams> beams;
  FrameSlab slab;
  std::optional<FrameBraces> braces;
  FrameBase base;
  FrameMass mass;
  DampingDescription damping;
};

// Names what is wrong with the lists of `frame` (a list of neither one nor `stories` values, no plan); empty if
// nothing.
std::vector<std::string> faults(const StoryFrame& frame);

// Throws InputError with the first of faults(frame), if any.
StructureDescription expand(const StoryFrame& frame);

}  // namespace nsframe
