// What members can't have, with its words and its place: integration, sections, mass, releases, loads.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include "tests/models/descriptions.hpp"
#include "tests/support/small_models.hpp"

using namespace nsframe;
using namespace nsframe::test;

namespace {

SectionDescription four_fibers() {
  FiberSectionDescription section;
  for (const double y : {-0.1, 0.1}) {
    for (const double z : {-0.05, 0.05}) section.fibers.push_back({y, z, 1e-3, {"steel", {}}});
  }
  section.torsion_stiffness = 1e4;
  return {"f", at(31), section, {}};
}

}  // namespace

TEST_CASE("integration, sections, loads and mass that a member can't have are errors") {
  ModelDescription d = column();
  d.materials = {{"steel", {}, Elastic{210e9}}};
  d.sections.push_back(four_fibers());
  ElementDescription& e = only(d).elements[0];
  e.at = at(5);
  e.integration.rule = "legendre";
  CHECK(error_of(d) == "s.toml:5:3: error: element 'a.e1': an elastic beam has no integration points");
  e.integration = {};
  e.inner_iterations = true;
  CHECK(error_of(d) == "s.toml:5:3: error: element 'a.e1': an elastic beam has no inner_iterations, element = \"force-based\" has");
  e.section = {"f", {}};
  e.kind = ElementKind::displacement_beam;
  CHECK(error_of(d) == "s.toml:5:3: error: element 'a.e1': a displacement-based beam has no inner_iterations, element = \"force-based\" has");
  e.kind = ElementKind::force_beam;
  CHECK(error_of(d) == "no error");
  e.kind = ElementKind::elastic_beam;
  e.section = {"c", {}};
  e.inner_iterations = false;
  e.sections = {{"c", {}}, {"c", {}}, {"c", {}}};
  CHECK(error_of(d) == "s.toml:5:3: error: element 'a.e1': an elastic beam has one section throughout");
  e.kind = ElementKind::force_beam;
  e.sections = {{"f", {}}, {"c", {}}, {"f", {}}};
  CHECK(error_of(d) == "no error");
  e.sections[1] = {"g", at(6)};
  CHECK(error_of(d) == "s.toml:6:3: error: section 'g' is not defined; known: c, f");
  e.sections.pop_back();
  CHECK(error_of(d) ==
        "s.toml:5:3: error: element 'a.e1': 2 sections, must be 3 (first point, interior, last) or 5, one a point");
  e.sections = {{"f", {}}, {"c", {}}, {"f", {}}};
  e.integration = {"hinge-radau", 1, 1, {}, {}};
  CHECK(error_of(d) == "s.toml:5:3: error: element 'a.e1': 4 (hinge_i + hinge_j) = 8 m is more than the length, 2.5 m");
  e.integration = {};
  std::get<ElasticSection>(d.sections[0].kind).Ay = 1e-3;
  CHECK(error_of(d) == "no error");
  e.kind = ElementKind::displacement_beam;
  CHECK(error_of(d) == "s.toml:5:3: error: element 'a.e1': section 'c' deforms in shear, which elastic and force-based beams do, "
                       "and displacement-based ones don't");
  e.kind = ElementKind::force_beam;
  std::get<ElasticSection>(d.sections[0].kind).Ay = -1;
  CHECK(error_of(d).starts_with("error: section 'c': Ay must not be negative"));
  d = column();
  only(d).elements[0].at = at(5);
  only(d).elements[0].mass = {10, 0, true, false};
  only(d).elements[0].releases.basic[5] = true;
  CHECK(error_of(d) ==
        "s.toml:5:3: error: element 'a.e1': a consistent mass needs the axial force and the torsion of both ends tied; "
        "use a lumped mass");
}

TEST_CASE("what all members of one table can't be is told once, with their number") {
  ModelDescription d = column();
  StructureDescription& s = only(d);
  for (const double x : {1.0, 2.0, 3.0}) {
    const std::string foot = fmt::format("f{}", x), head = fmt::format("h{}", x);
    s.nodes.insert(s.nodes.end(), {node(foot, x, 0, 0), node(head, x, 0, 2.5)});
    s.supports.push_back(fixed(foot));
    s.elements.push_back(beam("e" + foot, foot, head, "c"));
  }
  for (ElementDescription& e : s.elements) {
    e.at = at(5);
    e.inner_iterations = true;
  }
  s.elements.back().at = at(6);
  CHECK(error_of(d) ==
        "s.toml:5:3: error: element 'a.e1' (and 2 more): an elastic beam has no inner_iterations, element = \"force-based\" has\n"
        "s.toml:6:3: error: element 'a.ef3': an elastic beam has no inner_iterations, element = \"force-based\" has");
  for (ElementDescription& e : s.elements) e.section = {"d", at(7)};
  CHECK(error_of(d) == "s.toml:7:3: error: section 'd' is not defined; known: c");
  // without a place, as of models built by code, each has its own
  for (ElementDescription& e : s.elements) {
    e.section = {"c", {}};
    e.at = {};
  }
  CHECK(errors_of(d).size() == 4);
}

TEST_CASE("a load names beams that are there, and acts between their ends") {
  ModelDescription d = column();
  d.materials = {{"steel", {}, Elastic{210e9}}};
  only(d).elements.push_back(bar("brace", "1", "2", "steel", 1e-4));
  LoadDescription load;
  load.at = at(8);
  load.elements = {{"e2", at(9)}};
  load.uniform = Vector3(1, 0, 0);
  only(d).loads = {load};
  CHECK(error_of(d) == "s.toml:9:3: error: element 'e2' is not defined in structure 'a'; did you mean 'e1'?");
  only(d).loads[0].elements[0].name = "brace";
  CHECK(error_of(d) ==
        "s.toml:8:3: error: element 'a.brace' is a truss or cable, which carries no load between its ends");
  only(d).loads[0].elements[0].name = "e1";
  only(d).loads[0].position = 1.5;
  CHECK(error_of(d) == "s.toml:8:3: error: a load at 1.5 of the beam's length, must lie in [0, 1]");
}

TEST_CASE("a corotational member keeps loads in global axes and its own weight as dead loads, others in its axes") {
  ModelDescription d = column();
  only(d).elements[0].geometry = Geometry::corotational;
  only(d).elements[0].mass = {40, 0, false, false};
  only(d).masses.clear();
  d.gravity.acceleration = Vector3(0, 0, -10);
  LoadDescription load;
  load.at = at(8);
  load.elements = {{"e1", at(9)}};
  load.uniform = Vector3(1, 2, 0);
  load.force = Vector3(0, 0, 5);
  load.position = 0.3;
  only(d).loads = {load, load};
  only(d).loads[1].local = true;
  const Model model = build(d);
  CHECK(model.gravity_load.isZero(0));  // the static analysis brings the loads on members with their factor
  CHECK(model.loaded());
  const MemberLoad& kept = *model.groups.at(0)->load(0);
  CHECK(kept.dead_uniform == Vector3(1, 2, -10 * 40));
  CHECK(kept.uniform == Vector3(1, 2, 0));
  REQUIRE(kept.dead_points.size() == 1);
  CHECK(kept.dead_points[0].position == 0.3);
  CHECK(kept.dead_points[0].force == Vector3(0, 0, 5));
  REQUIRE(kept.points.size() == 1);
  only(d).elements[0].geometry = Geometry::p_delta;  // a vertical column's local x runs up
  const Model small = build(d);
  CHECK_FALSE(small.groups.at(0)->load(0)->dead());
  CHECK(small.groups.at(0)->load(0)->uniform.x() == doctest::Approx(1 - 10 * 40));
}
