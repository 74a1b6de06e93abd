// What a scene says, as plain data in SI units, before any numbering: the scene reader fills it, parametric
// buildings (story_frame.hpp) fill it, C++ users may fill it, and build_model() turns it into a Model.
// Every item knows where it was read, so that build_model() can report errors by place.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "base/diagnostics.hpp"
#include "base/types.hpp"
#include "elements/member_geometry.hpp"
#include "elements/member_mass.hpp"
#include "elements/quadrature.hpp"
#include "elements/releases.hpp"
#include "elements/sections.hpp"
#include "materials/uniaxial.hpp"
#include "models/contact_law.hpp"
#include "models/static_stage.hpp"

namespace nsframe {

struct MaterialDescription {
  std::string name;
  Location at;
  UniaxialLaw law;
  bool faulty = false;  // an error in it was reported already
};

struct NodeDescription {
  std::string id;
  Location at;
  Vector3 position = Vector3::Zero();  // [m]
};

// Fixes DOFs of a node; order ux, uy, uz, rx, ry, rz.
struct SupportDescription {
  Reference node;
  std::array<bool, 6> fixed{};
};

// Lumped mass with rotational inertia about the global axes through the node.
struct MassDescription {
  Reference node;
  Vector3 mass = Vector3::Zero();     // along x, y, z [kg]
  Vector3 inertia = Vector3::Zero();  // about x, y, z [kg m2]
};

enum class ElementKind { elastic_beam, displacement_beam, force_beam, truss, cable };

// A member between two nodes.
struct ElementDescription {
  std::string id;
  Location at;
  ElementKind kind = ElementKind::elastic_beam;
  Reference node_i, node_j;
  Reference section;                   // beams only
  Reference material;                  // truss and cable only
  double area = 0;                     // [m2], truss and cable only
  double pretension = 0;               // [N], truss and cable only, positive in tension
  int points = 5;                      // integration points of a fiber beam
  Integration integration;             // fiber beams only
  bool inner_iterations = false;       // force-based beams only: never carry unbalanced sections from one evaluation to the next
  // Fiber beams only: sections at the integration points, one each, or three (first point, interior, last); `section`
  // then only gives the outline. Empty: `section` throughout.
  std::vector<Reference> sections;
  Releases releases;                   // beams only
  MemberMass mass;                     // beams only
  Geometry geometry = Geometry::linear;
  std::array<Vector3, 2> offset{Vector3::Zero(), Vector3::Zero()};  // beams: rigid arms from the nodes to the member's
                                                                    // ends, global axes [m]
  std::optional<Vector3> orientation;  // a vector in the local x-z plane (OpenSees' vecxz); default: see beam_axes()
};

// A static load on beams, per length or at one place, along global or the beams' local axes.
struct LoadDescription {
  Location at;
  std::vector<Reference> elements;
  bool local = false;
  Vector3 uniform = Vector3::Zero();  // [N/m] of the beam's length
  Vector3 force = Vector3::Zero();    // [N]
  double position = 0.5;              // of `force` along the beam, in [0, 1]
};

// Springs and dashpots between two nodes at (nominally) one place, or between the ground and a node (node_j empty), or, as
// a link, between two nodes apart, in six directions along local axes. A direction with a law uses it (force against
// displacement) instead of `stiffness`.
struct SpringDescription {
  std::string id;
  Location at;
  Reference node_i;
  std::optional<Reference> node_j;
  Vector6 stiffness = Vector6::Zero();                    // [N/m], [N m/rad]
  Vector6 damping = Vector6::Zero();                      // [N s/m], [N m s/rad]
  // Local axes: x, and a vector in the local x-y plane (OpenSees' -orient); of a link, whose x runs to node_j, only the
  // latter counts, by default that of a beam. Default: the global axes.
  Vector3 x = Vector3::UnitX();
  std::optional<Vector3> in_plane;
  // Of a link: place of its shear springs along local y and z, in [0, 1] from node_i.
  std::optional<Vector2> shear_distance;
  // Of a link: shares of the moment N delta that the ends take as moments, about local y at i and j, about local z at i and
  // j; a couple of shear forces balances the rest. None: no P-Delta.
  std::optional<std::array<double, 4>> p_delta;
  std::array<std::optional<Reference>, 6> law;            // material: "stress" is force [N, N m], "strain" displacement
};

enum class ConstraintKind {
  rigid_body,  // all six DOFs of the slaves follow the master (rigid slab, rigid link)
  diaphragm,   // displacements in its plane and the rotation about its normal follow the master
  equal_dof    // the listed DOFs of the slaves equal those of the master
};

struct ConstraintDescription {
  Location at;
  ConstraintKind kind = ConstraintKind::rigid_body;
  Reference master;
  std::vector<Reference> slaves;
  std::array<bool, 6> dofs{true, true, true, true, true, true};  // equal_dof only
  Vector3 normal = Vector3::UnitZ();                             // diaphragm only, of any length
};

// A slab as seen by contact and by the output: its corner nodes in order around it. How it carries load is said by
// elements or constraints.
struct SlabDescription {
  std::string id;
  Location at;
  std::vector<Reference> corners;
  std::optional<Reference> center;
  double thickness = 0.12;  // [m], for drawing only
  bool rigid = false;       // impacts act on the whole slab, not on the corner's share of it
};

enum class DampingKind { none, modal, rayleigh };
// Which tangent Rayleigh damping takes: that of the first rest, of the last step, or of the present iteration.
enum class DampingStiffness { initial, committed, current };

struct DampingDescription {
  Location at;
  DampingKind kind = DampingKind::none;
  // modal: damping ratios of the first modes in order, or by name: L1 (x), T1 (y), R1 (about z), V1 (z)
  std::vector<double> ratios;
  std::vector<std::pair<Reference, double>> named_ratios;
  // rayleigh: C = mass_factor M + stiffness_factor K, from two frequencies and ratios when `frequencies` is set
  double mass_factor = 0;                            // [1/s]
  double stiffness_factor = 0;                       // [s]
  DampingStiffness stiffness = DampingStiffness::initial;
  std::optional<std::array<double, 2>> frequencies;  // [Hz]
  std::array<double, 2> frequency_ratios{};          // [-]
};

// Initial value of one DOF (0..5) relative to the base.
struct InitialDescription {
  Reference node;
  int dof = 0;
  double value = 0;  // [m, rad] or [m/s, rad/s]
};

struct StructureDescription {
  std::string name;
  Location at;
  bool may_move_freely = false;  // a rigid-body motion without stiffness is intended (a ball, a rolling mass)
  std::vector<NodeDescription> nodes;
  std::vector<SupportDescription> supports;
  std::vector<MassDescription> masses;
  std::vector<ElementDescription> elements;
  std::vector<SpringDescription> springs;
  std::vector<LoadDescription> loads;
  std::vector<ConstraintDescription> constraints;
  std::vector<SlabDescription> slabs;
  DampingDescription damping;
  std::vector<InitialDescription> initial_displacements, initial_velocities;

