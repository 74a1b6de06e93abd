// The tables of a scene file as structs: what is written there, in SI, before short forms are resolved. describe.hpp
// turns them into the descriptions of models/description.hpp and back; schema.hpp lists their keys.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "models/description.hpp"
#include "models/dof_names.hpp"
#include "models/story_frame.hpp"
#include "motion/units.hpp"
#include "scene/gravity_table.hpp"
#include "scene/quantity.hpp"
#include "scene/sections/sections.hpp"

namespace nsframe {

enum class Dof { ux, uy, uz, rx, ry, rz };

// --- materials and sections
// -------------------------------------------------------------------------------------------

struct MaterialTable {
  std::string name;
  Location at;
  UniaxialLaw law;
  bool faulty = false;  // an error in it was reported
};

struct SectionTable {
  std::string name;
  Location at;
  SectionKind kind;
  bool faulty = false;  // an error in it was reported
};

// --- explicit structures
// ----------------------------------------------------------------------------------------------

struct NodeTable {
  Reference id;
  double x = 0, y = 0, z = 0;  // [m]
};

struct SupportTable {
  Reference node;
  DofSet fixed;
};

struct MassTable {
  Reference node;
  std::vector<double> mass;     // [kg], one for all directions or three
  std::vector<double> inertia;  // [kg m2], none or three
};

// What beams and walls say of their elements; default: the structure's.
struct MemberKeys {
  std::optional<BeamKind> element;
  std::optional<int> points;
  std::optional<Integration> integration;
  std::optional<bool> inner_iterations;
  std::optional<MemberMass> mass;
  std::optional<Geometry> geometry;
};

struct BeamTable : MemberKeys {
  Reference id;
  std::vector<Reference> nodes;
  Reference section;
  std::vector<Reference> sections;  // in place of `section`
  std::optional<EndReleases> releases;
  std::optional<std::array<double, 3>> orientation;
  std::optional<Vector3> offset_i, offset_j;  // [m]
};

// A wide column (models/wall.hpp).
struct WallTable : MemberKeys {
  Reference id;
  std::vector<Reference> nodes;
  Direction direction;
  double length = 0;                 // [m]
  std::vector<double> thickness;     // [m] one, or one a story; with E, in place of `section`
  std::optional<double> E;           // [Pa]
  std::optional<double> poisson;
  std::vector<Reference> section;    // one, or one a story
  std::vector<Reference> attached;
};

enum class LoadAxes { global, local };

struct LoadTable {
  Location at;
  std::vector<Reference> beams;
  LoadAxes axes = LoadAxes::global;
  std::optional<std::array<double, 3>> uniform;  // [N/m]
  std::optional<std::array<double, 3>> force;    // [N]
  std::optional<double> position;                // of the force
};

struct BarTable {  // truss or cable
  Reference id;
  std::vector<Reference> nodes;
  Reference material;
  double area = 0;        // [m2]
  double pretension = 0;  // [N]
  std::optional<Geometry> geometry;
};

// A strut in compression only (elements/infill.hpp).
struct InfillTable {
  Reference id;
  std::vector<Reference> nodes;
  double thickness = 0;                  // [m]
  double E = 0;                          // [Pa]
  double column_EI = 0;                  // [N m2]
  double height = 0, length = 0;         // [m] clear
  std::optional<double> column_height;   // [m] default: between the nodes
  std::optional<double> fm;              // [Pa] default: elastic
  double residual = 0.2;                 // of fm
  std::optional<double> ultimate_strain; // default: five times that of fm
};

// Six values by direction: stiffnesses, dashpots, laws.
struct StiffnessTable {
  std::array<double, 6> of_dof{};
};
struct DashpotTable {
  std::array<double, 6> of_dof{};
};
struct LawTable {
  std::array<std::optional<Reference>, 6> of_dof{};
};

struct SpringTable {
  Reference id;
  std::vector<Reference> nodes;  // one: to the ground
  StiffnessTable stiffness;
  DashpotTable damping;
  LawTable law;
  std::optional<std::array<std::array<double, 3>, 2>> orient;  // local x, a vector in the local x-y plane
};

struct LinkTable {
  Reference id;
  std::vector<Reference> nodes;
  StiffnessTable stiffness;
  DashpotTable damping;
  LawTable law;
  std::optional<std::array<double, 3>> in_plane;
  std::array<double, 2> shear_distance{0.5, 0.5};
  std::optional<std::array<double, 4>> p_delta;
};

struct TieTable {  // rigid link
  Reference master;
  std::vector<Reference> slaves;
};

struct DiaphragmTable {
  Reference master;
  std::vector<Reference> slaves;
  Direction normal{Vector3::UnitZ()};
};

struct EqualDofTable {
  Reference master;
  std::vector<Reference> slaves;
  DofSet dofs{{true, true, true, true, true, true}};
};

struct SlabTable {
  Reference id;
  std::vector<Reference> corners;
  std::optional<Reference> center;
  std::vector<Reference> nodes;  // further nodes tied by a rigid slab or diaphragm
  SlabKind kind = SlabKind::links;
  double thickness = SlabDescription{}.thickness;  // [m]
  std::optional<bool> rigid_contact;               // default: kind is not links
};

struct InitialTable {
  Reference node;
  Dof dof = Dof::ux;
  double value = 0;  // [m, rad] or [m/s, rad/s]
};
struct InitialDisplacement : InitialTable {
  Dimension dimension() const { return dof < Dof::rx ? dimension::length : dimension::angle; }
};
struct InitialVelocity : InitialTable {
  Dimension dimension() const { return dof < Dof::rx ? dimension::velocity : dimension::angular_velocity; }
};

// A list of ratios in the order of the modes, or ratios by the names of modes.
struct RatioTable {
  std::vector<double> list;
  std::vector<std::pair<Reference, double>> named;
};

struct DampingTable {
  Location at;
  DampingKind kind = DampingKind::none;
  RatioTable ratios;                // modal; rayleigh: of the two frequencies
  std::vector<double> frequencies;  // [Hz] rayleigh, none or two
  double mass_factor = 0;           // [1/s]
  double stiffness_factor = 0;      // [s]
  DampingStiffness stiffness = DampingStiffness::initial;
};

struct ExplicitStructure {
  std::string name;
  Location at;
  BeamKind element = BeamKind::elastic;  // defaults of the beams
  int points = ElementDescription{}.points;
  Integration integration;
  bool inner_iterations = false;
  MemberMass member_mass;
  Geometry geometry = Geometry::linear;
  bool may_move_freely = false;
  std::vector<NodeTable> nodes;
  std::vector<SupportTable> supports;
  std::vector<MassTable> masses;
  std::vector<BeamTable> beams;
  std::vector<WallTable> walls;
  std::vector<BarTable> trusses, cables;
  std::vector<InfillTable> infills;
  std::vector<SpringTable> springs;
  std::vector<LinkTable> links;
  std::vector<LoadTable> loads;
  std::vector<TieTable> rigid_links;
  std::vector<DiaphragmTable> diaphragms;
  std::vector<EqualDofTable> equal_dof;
  std::vector<SlabTable> slabs;
  std::vector<InitialDisplacement> initial_displacement;
  std::vector<InitialVelocity> initial_velocity;
  DampingTable damping;
};

// --- parametric structures
// --------------------------------------------------------------------------------------------

struct StoryFrameTable {
  StoryFrame frame;  // its damping is `damping`
  DampingTable damping;
};

using StructureTable = std::variant<ExplicitStructure, StoryFrameTable>;

inline const std::string& structure_name(const StructureTable& table) {
  const auto* frame = std::get_if<StoryFrameTable>(&table);
  return frame ? frame->frame.name : std::get<ExplicitStructure>(table).name;
}

// --- contact, loads
// ---------------------------------------------------------------------------------------------------

// Of contact pairs: one value, a row, or rows of values.
struct PairValues {
  std::vector<double> values;
};

struct ContactTable {
  Location at;
  std::string name;
  std::optional<ContactKind> kind;  // default: by the names in `between`
  std::vector<Reference> between;
  std::optional<Reference> a, b;  // in place of `between`
  Direction direction;
  PairValues gap;  // [m]
  PairValues restitution;  // filled with the default where the law takes one (describe.hpp)
  double friction = ContactDescription{}.friction;
  ContactLawChoice law;
  std::optional<Vector3> wall;  // a point of it [m]
  double reach = ContactDescription{}.reach;
  double gap_tolerance = ContactDescription{}.gap_tolerance;
  double sliding_error = ContactDescription{}.sliding_error;
};

// --- static stages
// ------------------------------------------------------------------------------------------------------

struct StageLoadTable {
  Reference node;
  Dof dof = Dof::ux;
  double value = 0;  // [N] or [N m]
  Dimension dimension() const { return dof < Dof::rx ? dimension::force : dimension::moment; }
};

struct ControlDofTable {
  Reference node;
  Dof dof = Dof::ux;
};

struct StageTable {
  Location at;
  std::string name;                            // default: "stage 1", by its number
  std::vector<StageLoadTable> loads;
  std::optional<Direction> masses;
  std::optional<Reference> mode;
  Reference control{"load", {}};
  std::optional<ControlDofTable> control_dof;  // key `at`
  std::vector<double> to, by;                  // load factors, [m] or [rad]
  std::vector<std::array<double, 2>> cycles;   // amplitude, count
  std::optional<Reference> file;               // of targets
  std::optional<double> factor;                // of its numbers
  std::optional<double> step;
  std::optional<int> steps;
  std::optional<ArcKind> arc;
  std::optional<int> max_points;
  double tolerance = StageOptions{}.tolerance;
  int max_iterations = StageOptions{}.max_iterations;

  // Of targets and steps.
  Dimension dimension() const {
    if (control.name == "load") return dimension::none;
    return control_dof && control_dof->dof >= Dof::rx ? dimension::angle : dimension::length;
  }
};

struct WaveTable {
  Location at;
  Direction direction;
  double velocity = 0;  // [m/s]
};

enum class MotionQuantity { acceleration, displacement };

struct MotionTable {
  Location at;
  Reference file;
  std::optional<double> dt;        // [s]
  std::optional<AccelerationUnit> unit;  // of the numbers in the file
  std::optional<int> channel;            // from 1, of a file with several
  std::optional<Reference> format;       // found from the file when not given
  MotionQuantity quantity = MotionQuantity::acceleration;  // of the file's numbers
  std::optional<double> pga;       // [m/s2]
  std::optional<double> factor;
  Direction direction;
  double delay = 0;                // [s]
  std::vector<Reference> supports;
  std::optional<WaveTable> wave;

  // Of `factor`.
  Dimension dimension() const { return quantity == MotionQuantity::displacement ? dimension::length : dimension::none; }
};

}  // namespace nsframe
