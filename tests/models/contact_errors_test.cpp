// Errors of slabs and contacts that building a model reports, with their words and places.
#include <doctest/doctest.h>

#include <limits>

#include "tests/models/descriptions.hpp"

using namespace nsframe;
using namespace nsframe::test;

TEST_CASE("a slab has three corners at least") {
  ModelDescription d = two_slabs();
  only(d).slabs[0].corners.resize(2);
  CHECK(error_of(d) == "s.toml:45:3: error: slab 'left.1' needs at least three corners");
}

TEST_CASE("contacts between slabs: the number of gaps, the level, the overlap") {
  ModelDescription d = two_slabs();
  d.contacts = {slab_contact()};
  CHECK(error_of(d) == "no error");
  d.contacts = {slab_contact({0.1, 0.2, 0.3})};
  CHECK(error_of(d) == "s.toml:50:3: error: 3 gaps for 2 pairs on 1 floor: give one, or 2");
  d = two_slabs(3.5);
  d.contacts = {slab_contact()};
  CHECK(error_of(d) == "s.toml:50:3: error: structures 'left' and 'right' have no slabs at the same level; kind = \"slab-columns\" or \"facing\" takes slabs "
        "between the floors of the other");
  d = two_slabs();
  d.contacts = {slab_contact()};
  for (NodeDescription& item : d.structures[1].nodes) item.position.x() -= 0.15;
  CHECK(error_of(d) ==
        "s.toml:50:3: error: contact 'left.2|right.1': the coordinates overlap by 0.05 m; give the gap or move a structure\n"
        "s.toml:50:3: error: contact 'left.3|right.4': the coordinates overlap by 0.05 m; give the gap or move a structure");
  d.contacts = {slab_contact({0.01})};
  CHECK(error_of(d) == "no error");
  d.contacts[0].b.reset();
  CHECK(error_of(d) == "s.toml:50:3: error: slab-corners needs two structures");
  d.contacts = {slab_contact()};
  d.contacts[0].b->name = "rigth";
  CHECK(error_of(d) == "s.toml:52:3: error: structure 'rigth' is not defined; did you mean 'right'?");
  d = two_slabs();
  d.structures[1].nodes[0].position.x() -= 0.01;
  d.contacts = {slab_contact()};
  CHECK(error_of(d) == "s.toml:50:3: error: slabs 'left.1' and 'right.1' do not face each other with two corners each; kind = \"slab-edges\" "
        "takes slabs that are turned");
}

TEST_CASE("contacts between nodes: references, gaps, restitution, direction, and a side that can move") {
  ModelDescription d = two_slabs();
  d.contacts = {node_contact("left.2", "right.1")};
  CHECK(error_of(d) == "no error");
  d.contacts = {node_contact("left.22", "")};
  CHECK(error_of(d) == "s.toml:51:3: error: node 'left.22' is not defined; did you mean 'left.2'?");
  d.contacts = {node_contact("left.2", "right.1", {0.1, 0.2})};
  CHECK(error_of(d) == "s.toml:50:3: error: a contact of two nodes has one gap");
  d.contacts = {node_contact("left.2", "", {})};
  CHECK(error_of(d) == "s.toml:50:3: error: a contact with the ground needs its gap, or a wall");
  for (const double e : {-0.1, 1.1, std::numeric_limits<double>::quiet_NaN()}) {
    d.contacts = {node_contact("left.2", "right.1")};
    d.contacts[0].restitution = e;
    const auto errors = errors_of(d);
    REQUIRE(errors.size() == 1);
    CHECK(errors[0].starts_with("s.toml:50:3: error: restitution = "));
    CHECK(errors[0].ends_with(", must lie in [0, 1]"));
  }
  d.contacts = {node_contact("left.2", "right.1")};
  d.contacts[0].direction = Vector3(1, 1, 0);
  CHECK(error_of(d) == "s.toml:50:3: error: the direction of a contact must be a unit vector");
  d = column();
  d.contacts = {node_contact("a.1", "")};
  CHECK(error_of(d) == "s.toml:50:3: error: contact 'a.1|wall': both sides are held by supports in its direction");
}
