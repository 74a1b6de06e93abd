// Reinforced-concrete cantilever (Concrete02 cover and core, Steel02 bars) under axial force, P-Delta and growing
// cycles of its tip, and its section alone, against OpenSees, fiber by fiber the same model (tests/reference/README.md
// tells the origin).
#include "elements/section_analysis.hpp"
#include "integrators/static_analysis.hpp"
#include "models/model.hpp"
#include "tests/support/reference_data.hpp"
#include "tests/support/displacement_control.hpp"
#include "tests/verification/registry.hpp"

using namespace nsframe;
using namespace nsframe::test;

namespace {

const Concrete02 cover{-30e6, -0.002, -6e6, -0.006, 0.1, 2.5e6, 2.5e9}, core{-36e6, -0.0034, -18e6, -0.02, 0.1, 2.5e6, 2.5e9};
const Steel02 bars{500e6, 200e9, 0.01, 18.0, 0.925, 0.15};

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
  d.materials = {{"cover", {}, cover}, {"core", {}, core}, {"bars", {}, bars}};
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

VERIFICATION_CASE("Frames", "Cyclic pushover of a reinforced-concrete cantilever",
                  "30 cm square, 2.5 m, Concrete02 and Steel02, 400 kN along, P-Delta, one displacement-based element; growing cycles of "
                  "the tip. OpenSees 3.7.1 with the same fibers, over the whole history.") {
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
  double largest = 0;                                       // tip force [N]
  for (const auto& row : reference) {
    if (&row != &reference.front()) control.reach(row[0], state);
    const Vector3 expected(row[1], row[2], -row[3]);  // a tip that moves to +x turns about +y
    const Vector3 found(control.factor, state.displacement[1], state.displacement[2]);
    peak = peak.cwiseMax(expected.cwiseAbs());
    largest = std::max(largest, std::abs(found[0]));
    error = error.cwiseMax((found - expected).cwiseAbs());
  }
  rows.add("1 - largest error of the tip force / its peak", 1 - error[0] / peak[0], 1, absolute(1e-6));
  rows.add("1 - largest error of the shortening / its peak", 1 - error[1] / peak[1], 1, absolute(1e-6));
  rows.add("1 - largest error of the tip rotation / its peak", 1 - error[2] / peak[2], 1, absolute(1e-6));
  rows.add("largest tip force, kN", 1e-3 * largest, 1e-3 * peak[0], relative(1e-6));
}

VERIFICATION_CASE("Frames", "Moment and curvature of a reinforced-concrete section",
                  "The section of that cantilever alone under 400 kN; the curvature goes to and fro up to 0.06 1/m. OpenSees 3.7.1 "
                  "(zeroLengthSection) with the same fibers, over the whole history.") {
  const AnalysedSection section =
      analysed_section("column", reinforced_section(), {{"cover", cover}, {"core", core}, {"bars", bars}});
  const MomentCurvature curve =
      moment_curvature(section, {-400e3, 0, {0.01, -0.01, 0.03, -0.03, 0.06, -0.06, 0}, 50, false});
  const Table reference = read_reference("rc_section");
  REQUIRE(curve.states.size() == reference.size());
  double peak = 0, largest = 0, strain_peak = 0, error = 0, strain_error = 0;
  for (std::size_t i = 0; i < reference.size(); ++i) {
    const BendingState& found = curve.states[i];
    peak = std::max(peak, std::abs(reference[i][1]));
    largest = std::max(largest, std::abs(found.moment));
    strain_peak = std::max(strain_peak, std::abs(reference[i][2]));
    error = std::max(error, std::abs(found.moment - reference[i][1]));
    strain_error = std::max(strain_error, std::abs(found.deformation[0] - reference[i][2]));
  }
  rows.add("1 - largest error of the moment / its peak", 1 - error / peak, 1, absolute(1e-9));
  rows.add("1 - largest error of the axial strain / its peak", 1 - strain_error / strain_peak, 1, absolute(1e-9));
  rows.add("largest moment, kN m", 1e-3 * largest, 1e-3 * peak, relative(1e-9));
}
