// Structures that can move without resistance are named before an analysis fails on them.
#include <doctest/doctest.h>

#include "assembly/stability.hpp"
#include "tests/support/small_models.hpp"

using namespace nsframe;
using namespace nsframe::test;

namespace {

std::string stability_of(const ModelDescription& description) {
  const Model model = build(description);
  const Assembler assembler(model);
  Diagnostics diagnostics;
  check_stability(model, assembler.tangent(), diagnostics);
  std::string all;
  for (const std::string& message : diagnostics.messages()) all += (all.empty() ? "" : "\n") + message;
  return all.empty() ? "stable" : all;
}

const std::string missing = " without resistance (a support, a brace or a connection is missing)";

// A square of pin-jointed bars in the x-z plane, stiffened by a diagonal or not.
ModelDescription square(bool brace) {
  ModelDescription d;
  d.materials = {{"steel", {}, Elastic{210e9}}};
  StructureDescription s;
  s.name = "truss";
  s.at = at(3);
  s.nodes = {node("1", 0, 0, 0), node("2", 2, 0, 0), node("3", 2, 0, 2), node("4", 0, 0, 2)};
  for (const auto& [i, j] : {std::pair{"1", "4"}, {"2", "3"}, {"4", "3"}}) s.elements.push_back(bar(std::string(i) + j, i, j, "steel", 1e-3));
  if (brace) s.elements.push_back(bar("13", "1", "3", "steel", 1e-4));
  s.supports = {fixed("1"), fixed("2"), fixed("3", {false, true, false, false, false, false}), fixed("4", {false, true, false, false, false, false})};
  s.masses = {mass("3", 10), mass("4", 10)};
  d.structures = {s};
  return d;
}

}  // namespace

TEST_CASE("a square of hinged bars sways without a diagonal, and is stable with one") {
  CHECK(stability_of(square(true)) == "stable");
  const std::string message = stability_of(square(false));
  CHECK((message == "s.toml:3:3: error: structure 'truss' is unstable: node 'truss.3' moves in ux" + missing ||
         message == "s.toml:3:3: error: structure 'truss' is unstable: node 'truss.4' moves in ux" + missing));
}

TEST_CASE("a column without its support floats; with a hinge it turns") {
  ModelDescription d = column();
  CHECK(stability_of(d) == "stable");
  d.structures[0].supports.clear();
  CHECK(stability_of(d).starts_with("s.toml:1:3: error: structure 'a' is unstable: node 'a."));
  d.structures[0].supports = {fixed("1", {true, true, true, false, true, true})};  // free to turn about x: sways in y
  const std::string message = stability_of(d);
  CHECK((message == "s.toml:1:3: error: structure 'a' is unstable: node 'a.2' moves in uy" + missing));
}

TEST_CASE("a floating building may move freely when it is told to, if all of it has mass") {
  ModelDescription d = column();
  d.structures[0].supports.clear();
  d.structures[0].masses.push_back(mass("1", 1000, Vector3::Ones()));
  d.structures[0].may_move_freely = true;
  CHECK(stability_of(d) == "stable");
  d.structures[0].masses.back().inertia.setZero();  // the column may now spin about its own axis
  CHECK(stability_of(d) == "s.toml:1:3: error: structure 'a' is unstable: node 'a.1' moves in rz" + missing);
}

TEST_CASE("a free mass is unstable unless it may move freely") {
  ModelDescription d;
  StructureDescription s;
  s.name = "ball";
  s.at = at(4);
  s.nodes = {node("1", 0, 0, 0)};
  s.masses = {mass("1", 2)};
  d.structures = {s};
  CHECK(stability_of(d) == "s.toml:4:3: error: structure 'ball' is unstable: node 'ball.1' moves in ux" + missing);
  d.structures[0].may_move_freely = true;
  CHECK(stability_of(d) == "stable");
}

TEST_CASE("the unconnected part of a structure is named") {
  ModelDescription d = column();
  d.structures[0].nodes.push_back(node("3", 5, 0, 0));
  d.structures[0].nodes.push_back(node("4", 5, 0, 2.5));
  d.structures[0].elements.push_back(beam("e2", "3", "4", "c"));
  d.structures[0].masses.push_back(mass("4", 10));
  CHECK(stability_of(d).starts_with("s.toml:1:3: error: structure 'a/2' is unstable: node 'a."));
}

TEST_CASE("a slender column of 500 elements, and one on a spring 1e9 times softer than itself, are stable") {
  ModelDescription d = column();
  StructureDescription& s = d.structures[0];
  s.nodes.clear();
  s.elements.clear();
  const int count = 500;
  for (int i = 0; i <= count; ++i) s.nodes.push_back(node("n" + std::to_string(i), 0, 0, 25.0 * i / count));
  for (int i = 0; i < count; ++i) s.elements.push_back(beam("e" + std::to_string(i), "n" + std::to_string(i), "n" + std::to_string(i + 1), "c"));
  s.supports = {fixed("n0")};
  s.masses = {mass("n500", 1000)};
  CHECK(stability_of(d) == "stable");
  d = column();
  Vector6 soft = Vector6::Constant(1e12);
  soft[3] = 1e-3;
  d.structures[0].supports.clear();
  d.structures[0].springs = {ground_spring("k", "1", soft)};
  CHECK(stability_of(d) == "stable");
}
