// The schema of [structure.NAME]: explicit tables and the parametric frame; see schema.hpp.
#pragma once

#include "scene/schema.hpp"

namespace nsframe {

template <class Archive>
void visit(Archive& ar, NodeTable& n) {
  ar(required("id", "unique in the structure"), n.id);
  ar(required("x", "place", dimension::length), n.x);
  ar(required("y", "place", dimension::length), n.y);
  ar(required("z", "place, upwards", dimension::length), n.z);
}
inline constexpr std::string_view node_row[]{"id", "x", "y", "z"};
constexpr RowKeys row_keys(const NodeTable*) { return node_row; }

template <class Archive>
void visit(Archive& ar, SupportTable& s) {
  ar(required("node", "node"), s.node);
  ar(required("fixed", "\"fixed\" (all six DOFs), \"pinned\" (translations), or a list of DOFs"), s.fixed);
}
inline constexpr std::string_view support_row[]{"node", "fixed"};
constexpr RowKeys row_keys(const SupportTable*) { return support_row; }
constexpr bool is_map(const SupportTable*) { return true; }

template <class Archive>
void visit(Archive& ar, MassTable& m) {
  ar(required("node", "node"), m.node);
  ar(required("mass", "one value for all three translations, or one each", dimension::mass, range::non_negative),
     m.mass);
  ar(Field{"inertia", "about x, y and z", dimension::inertia, range::non_negative}, m.inertia);
}
inline constexpr std::string_view mass_row[]{"node", "mass..."};
constexpr RowKeys row_keys(const MassTable*) { return mass_row; }
constexpr bool is_map(const MassTable*) { return true; }

inline constexpr std::string_view geometry_text =
    "small displacements, with the axial force on the chord's shift (P-Delta), or displacements and rotations of any size";

inline constexpr std::string_view inner_iterations_text =
    "true: a force-based beam finds the balance of its sections at every evaluation; false: one pass over them, what is left is carried to the "
    "next evaluation and found at the end of the step";

template <class Archive>
void visit(Archive& ar, Integration& i) {
  ar(Field{"rule", "\"lobatto\", \"legendre\", \"radau\" (Gauss), \"hinge-radau\" (plastic hinges at both ends), \"user\""},
     i.rule);
  ar(Field{"hinge_i", "hinge-radau: plastic hinge length at the first end", dimension::length, range::non_negative},
     i.hinge_i);
  ar(Field{"hinge_j", "the same at the second end", dimension::length, range::non_negative}, i.hinge_j);
  ar(Field{"positions", "user: of the points along the beam, rising", {}, range::unit}, i.positions);
  ar(Field{"weights", "user: parts of the length that the points stand for, sum 1", {}, range::unit}, i.weights);
}
constexpr std::string_view scalar_key(const Integration*) { return "rule"; }

template <class Archive>
void visit(Archive& ar, MemberMass& m) {
  ar(Field{"per_length", "mass per length", dimension::mass_per_length, range::non_negative}, m.per_length);
  ar(Field{"density", "in place of per_length: times the area of `section`", dimension::density, range::non_negative},
     m.density);
  ar(Field{"consistent", "with the beam's shape functions; false: lumped, half at each end"}, m.consistent);
  ar(Field{"rotary_inertia", "also that of the cross-sections about their own axes"}, m.rotary_inertia);
}
constexpr std::string_view scalar_key(const MemberMass*) { return "per_length"; }

template <class Archive>
void visit(Archive& ar, EndReleases& r) {
  ar(Field{"i", "at the first end: of `ux` (axial), `rx` (torsion), `ry`, `rz`, local axes"}, r.i);
  ar(Field{"j", "at the second end"}, r.j);
}

template <class Archive>
void visit_member_keys(Archive& ar, MemberKeys& m) {
  ar(Field{.key = "element", .text = "elastic or fiber beam-column", .default_text = "the structure's"}, m.element);
  ar(Field{.key = "points",
           .text = "integration points of a fiber beam",
           .range = integration_points,
           .default_text = "the structure's"},
     m.points);
  ar(Field{.key = "integration", .text = "of a fiber beam", .default_text = "the structure's"}, m.integration);
  ar(Field{.key = "inner_iterations", .text = inner_iterations_text, .default_text = "the structure's"}, m.inner_iterations);
  ar(Field{.key = "mass", .text = "the beam's own", .default_text = "the structure's member_mass"}, m.mass);
  ar(Field{.key = "geometry", .text = geometry_text, .default_text = "the structure's"}, m.geometry);
}

template <class Archive>
void visit(Archive& ar, BeamTable& b) {
  ar(required("id", "unique among the structure's elements"), b.id);
  ar(required("nodes", "from, to"), b.nodes);
  ar(Field{.key = "section", .text = "section", .default_text = "**required**, or `sections`"}, b.section);
  ar(Field{"sections",
           "of a fiber beam, in place of `section`: at the first integration point, the interior ones, the last; or one a "
           "point"},
     b.sections);
  visit_member_keys(ar, b);
  ar(Field{"releases", "moments, torsion or axial force that an end doesn't carry"}, b.releases);
  ar(Field{.key = "orientation",
           .text = "vector in the local x-z plane",
           .default_text = "local y along global X in vertical members, upwards in others"},
     b.orientation);
  ar(Field{.key = "offset_i",
           .text = "rigid arm from the first node to the member's end, global axes",
           .dimension = dimension::length,
           .default_text = "none"},
     b.offset_i);
  ar(Field{.key = "offset_j",
           .text = "likewise at the second node",
           .dimension = dimension::length,
           .default_text = "none"},
     b.offset_j);
}
inline constexpr std::string_view beam_row[]{"id", "nodes", "nodes", "section"};
constexpr RowKeys row_keys(const BeamTable*) { return beam_row; }

template <class Archive>
void visit(Archive& ar, WallTable& w) {
  ar(required("id", "unique among the structure's elements; the beam-column of story k, from the foot, is `ID-k`"), w.id);
  ar(required("nodes",
              "on the axis, from the foot upwards; the edges at node 11 are the nodes `\"11-\"` and `\"11+\"`, against and along `direction`"),
     w.nodes);
  ar(Field{"direction", "of the length, horizontal"}, w.direction);
  ar(required("length", "from edge to edge", dimension::length, range::positive), w.length);
  ar(Field{.key = "thickness",
           .text = "of an elastic wall of solid rectangles, with shear areas of 5/6; one, or one a story",
           .dimension = dimension::length,
           .range = range::positive,
           .default_text = "**required**, or `section`"},
     w.thickness);
  ar(Field{.key = "E", .text = "its elastic modulus", .dimension = dimension::stress, .range = range::positive,
           .default_text = "**required**, or `section`"},
     w.E);
  ar(Field{.key = "poisson",
           .text = "its Poisson's ratio, for G = E/(2(1 + poisson))",
           .range = {-1, 0.5, true, false},
           .default_text = "0.2"},
     w.poisson);
  ar(Field{.key = "section",
           .text = "of the whole wall, its depth (local y) along `direction`, in place of thickness and E; one, or one a story. Fibers "
                   "alone are rigid in shear: give shear_y_law, in a force-based wall",
           .default_text = "a rectangle"},
     w.section);
  ar(Field{"attached", "further nodes, within the wall at levels of its nodes, that follow the axis by rigid arms as the edges do"},
     w.attached);
  visit_member_keys(ar, w);
}

template <class Archive>
void visit(Archive& ar, LoadTable& l) {
  ar(required("beams", "ids"), l.beams);
  ar(Field{"axes", "of the components"}, l.axes);
  ar(Field{"uniform", "along x, y, z, per length of the beam", dimension::stiffness}, l.uniform);
  ar(Field{"force", "along x, y, z, at `position`", dimension::force}, l.force);
  ar(Field{.key = "position", .text = "of the force, as a part of the beam's length", .range = range::unit, .default_text = "0.5"},
     l.position);
}
inline constexpr std::string_view load_row[]{"beams", "uniform"};
constexpr RowKeys row_keys(const LoadTable*) { return load_row; }

template <class Archive>
void visit(Archive& ar, BarTable& b) {
  ar(required("id", "unique among the structure's elements"), b.id);
  ar(required("nodes", "from, to"), b.nodes);
  ar(required("material", "material"), b.material);
  ar(required("area", "cross-section", dimension::area, range::positive), b.area);
  ar(Field{"pretension", "axial force at rest, positive in tension", dimension::force}, b.pretension);
  ar(Field{.key = "geometry", .text = geometry_text, .default_text = "the structure's"}, b.geometry);
}
inline constexpr std::string_view bar_row[]{"id", "nodes", "nodes", "material", "area", "pretension"};
constexpr RowKeys row_keys(const BarTable*) { return bar_row; }

template <class Archive>
void visit(Archive& ar, InfillTable& i) {
  ar(required("id", "unique among the structure's elements"), i.id);
  ar(required("nodes", "opposite corners of the panel"), i.nodes);
  ar(required("thickness", "of the infill", dimension::length, range::positive), i.thickness);
  ar(required("E", "modulus of the infill", dimension::stress, range::positive), i.E);
  ar(required("column_EI", "bending stiffness of one column in the panel's plane", dimension::bending_stiffness, range::positive),
     i.column_EI);
  ar(required("height", "clear height of the infill", dimension::length, range::positive), i.height);
  ar(required("length", "clear length of the infill", dimension::length, range::positive), i.length);
  ar(Field{.key = "column_height",
           .text = "between the centrelines of the beams",
           .dimension = dimension::length,
           .range = range::positive,
           .default_text = "the vertical distance of the nodes"},
     i.column_height);
  ar(Field{.key = "fm",
           .text = "strength; the strut then follows Concrete01, reaching it at the strain 2 fm/E",
           .dimension = dimension::stress,
           .range = range::positive,
           .default_text = "elastic in compression (ENT)"},
     i.fm);
  ar(Field{"residual", "stress after crushing, as a part of fm", {}, range::unit}, i.residual);
  ar(Field{.key = "ultimate_strain",
           .text = "at which the residual stress is reached",
           .range = range::positive,
           .default_text = "10 fm/E"},
     i.ultimate_strain);
}

template <class Archive, class Table>
void visit_dofs(Archive& ar, Table& table, std::string_view text, Dimension translation, Dimension rotation) {
  for (std::size_t i = 0; i < 6; ++i)
    ar(Field{node_dof_names[i], text, i < 3 ? translation : rotation, range::non_negative}, table.of_dof[i]);
}
template <class Archive>
void visit(Archive& ar, StiffnessTable& s) {
  visit_dofs(ar, s, "stiffness", dimension::stiffness, dimension::rotational_stiffness);
}
template <class Archive>
void visit(Archive& ar, DashpotTable& s) {
  visit_dofs(ar, s, "dashpot constant", dimension::dashpot, dimension::rotational_dashpot);
}
template <class Archive>
void visit(Archive& ar, LawTable& s) {
  for (std::size_t i = 0; i < 6; ++i) ar(Field{node_dof_names[i], "material, force against displacement"}, s.of_dof[i]);
}
constexpr RowKeys row_keys(const StiffnessTable*) { return node_dof_names; }
constexpr RowKeys row_keys(const DashpotTable*) { return node_dof_names; }

template <class Archive>
void visit(Archive& ar, SpringTable& s) {
  ar(required("id", "unique among the structure's elements"), s.id);
  ar(required("nodes", "one, or two at one place; laws see how it moves against the ground, or the second against the first"), s.nodes);
  ar(Field{"stiffness", "by direction"}, s.stiffness);
  ar(Field{"damping", "dashpots by direction"}, s.damping);
  ar(Field{"law", "material laws by direction, in place of stiffness"}, s.law);
  ar(Field{.key = "orient",
           .text = "local axes that the directions mean: x, and a vector in the x-y plane",
           .default_text = "the global axes"},
     s.orient);
}

template <class Archive>
void visit(Archive& ar, LinkTable& l) {
  ar(required("id", "unique among the structure's elements"), l.id);
  ar(required("nodes", "from, to; local x runs along them"), l.nodes);
  ar(Field{"stiffness", "by direction, local axes"}, l.stiffness);
  ar(Field{"damping", "dashpots by direction"}, l.damping);
  ar(Field{"law", "material laws by direction, in place of stiffness"}, l.law);
  ar(Field{.key = "in_plane", .text = "vector in the local x-y plane", .default_text = "local axes as a beam's"}, l.in_plane);
  ar(Field{"shear_distance", "place of the springs along local y and z, as parts of the length from the first node", {},
           range::unit},
     l.shear_distance);
  ar(Field{.key = "p_delta",
           .text = "parts of the moments N delta at the first and second end about local y, then about z; shear forces balance the rest",
           .range = range::unit,
           .default_text = "no P-Delta"},
     l.p_delta);
}

template <class Archive>
void visit(Archive& ar, TieTable& t) {
  ar(required("master", "node that leads"), t.master);
  ar(required("slaves", "nodes that follow"), t.slaves);
}
inline constexpr std::string_view tie_row[]{"master", "slaves..."};
constexpr RowKeys row_keys(const TieTable*) { return tie_row; }

template <class Archive>
void visit(Archive& ar, DiaphragmTable& t) {
  ar(required("master", "node that leads"), t.master);
  ar(required("slaves", "nodes that follow"), t.slaves);
  ar(Field{"normal", "of its plane"}, t.normal);
}
constexpr RowKeys row_keys(const DiaphragmTable*) { return tie_row; }

template <class Archive>
void visit(Archive& ar, EqualDofTable& t) {
  ar(required("master", "node that leads"), t.master);
  ar(required("slaves", "nodes that follow"), t.slaves);
  ar(Field{"dofs", "which"}, t.dofs);
}
inline constexpr std::string_view equal_dof_row[]{"master", "slaves", "dofs"};
constexpr RowKeys row_keys(const EqualDofTable*) { return equal_dof_row; }

template <class Archive>
void visit(Archive& ar, SlabTable& s) {
  ar(required("id", "unique among the structure's slabs"), s.id);
  ar(required("corners", "nodes in order around the slab"), s.corners);
  ar(Field{"center", "node; the master of a rigid slab or diaphragm"}, s.center);
  ar(Field{"nodes", "further nodes tied by a rigid slab or diaphragm"}, s.nodes);
  ar(Field{"kind", "links: carried by elements given elsewhere; rigid: one rigid body; diaphragm: rigid in its plane"},
     s.kind);
  ar(Field{"thickness", "for drawing; slabs of two structures meet where they overlap over it", dimension::length, range::positive}, s.thickness);
  ar(Field{.key = "rigid_contact",
           .text = "impacts act on the whole slab, not on the corner's share",
           .default_text = "unless kind is links"},
     s.rigid_contact);
}

template <class Archive, class Initial>
void visit_initial(Archive& ar, Initial& v) {
  ar(required("node", "node"), v.node);
  ar(required("dof", "direction"), v.dof);
  ar(required("value", "relative to the base, in m or rad (m/s or rad/s)", v.dimension()), v.value);
}
template <class Archive>
void visit(Archive& ar, InitialDisplacement& v) {
  visit_initial(ar, v);
}
template <class Archive>
void visit(Archive& ar, InitialVelocity& v) {
  visit_initial(ar, v);
}
inline constexpr std::string_view initial_row[]{"node", "dof", "value"};
constexpr RowKeys row_keys(const InitialDisplacement*) { return initial_row; }
constexpr RowKeys row_keys(const InitialVelocity*) { return initial_row; }

template <class Archive>
void visit(Archive& ar, DampingTable& d) {
  ar(Field{"kind", "modal: eq. (22), by structure; rayleigh: mass_factor M + stiffness_factor K"}, d.kind);
  ar(Field{"ratios",
           "modal: of the first modes in order, or by name (L1 along x, T1 along y, R1 about z, V1 along z); "
           "rayleigh: at the two frequencies",
           {},
           range::non_negative},
     d.ratios);
  ar(Field{"frequencies", "rayleigh: two, in place of the factors", dimension::frequency, range::positive},
     d.frequencies);
  ar(Field{"mass_factor", "rayleigh", dimension::frequency, range::non_negative}, d.mass_factor);
  ar(Field{"stiffness_factor", "rayleigh", dimension::time, range::non_negative}, d.stiffness_factor);
  ar(Field{"stiffness", "rayleigh: K at the first rest, at the end of the last step, or of the present iteration"}, d.stiffness);
}

template <class Archive>
void visit(Archive& ar, ExplicitStructure& s) {
  ar(Field{"element", "kind of the beams that don't say"}, s.element);
  ar(Field{"points", "of the beams that don't say", {}, integration_points}, s.points);
  ar(Field{"integration", "of the fiber beams that don't say"}, s.integration);
  ar(Field{"inner_iterations", "of the force-based beams that don't say"}, s.inner_iterations);
  ar(Field{"member_mass", "of the beams that don't say"}, s.member_mass);
  ar(Field{"geometry", "of the elements that don't say"}, s.geometry);
  ar(Field{"may_move_freely", "a motion without stiffness is intended (a ball, a rolling mass)"}, s.may_move_freely);
  ar(required("nodes", "nodes"), s.nodes);
  ar(Field{"supports", "fixed DOFs"}, s.supports);
  ar(Field{"masses", "lumped masses"}, s.masses);
  ar(Field{"beams", "beam-columns"}, s.beams);
  ar(Field{"walls", "walls as wide columns: beam-columns along the axis, rigid arms to the edges, where beams start"}, s.walls);
  ar(Field{"trusses", "bars in tension and compression"}, s.trusses);
  ar(Field{"cables", "bars in tension only"}, s.cables);
  ar(Field{"infills", "masonry panels as struts in compression only, of the width of FEMA 356 (7-14)"}, s.infills);
  ar(Field{"springs", "springs and dashpots of no length"}, s.springs);
  ar(Field{"links", "springs and dashpots between nodes apart"}, s.links);
  ar(Field{"loads", "static loads on beams"}, s.loads);
  ar(Field{"rigid_links", "all six DOFs follow as of one rigid body"}, s.rigid_links);
  ar(Field{"diaphragms", "displacements in the plane and the rotation about its normal follow (ux, uy and rz)"}, s.diaphragms);
  ar(Field{"equal_dof", "listed DOFs follow"}, s.equal_dof);
  ar(Field{"slabs", "for contact and drawing; ties its nodes when rigid or a diaphragm"}, s.slabs);
  ar(Field{"initial_displacement", "at t = 0"}, s.initial_displacement);
  ar(Field{"initial_velocity", "at t = 0"}, s.initial_velocity);
  ar(Field{"damping", "damping"}, s.damping);
}

template <class Archive>
void visit_members(Archive& ar, FrameMembers& m) {
  ar(required("section", "one, or one a story from the lowest"), m.section);
  ar(Field{"end_section", "of fiber members: at their first and last integration point; one, or one a story"},
     m.end_section);
  ar(Field{"element", "kind"}, m.element);
  ar(Field{"points", "integration points of a fiber beam", {}, integration_points}, m.points);
  ar(Field{"integration", "of fiber beams"}, m.integration);
  ar(Field{"inner_iterations", inner_iterations_text}, m.inner_iterations);
  ar(Field{"mass", "the members' own"}, m.mass);
  ar(Field{"geometry", geometry_text}, m.geometry);
  ar(Field{"releases", "moments, torsion or axial force that an end doesn't carry"}, m.releases);
  ar(Field{"rigid_ends", "lengths of rigid zones along the member, at its first node (feet of columns) and its second",
           dimension::length, range::non_negative},
     m.rigid_ends);
}
template <class Archive>
void visit(Archive& ar, FrameBeams& m) {
  visit_members(ar, m);
  ar(Field{"load", "downwards, per length; one, or one a story", dimension::stiffness}, m.load);
}
template <class Archive>
void visit(Archive& ar, FrameColumns& m) {
  visit_members(ar, m);
  ar(Field{"depth", "direction of the sections' depth (their local y)"}, m.depth);
  ar(Field{.key = "split",
           .text = "levels above the base that have a node in every column, as those of a neighbour's floors; ids: of the node below, and "
                   "a, b, ...",
           .dimension = dimension::length,
           .range = range::positive,
           .default_text = "none"},
     m.split);
}

template <class Archive>
void visit(Archive& ar, FrameSlab& s) {
  ar(Field{"kind",
           "links: elastic members from the centre to the columns; rigid: one body; diaphragm: rigid in its plane"},
     s.kind);
  ar(Field{"section", "of the links"}, s.section);
  ar(Field{"thickness", "for drawing; slabs of two structures meet where they overlap over it", dimension::length, range::positive}, s.thickness);
}

template <class Archive>
void visit(Archive& ar, FrameBraces& b) {
  ar(required("planes", "outer planes with crossed braces: \"-x\" is the one of lowest x"), b.planes);
  ar(Field{"kind", "truss or cable"}, b.kind);
  ar(required("material", "material"), b.material);
  ar(required("area", "of one brace; one, or one a story", dimension::area, range::positive), b.area);
  ar(Field{"pretension", "axial force at rest", dimension::force}, b.pretension);
}

template <class Archive>
void visit(Archive& ar, FrameBase& b) {
  ar(required("kind", "spring: rotations about x and y held by springs, all else fixed"), b.kind);
  ar(Field{"stiffness", "of the springs", dimension::rotational_stiffness, range::non_negative}, b.stiffness);
}
constexpr std::string_view scalar_key(const FrameBase*) { return "kind"; }

inline constexpr Range building_length{0, 1e5, true, false};  // [m]; sums of many stay finite

template <class Archive>
void visit(Archive& ar, StoryFrameTable& t) {
  StoryFrame& f = t.frame;
  ar(Field{"stories", "number of stories", {}, {1, 1000}}, f.stories);
  ar(Field{"height", "of a story; one, or one a story", dimension::length, building_length}, f.height);
  ar(required("plan", "lengths along x and y; a list of spans in place of a length", dimension::length,
              building_length),
     f.plan);
  ar(Field{"bays", "equal bays along x and y", {}, {1, 1000}}, f.bays);
  ar(Field{"origin", "the plan's corner of lowest x and y, at the base", dimension::length}, f.origin);
  ar(Field{"columns", "at every crossing of the grid"}, f.columns);
  ar(Field{"beams", "along every line of the grid"}, f.beams);
  ar(Field{"slab", "how a floor is tied to its centre"}, f.slab);
  ar(Field{"braces", "crossed braces in outer planes"}, f.braces);
  ar(Field{"base", "feet of the columns"}, f.base);
  ar(Field{"floor_mass", "one, or one a story", dimension::mass, range::non_negative}, f.mass.floor);
  ar(Field{"centre_share",
           "of the horizontal mass at the slab's centre; the outer corners share the rest",
           {},
           range::unit},
     f.mass.centre_share);
  ar(Field{"centre_inertia", "extra inertia about z at the centre; one, or one a story", dimension::inertia,
           range::non_negative},
     f.mass.centre_inertia);
  ar(Field{"damping", "damping"}, t.damping);
}

}  // namespace nsframe
