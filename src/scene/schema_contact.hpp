// The schema of contacts; see schema.hpp.
#pragma once

#include "scene/schema.hpp"

namespace nsframe {

constexpr auto names_of(ContactKind) {
  return Names<ContactKind, 2>{{{"slab-corners", ContactKind::slab_corners}, {"nodes", ContactKind::nodes}}};
}

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

}  // namespace nsframe
