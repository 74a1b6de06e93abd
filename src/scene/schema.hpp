// The schema of scene files: one visit(archive, struct) for each table lists its keys with text, dimension, range and
// default (that of the struct). Reading, writing and docs/scene-reference.md all follow from it.
//
// A table in a list may be written as a row; row_keys() says which keys its values stand for, in order (a last key
// ending in "..." takes all that remain). is_map() tables may also be keyed by their first row key.
#pragma once

#include <utility>

#include "materials/parameter.hpp"
#include "models/analysis.hpp"
#include "scene/field.hpp"
#include "scene/schema_names.hpp"
#include "scene/tables.hpp"

namespace nsframe {

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

// --- loads
// ---------------------------------------------------------------------------------------------------

template <class Archive>
void visit(Archive& ar, GravityTable& g) {
  ar(Field{"acceleration", "gravity", dimension::acceleration, range::non_negative}, g.acceleration);
  ar(Field{"direction", "in which it pulls"}, g.direction);
  ar(Field{"statically_first",
           "find the rest under gravity and the loads on beams before t = 0; false: they act suddenly at t = 0"},
     g.statically_first);
}

template <class Archive>
void visit(Archive& ar, WaveTable& w) {
  ar(Field{"direction", "in which it runs"}, w.direction);
  ar(required("velocity", "apparent, along its direction", dimension::velocity, range::positive), w.velocity);
}

template <class Archive>
void visit(Archive& ar, MotionTable& m) {
  ar(required("file",
              "record: PEER AT2, COSMOS, CSMIP V2, ESM, K-NET, or text and CSV with one column or two (time, acceleration); relative to the scene"),
     m.file);
  ar(Field{.key = "dt",
           .text = "step of a one-column file",
           .dimension = dimension::time,
           .range = range::positive,
           .default_text = "as the file says"},
     m.dt);
  ar(Field{.key = "unit", .text = "of the numbers in the file", .default_text = "as the file says"}, m.unit);
  ar(Field{.key = "channel",
           .text = "of a COSMOS or CSMIP file with several channels of acceleration, in their order",
           .range = range::at_least_one,
           .default_text = "the only one"},
     m.channel);
  ar(Field{.key = "format", .text = "`at2`, `k-net`, `esm`, `cosmos`, `csmip` or `text`", .default_text = "found from the file"}, m.format);
  ar(Field{"quantity",
           "of the numbers in the file: `acceleration`, or `displacement`, from zero and from rest, through whose values a cubic spline goes"},
     m.quantity);
  ar(Field{.key = "pga",
           .text = "peak to scale the record to",
           .dimension = dimension::acceleration,
           .range = range::positive,
           .default_text = "as recorded"},
     m.pga);
  ar(Field{.key = "factor",
           .text = "in place of `pga`: times this; of displacements a length, e.g. \"1 cm\"",
           .dimension = m.dimension(),
           .default_text = "1"},
     m.factor);
  ar(Field{"direction", "of the motion"}, m.direction);
  ar(Field{"delay", "of the whole record", dimension::time, range::non_negative}, m.delay);
  ar(Field{.key = "supports",
           .text = "`structure.node` of the supports that move so relative to the base, in place of the whole base",
           .default_text = "the base; with a wave, all supports"},
     m.supports);
  ar(Field{"wave", "supports move one after the other, as a wave reaches them; the first one after `delay`"}, m.wave);
}

template <class Archive>
void visit(Archive& ar, StageLoadTable& l) {
  ar(required("node", "`structure.node`"), l.node);
  ar(required("dof", "ux, uy, uz, rx, ry or rz"), l.dof);
  ar(required("value", "force, or moment, of load factor 1", l.dimension()), l.value);
}
inline constexpr std::string_view stage_load_row[]{"node", "dof", "value"};
constexpr RowKeys row_keys(const StageLoadTable*) { return stage_load_row; }

template <class Archive>
void visit(Archive& ar, ControlDofTable& c) {
  ar(required("node", "`structure.node`"), c.node);
  ar(required("dof", "ux, uy, uz, rx, ry or rz"), c.dof);
}
inline constexpr std::string_view control_dof_row[]{"node", "dof"};
constexpr RowKeys row_keys(const ControlDofTable*) { return control_dof_row; }

template <class Archive>
void visit(Archive& ar, StageTable& s) {
  ar(Field{.key = "name", .text = "of its results", .default_text = "\"stage 1\", by its number"}, s.name);
  ar(Field{"loads", "forces and moments of load factor 1"}, s.loads);
  ar(Field{"masses", "a direction: every mass pulled along it by 1 m/s2 at load factor 1"}, s.masses);
  ar(Field{"mode", "`structure.L1`: masses times this mode's shape, forces of 1 N in all at load factor 1"}, s.mode);
  ar(Field{"control", "what is led on: `load`, `displacement`, `arc-length`"}, s.control);
  ar(Field{"at", "control DOF: needed but by `load`, where it is only reported"}, s.control_dof);
  ar(Field{.key = "to",
           .text = "one target or several in turn: load factors, or displacements [m, rad] of the control DOF",
           .dimension = s.dimension(),
           .default_text = "load: 1"},
     s.to);
  ar(Field{"by", "the same, counted from the start of the stage; not by load", s.dimension()}, s.by);
  ar(Field{"cycles", "rows [amplitude, count]: to +amplitude and -amplitude, count times each", s.dimension()}, s.cycles);
  ar(Field{"file", "text file of targets, one a line; relative to the scene"}, s.file);
  ar(Field{.key = "factor", .text = "of the file's numbers, e.g. \"1 mm\"", .dimension = s.dimension(), .default_text = "1"},
     s.factor);
  ar(Field{.key = "step",
           .text = "largest increment; of an arc: what the first one moves the control DOF",
           .dimension = s.dimension(),
           .range = range::positive,
           .default_text = "by `steps`"},
     s.step);
  ar(Field{.key = "steps", .text = "increments to each target, in place of `step`", .range = {1, 1e6}, .default_text = "20"}, s.steps);
  ar(Field{.key = "arc",
           .text = "arc-length: of displacements and load factor, or of displacements alone",
           .default_text = "spherical"},
     s.arc);
  ar(Field{.key = "max_points", .text = "arc-length: after which the target counts as out of reach", .range = {1, 1e7}, .default_text = "2000"},
     s.max_points);
  ar(Field{"tolerance", "residual relative to the largest force", {}, range::positive}, s.tolerance);
  ar(Field{"max_iterations", "of Newton's method at a point", {}, {1, 1e6}}, s.max_iterations);
}

// --- analysis, output
// -------------------------------------------------------------------------------------------------

template <class Archive>
void visit(Archive& ar, AnalysisOptions& a) {
  ar(Field{"scheme",
           "time integration: `moreau-jean`; `exact` for linear scenes, where `dt` only says when results are kept; `exponential` for scenes "
           "that yield; `event-split`: `integrator` between impacts located within the step; `auto`: `exact` or `exponential` where they "
           "can be, else `moreau-jean`, which options of its own (`theta`, `gamma`, "
           "`newton_tolerance`, `max_newton`, `max_halvings`, `contact_solver`, `projection`) also choose when no scheme is given"},
     a.scheme);
  ar(Field{"dt", "time step", dimension::time, range::positive}, a.dt);
  ar(Field{"accuracy",
           "of scheme `exponential`: it evaluates the elements as often as it takes for displacements to be off by about this part of their "
           "peak, several times in a step or once for many (`dt` then only says when results are kept); 0: once a step",
           {}, {0, 0.1}},
     a.accuracy);
  ar(Field{"highest_frequency",
           "of schemes `exact` and `exponential`: modes above it are left out of motion and contact, they only follow static loads and what yields, at once; "
           "0: all modes move",
           dimension::frequency, range::non_negative},
     a.highest_frequency);
  ar(Field{"duration", "model time; 0: length of the longest motion", dimension::time, range::non_negative},
     a.duration);
  ar(Field{"theta", "of the theta-method; the paper uses 1; scheme `event-split` takes 0.5 when none is given", {}, {0.5, 1}}, a.theta);
  ar(Field{"integrator",
           "of scheme `event-split`: `theta`, the theta-method; `generalized-alpha` (Chung and Hulbert); `alpha-os`, operator splitting: one "
           "evaluation of the elements a step and a constant matrix"},
     a.integrator);
  ar(Field{"rho_infinity",
           "of `generalized-alpha`, and in [0.5, 1] of `alpha-os`: what a step leaves of waves far above those that it resolves; 1: all, no numerical damping",
           {}, {0, 1}},
     a.rho_infinity);
  ar(Field{"gamma", "a pair is active where g + gamma dt g' < 0; the paper uses 1.5", {}, range::non_negative},
     a.gamma);
  ar(Field{"newton_tolerance", "residual relative to the largest force of the step", {}, range::positive},
     a.newton_tolerance);
  ar(Field{"screening",
           "a section is not evaluated fiber by fiber while virgin fibers leave their elastic line by less, relative to the "
           "stress; 0: by rounding only",
           {}, {0, 1e-4}},
     a.screening);
  ar(Field{"max_newton", "iterations of a step", {}, {1, 1e6}}, a.max_newton);
  ar(Field{"algorithm",
           "tried in turn where one fails: `newton`, `modified`, `initial`, `line-search`, `krylov`, `broyden`, "
           "`bfgs`; `auto`: newton, line-search, krylov, initial"},
     a.algorithm);
  ar(Field{"max_halvings", "of a step whose iterations fail", {}, {0, 60}}, a.max_halvings);
  ar(Field{"impact_law",
           "how restitution acts where several pairs collide at once: `newton` by gap rates, which may create energy where e differs; "
           "`poisson` by impulses, which never does. The same for one pair alone"},
     a.impact_law);
  ar(Field{"contact_solver", "of the contact problem"}, a.contact_solver);
  ar(Field{"projection", "moreau-jean: move penetrations of pairs with impulses back to gap 0 after each step, velocities as they are"},
     a.projection);
  ar(Field{"contact_tolerance", "complementarity error relative to the approach velocity", {}, range::positive},
     a.contact_tolerance);
  ar(Field{"max_contact_sweeps", "gauss-seidel only", {}, {1, 1e9}}, a.max_contact_sweeps);
  ar(Field{"threads", "of one run", {}, {1, 1024}}, a.threads);
}

template <class Archive>
void visit(Archive& ar, FloorSpectraOptions& s) {
  ar(Field{"nodes",
           "`structure.node` where oscillators stand, or `floors`: centres of the slabs (corners of slabs without; nodes "
           "with horizontal mass of structures without slabs)"},
     s.nodes);
  ar(Field{.key = "periods",
           .text = "of the oscillators",
           .dimension = dimension::time,
           .range = range::positive,
           .default_text = "60 from 0.02 to 4 s, evenly spaced in logarithm"},
     s.periods);
  ar(Field{"damping", "ratio of the oscillators", {}, {0, 1, false, true}}, s.damping);
}
inline constexpr std::string_view floor_spectra_row[]{"nodes..."};
constexpr RowKeys row_keys(const FloorSpectraOptions*) { return floor_spectra_row; }
constexpr std::string_view scalar_key(const FloorSpectraOptions*) { return "nodes"; }

template <class Archive>
void visit(Archive& ar, OutputOptions& o) {
  ar(Field{"frames", "rate of ParaView frames; 0: none; static stages: every point, in `static/STAGE`", dimension::frequency, range::non_negative}, o.frames);
  ar(Field{"history_rate", "rate of histories; 0: every step", dimension::frequency, range::non_negative},
     o.history_rate);
  ar(Field{"history", "what to keep: `nodes`, `contacts`, `elements`, `sections`, `fibers`, `energy`, `ground`"},
     o.history);
  ar(Field{"nodes", "`structure.node` to keep; empty: all"}, o.nodes);
  ar(Field{"fibers",
           "`structure.element`, or `structure.element:2` for its second integration point, whose fibers to keep; empty: all"},
     o.fibers);
  ar(Field{"floor_spectra", "response spectra of the floors' absolute motion, as `floor_spectra = \"floors\"`; without, or `\"none\"`: none"},
     o.floor_spectra);
  ar(Field{"amplification", "of the displacements stored in the frames", {}, range::non_negative}, o.amplification);
  ar(Field{"checkpoint", "wall-clock time between checkpoints for `--resume`; 0: only when the run ends",
           dimension::time, range::non_negative},
     o.checkpoint);
}

}  // namespace nsframe
