// The schema of contacts; see schema.hpp.
#pragma once

#include "scene/schema.hpp"

namespace nsframe {

constexpr auto names_of(ContactKind) {
  return Names<ContactKind, 6>{{{"slab-corners", ContactKind::slab_corners},
                                {"slab-edges", ContactKind::slab_edges},
                                {"slab-columns", ContactKind::slab_columns},
                                {"facing", ContactKind::facing},
                                {"wall", ContactKind::wall},
                                {"nodes", ContactKind::nodes}}};
}

template <class Archive>
void visit_law(Archive& ar, ContactLawChoice& c) {
  ar(Field{"law",
           "`newton`: impulses by Newton's restitution; or a penalty law, a force of penetration and its rate: `linear-viscoelastic`, "
           "`modified-linear-viscoelastic`, `anagnostopoulos`, `hertz`, `hertz-damped`, `jankowski`, `khatami` (theory.md, 250-258)"},
     c.name);
  ar(Field{"stiffness", "of the linear penalty laws", dimension::stiffness, range::positive}, c.stiffness);
  ar(Field{"stiffness_ratio",
           "in place of `stiffness`, and of `anagnostopoulos`: over the static stiffness of the stiffer body at the point of contact", {},
           range::positive},
     c.stiffness_ratio);
  ar(Field{"hertz_stiffness", "of the other penalty laws, by penetration^1.5, in N/m^1.5", {}, range::positive}, c.hertz_stiffness);
  ar(Field{"damping_ratio", "xi of a penalty law, in place of `restitution`", {}, range::non_negative}, c.damping_ratio);
  ar(Field{.key = "effective_mass",
           .text = "m* in the damping of a penalty law",
           .dimension = dimension::mass,
           .range = range::positive,
           .default_text = "1 / (H M^-1 H'), of two masses m1 m2 / (m1 + m2)"},
     c.effective_mass);
}

template <class Archive>
void visit(Archive& ar, ContactTable& c) {
  ar(Field{"name", "prefix of the pairs' names"}, c.name);
  ar(Field{.key = "kind",
           .text = "slab-corners: facing corners of slabs at one level; slab-edges: corners of either's slabs against edges of the "
                   "other's; slab-columns: slabs of either against columns of the other, between its floors; facing: slab edges "
                   "where there is a slab, else columns; wall: corners of slabs against a fixed plane; nodes: one node against "
                   "another or the ground",
           .default_text = "by the names in `between`"},
     c.kind);
  ar(Field{"between",
           "two structures, or more in a row, each against the next; or a structure and \"ground\" (a wall); or two nodes "
           "`structure.node`, or a node and \"ground\""},
     c.between);
  ar(Field{"a", "one node, with `b` in place of `between`"}, c.a);
  ar(Field{"b", "the other node, or \"ground\""}, c.b);
  ar(Field{"direction", "from the first to the second"}, c.direction);
  ar(Field{.key = "wall", .text = "x, y, z of a point of the fixed plane, which stands across `direction`", .dimension = dimension::length,
           .default_text = "by `gap`"},
     c.wall);
  ar(Field{.key = "gap",
           .text = "one value; or one a pair of a floor by rising y (or x); or rows of these, one a floor from the lowest",
           .dimension = dimension::length,
           .default_text = "from the coordinates"},
     c.gap);
  ar(Field{"gap_tolerance",
           "largest difference of a given gap from the distance of the coordinates: slabs may overhang their columns; not of nodes",
           dimension::length, range::non_negative},
     c.gap_tolerance);
  ar(Field{"reach", "pairs farther apart are left out; not of slab-corners and nodes", dimension::length, range::positive}, c.reach);
  ar(Field{"sliding_error",
           "a run warns when sliding along a turned face makes the gap wrong by more (theory.md, 187)", dimension::length,
           range::positive},
     c.sliding_error);
  ar(Field{.key = "restitution",
           .text = "e of Newton's or Poisson's law (`analysis.impact_law`), or what the damping of another law is meant to give; one value, or "
                   "listed as `gap`",
           .range = range::unit,
           .default_text = "0.6"},
     c.restitution);
  ar(Field{"friction",
           "Coulomb's coefficient, static and sliding alike, along both tangents of the face; 0: none. Of scheme `moreau-jean`, without `law`", {},
           range::non_negative},
     c.friction);
  visit_law(ar, c.law);
}

}  // namespace nsframe
