// Errors that building a model reports, with their words and places; others in member_errors_test.cpp,
// section_errors_test.cpp and contact_errors_test.cpp.
#include <doctest/doctest.h>

#include <limits>

#include "tests/models/descriptions.hpp"

using namespace nsframe;
using namespace nsframe::test;

TEST_CASE("a column with a mass at its top is a valid model") { CHECK(error_of(column()) == "no error"); }

TEST_CASE("a reference to a node, section or material that is not there is an error that names the nearest one") {
  ModelDescription d = column();
  only(d).nodes.push_back({"top", at(9), Vector3(0, 0, 5)});
  only(d).elements.push_back(beam("e2", "2", "tpo", "c"));
  only(d).elements.back().node_j.at = at(7);
  CHECK(error_of(d) ==
        "s.toml:7:3: error: node 'tpo' is not defined in structure 'a'; did you mean 'top'?\n"
        "s.toml:9:3: error: node 'a.top' is not held in ux: no element with stiffness, support or mass acts there");
  d = column();
  d.sections.front().name = "column";
  only(d).elements[0].section = {"colum", at(8)};
  CHECK(error_of(d) == "s.toml:8:3: error: section 'colum' is not defined; did you mean 'column'?");
  d = column();
  d.materials.push_back({"steel", {}, Elastic{210e9}});
  only(d).elements.push_back(bar("b", "1", "2", "stel", 1e-4));
  only(d).elements.back().material.at = at(8);
  CHECK(error_of(d) == "s.toml:8:3: error: material 'stel' is not defined; did you mean 'steel'?");
  d = column();
  d.materials.push_back({"steel", {}, Elastic{210e9}});
  d.sections.push_back(fibers("f", 0, "steal"));
  CHECK(error_of(d) == "s.toml:30:3: error: material 'steal' is not defined; did you mean 'steel'?");
  d = column();
  d.materials.push_back({"steel", {}, Elastic{210e9}});
  only(d).springs = {ground_spring("k", "2", Vector6::Ones())};
  only(d).springs[0].law[0] = Reference{"stel", at(6)};
  CHECK(error_of(d) == "s.toml:6:3: error: material 'stel' is not defined; did you mean 'steel'?");
}

TEST_CASE("nodes named by supports, masses, springs, constraints, slabs and initial values must exist") {
  ModelDescription d = column();
  StructureDescription& s = only(d);
  s.supports.push_back({{"3", at(1)}, all_dofs});
  s.masses.push_back({{"4", at(2)}, Vector3::Ones(), Vector3::Zero()});
  s.springs = {ground_spring("k", "5", Vector6::Ones())};
  s.springs[0].node_i.at = at(3);
  s.constraints = {constraint(ConstraintKind::rigid_body, "2", {"6"})};
  s.constraints[0].slaves[0].at = at(4);
  s.slabs.push_back({"1", at(5), {{"1", {}}, {"2", {}}, {"7", at(5)}}, {}, 0.1, false});
  s.initial_velocities.push_back({{"8", at(6)}, 0, 1.0});
  const auto errors = errors_of(d);
  REQUIRE(errors.size() == 6);
  const std::array<int, 6> lines{3, 4, 1, 2, 5, 6}, names{5, 6, 3, 4, 7, 8};
  for (std::size_t i = 0; i < 6; ++i) {
    CHECK(errors[i] == "s.toml:" + std::to_string(lines[i]) + ":3: error: node '" + std::to_string(names[i]) +
                           "' is not defined in structure 'a'; known: 1, 2");
  }
}