  StructureDescription();
  StructureDescription(const StructureDescription&);
  StructureDescription(StructureDescription&&) noexcept;
  StructureDescription& operator=(const StructureDescription&);
  StructureDescription& operator=(StructureDescription&&) noexcept;
  ~StructureDescription();
};

// What is sought of two structures; "direction" is from the first to the second (models/contact_geometry.hpp).
enum class ContactKind {
  nodes,         // one node against another node, or against a fixed wall (b empty)
  slab_corners,  // facing corners of slabs at one level: the paper's eight-DOF contact
  slab_edges,    // corners of either structure's slabs against facing edges of the other's
  slab_columns,  // slabs of either structure against columns of the other, between its floors
  facing,        // whatever the other has at a slab's level: slab edges, else columns
  wall           // corners of slabs against a fixed plane
};

struct ContactDescription {
  Location at;
  std::string name;                     // prefix of the pairs' names
  ContactKind kind = ContactKind::slab_corners;
  Reference a;                          // a structure; nodes: "structure.node"
  std::optional<Reference> b;           // empty: the ground
  Vector3 direction = Vector3::UnitX(); // from a to b, unit vector
  std::vector<double> gap;              // [m]; one value, or one a pair of a floor in the order of rising y (or x) (the same
                                        // on all floors), or one a pair and floor, lowest floor first; empty: from the
                                        // coordinates
  double restitution = 0.6;
  std::vector<double> restitutions;     // where pairs differ, in place of `restitution`: as `gap`
  double friction = 0;                  // Coulomb's mu, static and sliding alike; 0: none
  ContactLawChoice law;
  std::optional<Vector3> wall;          // a point of the fixed plane across `direction` [m]
  double reach = 1;                     // pairs farther apart by their coordinates are not made [m]; not nodes, slab_corners
  double gap_tolerance = 0.5;           // largest difference of a given gap from the coordinates [m]
  double sliding_error = 1e-3;          // of the gap, by sliding along turned faces, beyond which a run warns [m]
};

// A wave that reaches supports one after the other.
struct WaveDescription {
  Location at;
  Vector3 direction = Vector3::UnitX();  // in which it runs, unit vector
  double velocity = 0;                   // apparent, along `direction` [m/s]
};

// Acceleration in one direction, piecewise linear between samples: of the base, or of some supports relative to the base.
struct MotionDescription {
  Location at;
  std::string source;                 // file it was read from
  double dt = 0;                      // [s]
  std::vector<double> acceleration;   // [m/s2], already scaled
  Vector3 direction = Vector3::UnitX();
  double delay = 0;                   // of the first sample [s]
  std::vector<Reference> supports;    // "structure.node"; none: the base, or, with a wave, all supports
  std::optional<WaveDescription> wave;
};

struct GravityDescription {
  Vector3 acceleration = Vector3::Zero();  // [m/s2]; zero: no gravity
  bool statically_first = true;            // with the loads on members; false: suddenly at t = 0 (a dropped body)
};

// The mechanical model as described; analysis and output options are apart (analysis.hpp).
struct ModelDescription {
  std::vector<MaterialDescription> materials;
  std::vector<SectionDescription> sections;
  std::vector<StructureDescription> structures;
  std::vector<ContactDescription> contacts;
  std::vector<MotionDescription> motions;
  GravityDescription gravity;
  double screening = 0;  // relative error of stress up to which a virgin fiber counts as linear (elements/screening.hpp)
  std::vector<StageDescription> stages;  // static, in their order, after gravity and before the motions

  ModelDescription();
  ModelDescription(const ModelDescription&);
  ModelDescription(ModelDescription&&) noexcept;
  ModelDescription& operator=(const ModelDescription&);
  ModelDescription& operator=(ModelDescription&&) noexcept;
  ~ModelDescription();
};

}  // namespace nsframe
