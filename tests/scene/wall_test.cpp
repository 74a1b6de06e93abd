// Walls of a structure: what they become, what they refuse, and that they move as the same built by hand.
#include <doctest/doctest.h>

#include <algorithm>

#include "base/errors.hpp"
#include "scene_text.hpp"

using namespace nsframe;
using test::displaced;
using test::error;
using test::scene;

namespace {

// A wall of two stories with a beam from its edge and one from a node within it to a column; the roof pushed along x.
std::string beside_column(const std::string& walls, const std::string& more = "") {
  return R"(
[section.c]
E = "30 GPa"
poisson = 0.2
A = 0.09
Iz = 6.75e-4
Iy = 6.75e-4
J = 1e-3
[structure.a]
nodes = [[0, 0, 0, 0], [1, 0, 0, 3], [2, 0, 0, 7], ["in", 0.5, 0.1, 7], ["f", 6, 0, 0], ["m", 6, 0, 3], ["t", 6, 0, 7]]
supports = { 0 = "fixed", f = "fixed" }
)" + walls + more + R"(
[[static]]
loads = [["a.t", "ux", "100 kN"], ["a.t", "uy", "10 kN"]]
)";
}

const std::string beams = R"(
beams = [["l", "f", "m", "c"], ["u", "m", "t", "c"], ["b", "1+", "m", "c"], ["r", "in", "t", "c"]]
)";
const std::string plain = R"(id = "w", nodes = [0, 1, 2], length = "3 m", attached = "in")";
const std::string concrete = R"(, thickness = ["30 cm", "20 cm"], E = "30 GPa")";

std::string walls(const std::string& keys) { return "walls = [{ " + keys + " }]" + beams; }

std::string refused(const std::string& keys) { return error(beside_column(walls(keys))); }

}  // namespace

TEST_CASE("a wall becomes a beam-column a story, its edges nodes that follow the axis with the attached ones") {
  const Scene s = scene(beside_column(walls(plain + concrete + R"(, direction = "-x")")));
  const StructureDescription& a = s.model.structures[0];
  REQUIRE(a.elements.size() == 6);
  CHECK(a.elements[4].id == "w-1");
  CHECK(a.elements[5].id == "w-2");
  CHECK(a.elements[5].node_i.name == "1");
  CHECK(a.elements[5].node_j.name == "2");
  CHECK(a.elements[5].orientation->isApprox(Vector3(0, -1, 0), 1e-15));
  const auto section = [&s](const std::string& name) {
    return *std::find_if(s.model.sections.begin(), s.model.sections.end(), [&](const auto& known) { return known.name == name; });
  };
  const auto upper = section(a.elements[5].section.name);
  const auto constants = std::get<ElasticSection>(upper.kind);
  CHECK(constants.Iz == doctest::Approx(0.2 * 27 / 12).epsilon(1e-14));
  CHECK(constants.Iy == doctest::Approx(3 * 0.008 / 12).epsilon(1e-14));
  CHECK(constants.G == doctest::Approx(12.5e9).epsilon(1e-14));
  CHECK(constants.Ay == doctest::Approx(0.5).epsilon(1e-14));
  CHECK(std::get<ElasticSection>(section(a.elements[4].section.name).kind).A == doctest::Approx(0.9).epsilon(1e-14));
  CHECK(upper.outline.size() == 4);
  REQUIRE(a.nodes.size() == 7 + 6);
  CHECK(a.nodes[9].id == "1-");
  CHECK(a.nodes[9].position == Vector3(1.5, 0, 3));
  CHECK(a.nodes[10].id == "1+");
  CHECK(a.nodes[10].position == Vector3(-1.5, 0, 3));
  REQUIRE(a.constraints.size() == 3);
  CHECK(a.constraints[2].kind == ConstraintKind::rigid_body);
  CHECK(a.constraints[2].master.name == "2");
  REQUIRE(a.constraints[2].slaves.size() == 3);
  CHECK(a.constraints[2].slaves[2].name == "in");
}