TEST_CASE("an id that is used twice is an error, whatever it names") {
  ModelDescription d = column();
  only(d).nodes.push_back({"2", at(11), Vector3(0, 0, 3)});
  CHECK(error_of(d) == "s.toml:11:3: error: node 'a.2' is defined twice");
  d = column();
  only(d).elements.push_back(beam("e1", "1", "2", "c"));
  only(d).elements.back().at = at(12);
  CHECK(error_of(d) == "s.toml:12:3: error: element 'a.e1' is defined twice");
  d = column();
  only(d).springs = {ground_spring("e1", "2", Vector6::Ones())};
  only(d).springs[0].at = at(13);
  CHECK(error_of(d) == "s.toml:13:3: error: element 'a.e1' is defined twice");
  d = column();
  d.materials = {{"m", {}, Elastic{1}}, {"m", at(14), Elastic{2}}};
  CHECK(error_of(d) == "s.toml:14:3: error: material 'm' is defined twice");
  d = column();
  d.sections.push_back(d.sections[0]);
  d.sections[1].at = at(15);
  CHECK(error_of(d) == "s.toml:15:3: error: section 'c' is defined twice");
  d = column();
  d.structures.push_back(StructureDescription{});
  d.structures[1].name = "a";
  d.structures[1].at = at(16);
  CHECK(error_of(d) == "s.toml:16:3: error: structure 'a' is defined twice");
  d = two_slabs();
  only(d).slabs.push_back(only(d).slabs[0]);
  CHECK(error_of(d) == "s.toml:45:3: error: slab 'left.1' is defined twice");
}

TEST_CASE("a member without length, or with an orientation along it, is an error") {
  ModelDescription d = column();
  only(d).nodes.push_back(node("3", 0, 0, 2.5));
  only(d).masses.push_back(mass("3", 1));
  only(d).elements.push_back(beam("e2", "2", "3", "c"));
  only(d).elements.back().at = at(7);
  CHECK(error_of(d) == "s.toml:7:3: error: element 'a.e2': zero length");
  d = column();
  only(d).elements[0].at = at(7);
  only(d).elements[0].orientation = Vector3(0, 0, -2);
  CHECK(error_of(d) == "s.toml:7:3: error: element 'a.e1': orientation vector parallel to the member");
}

TEST_CASE("offsets that leave a member no length, or of a truss, are errors") {
  ModelDescription d = column();
  only(d).elements[0].at = at(7);
  only(d).elements[0].offset = {Vector3(0, 0, 1), Vector3(0, 0, -1.5)};
  CHECK(error_of(d) == "s.toml:7:3: error: element 'a.e1': zero length");
  d = column();
  d.materials.push_back({"m", {}, Elastic{210e9}});
  only(d).elements.push_back(bar("t", "1", "2", "m", 1e-4));
  only(d).elements.back().at = at(8);
  only(d).elements.back().offset[0] = Vector3(0.1, 0, 0);
  CHECK(error_of(d) == "s.toml:8:3: error: element 'a.t': a truss has no offsets, they would bend it");
}

TEST_CASE("a node that nothing holds in one direction is an error that names the direction") {
  ModelDescription d = column();
  only(d).nodes.push_back({"3", at(9), Vector3(1, 0, 0)});
  CHECK(error_of(d) == "s.toml:9:3: error: node 'a.3' is not held in ux: no element with stiffness, support or mass acts there");
  only(d).supports.push_back(fixed("3", {true, false, true, false, false, false}));
  CHECK(error_of(d) == "s.toml:9:3: error: node 'a.3' is not held in uy: no element with stiffness, support or mass acts there");
  only(d).supports.back().fixed[1] = true;
  CHECK(error_of(d) == "no error");
}

TEST_CASE("constraints that contradict a support, each other or themselves are errors") {
  ModelDescription d = column();
  only(d).nodes.push_back(node("3", 1, 0, 2.5));
  only(d).nodes.push_back(node("4", 0, 1, 2.5));
  only(d).constraints = {constraint(ConstraintKind::rigid_body, "2", {"3"}), constraint(ConstraintKind::equal_dof, "2", {"4"})};
  only(d).constraints[1].at = at(21);
  ModelDescription held = d;
  only(held).supports.push_back(fixed("4", {false, true, false, false, false, false}));
  CHECK(error_of(held) == "s.toml:21:3: error: uy of node 'a.4' is tied here and held by a support");
  ModelDescription twice = d;
  only(twice).constraints.push_back(constraint(ConstraintKind::diaphragm, "2", {"4"}));
  only(twice).constraints.back().at = at(22);
  CHECK(error_of(twice) ==
        "s.toml:22:3: error: ux of node 'a.4' is already tied by another constraint\n"
        "s.toml:22:3: error: uy of node 'a.4' is already tied by another constraint\n"
        "s.toml:22:3: error: rz of node 'a.4' is already tied by another constraint");
  ModelDescription self = d;
  only(self).constraints.push_back(constraint(ConstraintKind::rigid_body, "2", {"2"}));
  only(self).constraints.back().slaves[0].at = at(23);
  CHECK(error_of(self) == "s.toml:23:3: error: node '2' cannot follow itself");
}

