// Reinforced-concrete cantilever (Concrete02 cover and core, Steel02 bars) under axial force, P-Delta and growing
// cycles of its tip against OpenSees, fiber by fiber the same model (tests/reference/README.md tells the origin).
#include <doctest/doctest.h>

#include "integrators/static_analysis.hpp"
#include "models/model.hpp"
#include "tests/support/reference_data.hpp"
#include "tests/support/displacement_control.hpp"

using namespace nsframe;
using namespace nsframe::test;

namespace {

FiberSectionDescription reinforced_section() {
  FiberSectionDescription section;
  const auto add = [&section](double y, double area, const char* material) {
    section.fibers.push_back({y, 0, area, {material, {}}});
  };
  for (int i = 0; i < 12; ++i) {
    const double y = -0.12 + (i + 0.5) * 0.02;
    add(y, 0.24 * 0.02, "core");
    add(y, 0.06 * 0.02, "cover");
  }
  for (const double side : {1.0, -1.0}) {
    for (int i = 0; i < 2; ++i) add(side * (0.12 + (i + 0.5) * 0.015), 0.30 * 0.015, "cover");
  }
  const double bar = 2.01e-4;  // [m2]
  add(-0.12, 4 * bar, "bars");
  add(0, 2 * bar, "bars");
  add(0.12, 4 * bar, "bars");
  section.torsion_stiffness = 1e7;  // held in the plane
  return section;
}

ModelDescription reinforced_cantilever() {
  ModelDescription d;
  d.materials.push_back({"cover", {}, Concrete02{-30e6, -0.002, -6e6, -0.006, 0.1, 2.5e6, 2.5e9}});
  d.materials.push_back({"core", {}, Concrete02{-36e6, -0.0034, -18e6, -0.02, 0.1, 2.5e6, 2.5e9}});
  d.materials.push_back({"bars", {}, Steel02{500e6, 200e9, 0.01, 18.0, 0.925, 0.15}});
  SectionDescription section;
  section.name = "column";
  section.kind = reinforced_section();
  d.sections.push_back(section);
  StructureDescription s;
  s.name = "column";
  s.nodes = {{"base", {}, Vector3::Zero()}, {"tip", {}, Vector3(0, 0, 2.5)}};
  s.supports.push_back({{"base", {}}, {true, true, true, true, true, true}});
  s.supports.push_back({{"tip", {}}, {false, true, false, true, false, true}});
  ElementDescription e;
  e.id = "column";
  e.kind = ElementKind::displacement_beam;
  e.node_i = {"base", {}};
  e.node_j = {"tip", {}};
  e.section = {"column", {}};
  e.geometry = Geometry::p_delta;
  s.elements.push_back(e);
  d.structures.push_back(s);
  return d;
}

}  // namespace

TEST_CASE("cyclic pushover of a reinforced-concrete cantilever equals OpenSees'") {
  Diagnostics diagnostics;
  const Model model = build_model(reinforced_cantilever(), diagnostics);
  System system(model, 1);
  REQUIRE(model.dofs.size() == 3);
  const VectorX axial = -400e3 * VectorX::Unit(3, 1);
  State state = virgin_state(system);
  for (int i = 1; i <= 10; ++i) solve_static(system, 0.1 * i * axial, StaticOptions{}, state);
  DisplacementControl control(system, axial, 0);
  const Table reference = read_reference("rc_cantilever_disp");
  REQUIRE(reference.size() == 1121);
  Vector3 peak = Vector3::Zero(), error = Vector3::Zero();  // force, shortening, rotation
  for (const auto& row : reference) {
    if (&row != &reference.front()) control.reach(row[0], state);
    const Vector3 expected(row[1], row[2], -row[3]);  // a tip that moves to +x turns about +y
    const Vector3 found(control.factor, state.displacement[1], state.displacement[2]);
    peak = peak.cwiseMax(expected.cwiseAbs());
    error = error.cwiseMax((found - expected).cwiseAbs());
  }
  CHECK(error[0] < 1e-6 * peak[0]);
  CHECK(error[1] < 1e-6 * peak[1]);
  CHECK(error[2] < 1e-6 * peak[2]);
}