TEST_CASE("a frame with a wall moves as with a column, nodes at its edges and rigid links made by hand") {
  const std::string by_hand = R"(
rigid_links = [[1, "e"], [2, "in"]]
beams = [["l", "f", "m", "c"], ["u", "m", "t", "c"], ["b", "e", "m", "c"], ["r", "in", "t", "c"],
  { id = "w", nodes = [0, 1], section = "lower" }, { id = "v", nodes = [1, 2], section = "upper" }]
[section.lower]
E = "30 GPa"
poisson = 0.2
A = 0.9
Iz = 0.675
Iy = 6.75e-3
J = 0.025298328036
Ay = 0.75
Az = 0.75
[section.upper]
E = "30 GPa"
poisson = 0.2
A = 0.6
Iz = 0.45
Iy = 2e-3
J = 0.00766386726643
Ay = 0.5
Az = 0.5
)";
  std::string text = beside_column(by_hand);
  text.replace(text.find("[\"f\", 6, 0, 0]"), 0, "[\"e\", 1.5, 0, 3], ");
  const VectorX all = displaced(text);
  VectorX hand(6 * 7);
  hand << all.head(6 * 4), all.tail(6 * 3);  // without "e"
  const VectorX wall = displaced(beside_column(walls(plain + concrete))).head(6 * 7);  // of the nodes that the scene lists
  CHECK(hand[6 * 6] > 1e-4);
  CHECK((wall - hand).norm() < 1e-9 * hand.norm());
}

TEST_CASE("members of a wall by section take the structure's element and geometry, those by thickness its geometry") {
  const std::string core = R"(
[material.m]
law = "Elastic"
E = "30 GPa"
[section.core]
patches = [{ material = "m", y = [-1.5, 1.5], z = [-0.1, 0.1], ny = 10, nz = 1 }]
GJ = 1e9
)";
  const auto member = [&](const std::string& keys) {
    const std::string defaults = "element = \"force-based\"\npoints = 4\ngeometry = \"p-delta\"\ninner_iterations = true\n";
    const Scene s = scene(beside_column(defaults + "walls = [{ " + keys + " }]\n", core));
    return s.model.structures[0].elements[0];
  };
  const ElementDescription fiber = member(R"(id = "w", nodes = [0, 1, 2], length = "3 m", section = "core")");
  CHECK(fiber.kind == ElementKind::force_beam);
  CHECK(fiber.points == 4);
  CHECK(fiber.inner_iterations);
  CHECK(fiber.section.name == "core");
  const ElementDescription solid = member(plain + concrete);
  CHECK(solid.kind == ElementKind::elastic_beam);
  CHECK(solid.geometry == Geometry::p_delta);
  CHECK_FALSE(solid.inner_iterations);
}