TEST_CASE("two nodes that follow each other are reported once each, not once a direction") {
  ModelDescription d = column();
  only(d).nodes.push_back(node("3", 1, 0, 2.5));
  only(d).nodes.push_back(node("4", 0, 1, 2.5));
  only(d).constraints = {constraint(ConstraintKind::rigid_body, "3", {"4"}), constraint(ConstraintKind::rigid_body, "4", {"3"})};
  only(d).constraints[0].at = at(21);
  only(d).constraints[1].at = at(22);
  CHECK(error_of(d) ==
        "s.toml:22:3: error: constraints of node 'a.3' follow each other in a circle\n"
        "s.toml:21:3: error: constraints of node 'a.4' follow each other in a circle");
}

TEST_CASE("masses must be finite and not negative") {
  for (const double value : {-1.0, std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    ModelDescription d = column();
    only(d).masses[0] = {{"2", at(5)}, Vector3(1, 1, value), Vector3::Zero()};
    CHECK(error_of(d) == "s.toml:5:3: error: mass of node 'a.2' must be positive or zero");
  }
}

TEST_CASE("coordinates must be finite") {
  ModelDescription d = column();
  only(d).nodes[1] = {"2", at(4), Vector3(0, 0, std::numeric_limits<double>::infinity())};
  only(d).elements[0].at = at(5);
  CHECK(errors_of(d).front() == "s.toml:4:3: error: node 'a.2': coordinates must be finite");
}

TEST_CASE("bars, cables and springs with impossible properties are errors") {
  ModelDescription d = column();
  d.materials = {{"steel", {}, Steel01{235e6, 210e9, 0.01}}, {"wire", {}, Elastic{160e9}}};
  only(d).elements.push_back(bar("b", "1", "2", "steel", 1e-4, ElementKind::cable));
  only(d).elements.back().at = at(7);
  only(d).elements.back().material.at = at(8);
  CHECK(error_of(d) == "s.toml:8:3: error: cable 'a.b' needs an Elastic material; 'steel' is not");
  only(d).elements.back().material.name = "wire";
  only(d).elements.back().pretension = -5;
  CHECK(error_of(d) == "s.toml:7:3: error: cable 'a.b': negative pretension");
  only(d).elements.back().pretension = 0;
  only(d).elements.back().area = 0;
  CHECK(error_of(d) == "s.toml:7:3: error: element 'a.b': the area must be positive");
  d = column();
  only(d).springs = {ground_spring("k", "2", -Vector6::Unit(2))};
  only(d).springs[0].at = at(7);
  CHECK(error_of(d) == "s.toml:7:3: error: spring 'a.k': negative stiffness or damping");
}

TEST_CASE("an initial value of a held direction is an error") {
  ModelDescription d = column();
  only(d).initial_displacements.push_back({{"1", at(6)}, 2, 0.1});
  CHECK(error_of(d) == "s.toml:6:3: error: uz of node 'a.1' is not free: its initial value cannot be set");
}

TEST_CASE("a model in which supports hold everything, or without structures, is an error") {
  ModelDescription d = column();
  only(d).supports.push_back(fixed("2"));
  CHECK(error_of(d) == "s.toml:1:3: error: nothing can move: supports hold every degree of freedom");
  CHECK(error_of(ModelDescription{}) == "error: there is no structure");
}

TEST_CASE("all errors of one description are reported at once") {
  ModelDescription d = column();
  StructureDescription& s = only(d);
  d.materials = {{"m", at(2), Elastic{-1}}};
  s.nodes.push_back({"2", at(3), Vector3::Zero()});
  s.nodes.push_back({"lonely", at(4), Vector3(9, 9, 9)});
  s.elements[0].section = {"d", at(5)};
  s.masses[0] = {{"2", at(6)}, -Vector3::Ones(), Vector3::Zero()};
  s.initial_velocities.push_back({{"1", at(7)}, 0, 1});
  d.contacts = {node_contact("a.2", "a.9")};
  d.contacts[0].restitution = 2;
  const auto errors = errors_of(d);
  CHECK(errors.size() == 8);
  CHECK_THROWS_WITH_AS(build(d), doctest::Contains("s.toml:4:3: error: node 'a.lonely' is not held in ux"), InputError);
}
