// The schema of scene files: one visit(archive, struct) for each table lists its keys with text, dimension, range and
// default (that of the struct). Reading, writing and docs/scene-reference.md all follow from it.
//
// A table in a list may be written as a row; row_keys() says which keys its values stand for, in order (a last key
// ending in "..." takes all that remain). is_map() tables may also be keyed by their first row key.
#pragma once

#include <span>
#include <utility>

#include "materials/parameter.hpp"
#include "models/analysis.hpp"
#include "scene/field.hpp"
#include "scene/schema_names.hpp"
#include "scene/tables.hpp"

namespace nsframe {

using RowKeys = std::span<const std::string_view>;

template <class Table>
constexpr RowKeys row_keys(const Table*) {
  return {};
}
template <class Table>
constexpr bool is_map(const Table*) {
  return false;
}

// The key that a bare value in place of the table stands for; empty: none.
template <class Table>
constexpr std::string_view scalar_key(const Table*) {
  return {};
}

inline constexpr Range integration_points{2, max_points, false, false};
inline constexpr Range count{1, 1000};

// --- materials
// --------------------------------------------------------------------------------------------------------

// In a scene "stress" and "strain" of a spring's law are plain numbers: its force and displacement, or moment and angle.
constexpr Dimension dimension_of(Measure measure) {
  return measure == Measure::stress ? dimension::stress : dimension::none;
}

// The laws list their parameters themselves (materials/parameter.hpp).
template <class Archive, HasParameters Law>
void visit(Archive& ar, Law& law) {
  Law::visit_parameters(
      [&ar](const Parameter& p, auto& value) {
        ar(Field{p.name, p.text, dimension_of(p.measure), p.range, p.presence, p.default_text}, value);
      },
      law);
}

// --- sections
// ---------------------------------------------------------------------------------------------------------

template <class Archive>
void visit(Archive& ar, ShapeSection& s) {
  ar(required("shape", "rolled shape: HEA, HEB or IPE and its number, as `HEA100`"), s.shape);
  ar(required("material", "of the fibers"), s.material);
  ar(Field{"flange_width", "fibers across a flange's width", {}, count}, s.flange_width);
  ar(Field{"flange_layers", "fibers through a flange's thickness", {}, count}, s.flange_layers);
  ar(Field{"web", "fibers along the web", {}, count}, s.web);
  ar(Field{"fillets", "root fillets, one fiber each"}, s.fillets);
  ar(Field{"poisson", "Poisson's ratio, for G = E/(2(1 + poisson))", {}, {-1, 0.5, true, false}}, s.poisson);
  ar(Field{"G", "shear modulus, in place of Poisson's ratio", dimension::stress, range::positive}, s.G);
  ar(Field{.key = "J",
           .text = "torsion constant",
           .dimension = dimension::fourth_power_of_length,
           .range = range::positive,
           .default_text = "of the catalogue"},
     s.J);
}

template <class Archive>
void visit(Archive& ar, ConstantsSection& s) {
  constexpr Dimension m4 = dimension::fourth_power_of_length;
  ar(required("E", "elastic modulus", dimension::stress, range::positive), s.constants.E);
  ar(Field{.key = "G", .text = "shear modulus", .dimension = dimension::stress, .range = range::non_negative}, s.G);
  ar(Field{"poisson", "Poisson's ratio, in place of G = E/(2(1 + poisson))", {}, {-1, 0.5, true, false}}, s.poisson);
  ar(required("A", "area", dimension::area, range::positive), s.constants.A);
  ar(required("Iz", "second moment for bending in the local x-y plane", m4, range::positive), s.constants.Iz);
  ar(required("Iy", "second moment for bending in the local x-z plane", m4, range::positive), s.constants.Iy);
  ar(required("J", "torsion constant", m4, range::non_negative), s.constants.J);
  ar(Field{"Ay", "shear area for forces along local y, Timoshenko's beam; 0: no shear deformation", dimension::area,
           range::non_negative},
     s.constants.Ay);
  ar(Field{"Az", "the same along local z", dimension::area, range::non_negative}, s.constants.Az);
  ar(Field{"depth", "along local y, of the rectangle drawn; 0: none drawn", dimension::length, range::non_negative},
     s.depth);
  ar(Field{"width", "along local z, of the rectangle drawn", dimension::length, range::non_negative}, s.width);
}

template <class Archive>
void visit(Archive& ar, PatchTable& p) {
  ar(required("material", "of the fibers"), p.material);
  ar(required("y", "from and to along local y", dimension::length), p.y);
  ar(required("z", "from and to along local z", dimension::length), p.z);
  ar(Field{"ny", "fibers along y", {}, count}, p.ny);
  ar(Field{"nz", "fibers along z", {}, count}, p.nz);
}

template <class Archive>
void visit(Archive& ar, FiberTable& f) {
  ar(required("y", "place along local y", dimension::length), f.y);
  ar(required("z", "place along local z", dimension::length), f.z);
  ar(required("area", "area", dimension::area, range::positive), f.area);
  ar(required("material", "of the fiber"), f.material);
}
inline constexpr std::string_view fiber_row[]{"y", "z", "area", "material"};
constexpr RowKeys row_keys(const FiberTable*) { return fiber_row; }

template <class Archive>
void visit(Archive& ar, PatchSection& s) {
  ar(Field{"patches", "rectangles cut into fibers"}, s.patches);
  ar(Field{"fibers", "single fibers"}, s.fibers);
  ar(Field{"GJ", "torsional stiffness", dimension::bending_stiffness, range::non_negative}, s.GJ);
  ar(Field{"G", "shear modulus, with J in place of GJ", dimension::stress, range::non_negative}, s.G);
  ar(Field{"J", "torsion constant", dimension::fourth_power_of_length, range::non_negative}, s.J);
}

// --- contact, loads
// ---------------------------------------------------------------------------------------------------

template <class Archive>
void visit(Archive& ar, ContactTable& c) {
  ar(Field{"name", "prefix of the pairs' names"}, c.name);
  ar(Field{.key = "kind",
           .text = "slab-corners: facing corners of two structures, floor by floor; nodes: one node "
                   "against another or the ground",
           .default_text = "by the names in `between`"},
     c.kind);
  ar(Field{"between", "two structures, or two nodes `structure.node`, or a node and \"ground\""}, c.between);
  ar(Field{"a", "one node, with `b` in place of `between`"}, c.a);
  ar(Field{"b", "the other node, or \"ground\""}, c.b);
  ar(Field{"direction", "from the first to the second"}, c.direction);
  ar(Field{.key = "gap",
           .text = "one value; or one a corner by rising y (or x); or rows of these, one a floor from the lowest",
           .dimension = dimension::length,
           .default_text = "from the coordinates"},
     c.gap);
  ar(Field{"restitution", "Newton's e", {}, range::unit}, c.restitution);
}

template <class Archive>
void visit(Archive& ar, GravityTable& g) {
  ar(Field{"acceleration", "gravity", dimension::acceleration, range::non_negative}, g.acceleration);
  ar(Field{"direction", "in which it pulls"}, g.direction);
  ar(Field{"statically_first",
           "find the rest under gravity and the loads on beams before t = 0; false: they act suddenly at t = 0"},
     g.statically_first);
}

template <class Archive>
void visit(Archive& ar, MotionTable& m) {
  ar(required("file",
              "PEER AT2, or text with one column (give `dt`) or two (time, acceleration); relative to the scene"),
     m.file);
  ar(Field{"dt", "step of a one-column file", dimension::time, range::positive}, m.dt);
  ar(Field{.key = "unit", .text = "of the numbers in the file", .default_text = "AT2: \"g\"; text must say"}, m.unit);
  ar(Field{.key = "pga",
           .text = "peak to scale the record to",
           .dimension = dimension::acceleration,
           .range = range::positive,
           .default_text = "as recorded"},
     m.pga);
  ar(Field{.key = "factor", .text = "in place of `pga`: times this", .default_text = "1"}, m.factor);
  ar(Field{"direction", "of the base acceleration"}, m.direction);
}

// --- analysis, output
// -------------------------------------------------------------------------------------------------

template <class Archive>
void visit(Archive& ar, AnalysisOptions& a) {
  ar(Field{"scheme", "time integration"}, a.scheme);
  ar(Field{"dt", "time step", dimension::time, range::positive}, a.dt);
  ar(Field{"duration", "model time; 0: length of the longest motion", dimension::time, range::non_negative},
     a.duration);
  ar(Field{"theta", "of the theta-method; the paper uses 1", {}, {0.5, 1}}, a.theta);
  ar(Field{"gamma", "a pair is active where g + gamma dt g' < 0; the paper uses 1.5", {}, range::non_negative},
     a.gamma);
  ar(Field{"newton_tolerance", "residual relative to the largest force of the step", {}, range::positive},
     a.newton_tolerance);
  ar(Field{"max_newton", "iterations of a step", {}, {1, 1e6}}, a.max_newton);
  ar(Field{"max_halvings", "of a step whose iterations fail", {}, {0, 60}}, a.max_halvings);
  ar(Field{"contact_solver", "of the contact problem"}, a.contact_solver);
  ar(Field{"contact_tolerance", "complementarity error relative to the approach velocity", {}, range::positive},
     a.contact_tolerance);
  ar(Field{"max_contact_sweeps", "gauss-seidel only", {}, {1, 1e9}}, a.max_contact_sweeps);
  ar(Field{"threads", "of one run", {}, {1, 1024}}, a.threads);
}

template <class Archive>
void visit(Archive& ar, OutputOptions& o) {
  ar(Field{"frames", "rate of ParaView frames; 0: none", dimension::frequency, range::non_negative}, o.frames);
  ar(Field{"history_rate", "rate of histories; 0: every step", dimension::frequency, range::non_negative},
     o.history_rate);
  ar(Field{"history", "what to keep: `nodes`, `contacts`, `elements`, `sections`, `energy`, `ground`"}, o.history);
  ar(Field{"nodes", "`structure.node` to keep; empty: all"}, o.nodes);
  ar(Field{"amplification", "of the displacements stored in the frames", {}, range::non_negative}, o.amplification);
  ar(Field{"checkpoint", "wall-clock time between checkpoints for `--resume`; 0: only when the run ends",
           dimension::time, range::non_negative},
     o.checkpoint);
}

}  // namespace nsframe
