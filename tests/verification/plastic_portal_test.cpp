// A portal frame of fibers that hardly harden pushed to its sway mechanism: the limit load of plastic theory.
#include <doctest/doctest.h>

#include <cmath>

#include "integrators/simulation.hpp"
#include "tests/support/small_models.hpp"

using namespace nsframe;
using namespace nsframe::test;

TEST_CASE("a portal frame is led along its plastic plateau to the load of the sway mechanism") {
  constexpr double height = 4, span = 6, width = 0.1, depth = 0.2, fy = 235e6, E = 210e9;  // [m], [Pa]
  constexpr int layers = 40;
  ModelDescription d;
  d.materials = {{"steel", {}, Steel01{fy, E, 1e-4}}};
  FiberSectionDescription fibers;
  for (int i = 0; i < layers; ++i) {
    for (const double z : {-width / 4, width / 4}) {
      fibers.fibers.push_back({depth * ((i + 0.5) / layers - 0.5), z, width * depth / layers / 2, {"steel", {}}});
    }
  }
  fibers.torsion_stiffness = 1e6;
  d.sections.resize(1);
  d.sections[0].name = "column";
  d.sections[0].kind = fibers;
  d.sections.push_back(elastic_section("beam", {E, 81e9, 0.1, 1e-2, 1e-2, 1e-4}));
  StructureDescription s;
  s.name = "a";
  s.nodes = {node("1", 0, 0, 0), node("2", 0, 0, height), node("3", span, 0, height), node("4", span, 0, 0)};
  const std::array<bool, 6> in_plane{false, true, false, true, false, true};
  s.supports = {fixed("1"), fixed("2", in_plane), fixed("3", in_plane), fixed("4")};
  s.elements = {beam("left", "1", "2", "column", ElementKind::force_beam), beam("top", "2", "3", "beam"),
                beam("right", "4", "3", "column", ElementKind::force_beam)};
  s.masses = {mass("2", 1000)};
  d.structures = {s};
  StageDescription push;
  push.name = "push";
  push.loads = {{{"a.2", {}}, 0, 1000}};
  push.control_node = Reference{"a.2", {}};
  push.options.control = "displacement";
  push.options.targets = {0.2};
  push.options.steps = 40;
  d.stages = {push};
  const Model model = build(d);
  Simulation simulation(model, {});
  const Summary summary = simulation.run({});
  REQUIRE_MESSAGE(summary.completed, summary.stop_reason);
  // H h = 4 Mp with hinges at both ends of both columns; V span = H h - 2 Mp pulls at one and presses on the other
  const double full = fy * width * depth * depth / 4, axial = 2 * full / span / (fy * width * depth);
  const double limit = 4 * full * (1 - axial * axial) / height;
  const auto& points = summary.stages[0].points;
  const double reached = 1000 * points.back().load_factor;
  CHECK(reached < limit * (1 + 4e-3));
  CHECK(reached > limit * (1 - 4e-3));  // hardening adds 2e-3 and the elastic core takes 1e-3 at 5 % drift
  CHECK(1000 * points[20].load_factor > 0.99 * reached);
  CHECK(summary.stages[0].halved == 0);
}