TEST_CASE("what a wall can't be is an error at its place") {
  CHECK(refused(plain) == "s.toml:12:10: error: a wall needs thickness and E, or section");
  CHECK(refused(plain + concrete + ", section = \"c\"") ==
        "s.toml:12:86: error: a wall has either thickness or section\ns.toml:12:110: error: a wall has either E or section");
  CHECK(refused("id = \"w\", nodes = [0], length = 3" + concrete) == "s.toml:12:30: error: a wall has two nodes on its axis, or more");
  CHECK(refused(plain + ", thickness = [1, 1, 1], E = 3e10") ==
        "s.toml:12:86: error: thickness has 3 values, must have one, or one a story (2)");
  CHECK(refused(plain + concrete + ", direction = [1, 0, 1]") == "s.toml:12:132: error: the direction of a wall's length is horizontal");
  CHECK(refused(plain + concrete + ", element = \"force-based\"") ==
        "s.toml:12:130: error: a wall by thickness and E is elastic; give the section of another one");
  CHECK(refused(plain + concrete + ", points = 3") == "s.toml:12:129: error: a wall by thickness and E is elastic and has no points");
  CHECK(refused("id = \"w\", nodes = [0, 1, 2], lenght = 3" + concrete) ==
        "s.toml:12:10: error: missing key 'length'\ns.toml:12:41: error: unknown key 'lenght'; did you mean 'length'?");
  CHECK(refused("id = \"w\", nodes = [0, 2, 1], length = 3" + concrete) ==
        "s.toml:12:37: error: node '1' is not above '2': the axis of a wall is vertical, its nodes go from the foot upwards");
  CHECK(refused("id = \"w\", nodes = [0, 1, \"in\"], length = 3" + concrete) ==
        "s.toml:12:37: error: node 'in' is not above '1': the axis of a wall is vertical, its nodes go from the foot upwards");
  CHECK(refused("id = \"w\", nodes = [0, 2], length = 3, attached = \"m\", thickness = 1, E = 1") ==
        "s.toml:12:61: error: node 'm' at z = 3 m is at the level of no node of wall 'w'");
  CHECK(refused("id = \"w\", nodes = [0, 1, 2], length = 3, attached = [\"in\", \"t\"]" + concrete) ==
        "s.toml:12:71: error: node 't' is 6 m from the axis of wall 'w', whose edges are at 1.5 m");
  CHECK(refused("id = \"w\", nodes = [0, 1, 2], length = 3, attached = \"in\", E = 3e10, thickness = \"15 cm\"") ==
        "s.toml:12:64: error: node 'in' is 0.1 m out of the plane of wall 'w'; use rigid_links");
  CHECK(error(beside_column(walls("id = \"w\", nodes = [0, 1, 2], length = \"2 m\", section = \"deep\""),
                            "[section.deep]\nE = 1\nG = 1\nA = 1\nIz = 1\nIy = 1\nJ = 1\ndepth = 0.2\nwidth = 2\n")) ==
        "s.toml:12:67: error: section 'deep' is 0.2 m deep (local y), wall 'w' is 2 m long");
}

TEST_CASE("names of a wall that the structure doesn't have, or has already, are errors at their places") {
  const auto built = [](const std::string& text) {
    Diagnostics diagnostics;
    const Scene s = parse_scene(text, "s.toml", {}, {}, diagnostics);
    try {
      if (diagnostics.empty()) build_model(s.model, diagnostics);
    } catch (const InputError&) {
    }
    std::string all;
    for (const std::string& message : diagnostics.messages()) all += (all.empty() ? "" : "\n") + message;
    return all;
  };
  CHECK(built(beside_column(walls("id = \"w\", nodes = [0, 1, 2], length = 3, attached = \"inn\"" + concrete)))
            .find("s.toml:12:64: error: node 'inn' is not defined in structure 'a'; did you mean 'in'?") == 0);
  CHECK(built(beside_column(walls("id = \"w\", nodes = [0, 11, 2], length = 3" + concrete)))
            .find("s.toml:12:34: error: node '11' is not defined in structure 'a'") != std::string::npos);
  std::string text = beside_column(walls(plain + concrete));
  text.replace(text.find("[\"f\", 6, 0, 0]"), 0, "[\"1+\", 1.5, 0, 3], ");
  CHECK(built(text) == "s.toml:12:34: error: the edge of wall 'w' at node '1' would be called '1+', which is another node's name");

  // nothing follows from a length that is missing
  Diagnostics diagnostics;
  const Scene s = parse_scene(beside_column(walls("id = \"w\", nodes = [0, 1, 2]" + concrete)), "s.toml", {}, {}, diagnostics);
  CHECK_THROWS_AS(build_model(s.model, diagnostics), InputError);
  REQUIRE(diagnostics.messages().size() == 1);
  CHECK(diagnostics.messages()[0] == "s.toml:12:10: error: missing key 'length'");
}
