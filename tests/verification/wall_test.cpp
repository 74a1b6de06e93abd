// A wall as a wide column: a column in its axis, rigid links at floor level to its edges, beams from there.
#include <doctest/doctest.h>

#include "integrators/static_analysis.hpp"
#include "tests/support/small_models.hpp"

using namespace nsframe;
using namespace nsframe::test;

TEST_CASE("a beam from the edge of a wide column restrains the wall's rotation by EI/L (4 + 12 a/L + 12 a^2/L^2)") {
  const double arm = 1.5, span = 4, height = 3, E = 30e9, G = 12.5e9;  // from the axis to the edge, clear span, story
  const ElasticSection wall{E, G, 0.6, 0.45, 2e-3, 8e-3}, coupling{E, G, 0.12, 1.6e-3, 9e-4, 1.9e-3};
  ModelDescription d;
  d.sections = {elastic_section("wall", wall), elastic_section("beam", coupling)};
  StructureDescription s;
  s.name = "a";
  s.nodes = {node("foot", 0, 0, 0), node("axis", 0, 0, height), node("edge", arm, 0, height),
             node("far", arm + span, 0, height)};
  s.supports = {fixed("foot"), fixed("far")};
  s.elements = {beam("wall", "foot", "axis", "wall"), beam("beam", "edge", "far", "beam")};
  s.constraints = {constraint(ConstraintKind::rigid_body, "axis", {"edge"})};
  d.structures = {s};
  const Model model = build(d);
  const Assembler assembler(model);
  const MatrixX K = assembler.tangent();
  REQUIRE(K.rows() == 6);  // of the wall's axis
  const double EI = E * coupling.Iz, ratio = arm / span;
  // local y of the wall is global x: it bends about y with Iz
  const double own = 4 * E * wall.Iz / height, restraint = EI / span * (4 + 12 * ratio + 12 * ratio * ratio);
  CHECK(K(4, 4) == doctest::Approx(own + restraint).epsilon(1e-12));
}
