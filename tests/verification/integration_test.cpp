// Fiber members with other integration rules than Gauss-Lobatto against OpenSees' beamIntegration: cyclic pushovers of
// an HEA140 cantilever with plastic hinges, and with sections that differ along it (tests/reference/README.md).
#include <doctest/doctest.h>

#include "tests/support/displacement_control.hpp"
#include "tests/support/reference_data.hpp"
#include "tests/support/small_models.hpp"

using namespace nsframe;
using namespace nsframe::test;

namespace {

constexpr double column_E = 210e9, column_G = column_E / 2.6, column_J = 8.13e-8;

// Sections "whole" and "weak" (each fiber has half its area), and "elastic" with the constants of the fibers.
std::vector<SectionDescription> hea140_sections() {
  FiberSectionDescription whole;
  ElasticSection constants{column_E, column_G, 0, 0, 0, column_J};
  for (const auto& row : read_reference("hea140_fibers")) {
    whole.fibers.push_back({row[0], row[1], row[2], {"steel", {}}});
    constants.A += row[2];
    constants.Iz += row[2] * row[0] * row[0];
    constants.Iy += row[2] * row[1] * row[1];
  }
  whole.torsion_stiffness = column_G * column_J;
  FiberSectionDescription weak = whole;
  for (FiberDescription& fiber : weak.fibers) fiber.area /= 2;
  return {{"whole", {}, whole, {}}, {"weak", {}, weak, {}}, elastic_section("elastic", constants)};
}

void compare(const std::string& file, ElementKind kind, const Integration& integration, int points,
             const std::vector<std::string>& sections) {
  CAPTURE(file);
  ModelDescription d;
  d.materials.push_back({"steel", {}, Steel02{235e6, column_E, 0.01, 20.0, 0.925, 0.15}});
  d.sections = hea140_sections();
  StructureDescription s;
  s.name = "column";
  s.nodes = {node("1", 0, 0, 0), node("2", 0, 0, 2.5)};
  s.supports = {fixed("1"), fixed("2", {false, true, false, true, false, true})};
  ElementDescription e = beam("e", "1", "2", "whole", kind);
  e.points = points;
  e.integration = integration;
  for (const std::string& section : sections) e.sections.push_back({section, {}});
  s.elements = {e};
  d.structures = {s};
  const Model model = build(d);
  System system(model, 1);
  const VectorX axial = -200e3 * VectorX::Unit(3, 1);  // free DOFs: ux, uz, ry of the tip
  State state = virgin_state(system);
  for (int i = 1; i <= 10; ++i) solve_static(system, 0.1 * i * axial, StaticOptions{}, state);
  DisplacementControl control(system, axial, 0);
  Vector3 peak = Vector3::Zero(), error = Vector3::Zero();
  const Table reference = read_reference(file);
  for (const auto& row : reference) {
    if (&row != &reference.front()) control.reach(row[0], state);
    const Vector3 expected(row[1], row[2], row[3]), found(control.factor, state.displacement[1], state.displacement[2]);
    peak = peak.cwiseMax(expected.cwiseAbs());
    error = error.cwiseMax((found - expected).cwiseAbs());
  }
  for (int k = 0; k < 3; ++k) {
    CAPTURE(k);
    CHECK(error[k] < 1e-6 * peak[k]);
  }
}

}  // namespace

TEST_CASE("pushovers with modified Gauss-Radau hinges equal OpenSees' HingeRadau, elastic and fiber interior") {
  const Integration hinges{"hinge-radau", 0.3, 0.2, {}, {}};
  compare("integration_force_hinge", ElementKind::force_beam, hinges, 5, {"whole", "elastic", "weak"});
  compare("integration_force_hingefiber", ElementKind::force_beam, hinges, 5, {"whole", "whole", "weak"});
}

TEST_CASE("pushovers with Legendre, Radau and the user's points equal OpenSees'") {
  const Integration user{"user", 0, 0, {0, 0.2, 0.6, 1}, {0.1, 0.35, 0.4, 0.15}};
  const std::vector<std::string> along{"whole", "whole", "elastic", "weak"};
  compare("integration_force_legendre", ElementKind::force_beam, {"legendre", 0, 0, {}, {}}, 4, {});
  compare("integration_force_radau", ElementKind::force_beam, {"radau", 0, 0, {}, {}}, 4, {});
  compare("integration_force_user", ElementKind::force_beam, user, 5, along);
  compare("integration_disp_legendre", ElementKind::displacement_beam, {"legendre", 0, 0, {}, {}}, 4, {});
  compare("integration_disp_user", ElementKind::displacement_beam, user, 5, along);
}
