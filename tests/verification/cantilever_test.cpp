// HEA140 cantilever under axial force and cyclic tip displacement against OpenSees, element by element and fiber by
// fiber the same model (tests/reference/README.md tells the origin of the numbers).
#include <doctest/doctest.h>

#include "integrators/static_analysis.hpp"
#include "integrators/static_stage.hpp"
#include "models/model.hpp"
#include "tests/support/reference_data.hpp"

using namespace nsframe;
using namespace nsframe::test;

namespace {

constexpr double height = 2.5;  // [m]

ModelDescription cantilever(ElementKind kind, const UniaxialLaw& law, Geometry geometry, int elements) {
  ModelDescription d;
  d.materials.push_back({"steel", {}, law});
  FiberSectionDescription section;
  for (const auto& row : read_reference("hea140_fibers")) section.fibers.push_back({row[0], row[1], row[2], {"steel", {}}});
  section.torsion_stiffness = 210e9 / 2.6 * 8.13e-8;
  SectionDescription hea140;
  hea140.name = "HEA140";
  hea140.kind = section;
  d.sections.push_back(hea140);
  StructureDescription s;
  s.name = "column";
  for (int i = 0; i <= elements; ++i) s.nodes.push_back({std::to_string(i), {}, Vector3(0, 0, height * i / elements)});
  s.supports.push_back({{"0", {}}, {true, true, true, true, true, true}});
  // in the plane: under P-Delta the yielding column would leave it by weak-axis buckling, triggered by rounding
  for (int i = 1; i <= elements; ++i) s.supports.push_back({{std::to_string(i), {}}, {false, true, false, true, false, true}});
  for (int i = 0; i < elements; ++i) {
    ElementDescription e;
    e.id = "e" + std::to_string(i);
    e.kind = kind;
    e.node_i = {std::to_string(i), {}};
    e.node_j = {std::to_string(i + 1), {}};
    e.section = {"HEA140", {}};
    e.geometry = geometry;
    s.elements.push_back(e);
  }
  d.structures.push_back(s);
  return d;
}

// A pushover by the program's own displacement control through the displacements of the reference.
class Pushover : public StageObserver {
 public:
  void point(const StagePoint& point, const State& state) override {
    factors.push_back(point.load_factor);
    states.push_back(state.displacement);
  }
  std::vector<double> factors;
  std::vector<VectorX> states;
};

void compare(const std::string& kind_name, ElementKind kind, int elements, const std::string& law_name, const UniaxialLaw& law,
             Geometry geometry, const std::string& algorithm = "newton") {
  const std::string file = "cantilever_" + kind_name + std::to_string(elements) + "_" + law_name +
                           (geometry == Geometry::linear ? "_linear" : "_pdelta");
  CAPTURE(file);
  Diagnostics diagnostics;
  const Model model = build_model(cantilever(kind, law, geometry, elements), diagnostics);
  System system(model, 1);
  const int tip = model.dofs.size() - 3;  // ux of the last node
  const VectorX axial = -200e3 * VectorX::Unit(model.dofs.size(), tip + 1);
  State state = virgin_state(system);
  for (int i = 1; i <= 10; ++i) solve_static(system, 0.1 * i * axial, StaticOptions{}, state);
  system.static_load = axial;
  const Table reference = read_reference(file);
  StaticStage stage;
  stage.name = "cycles";
  stage.pattern = stage.control_row = VectorX::Unit(model.dofs.size(), tip);
  stage.options.control = "displacement";
  stage.options.steps = 1;
  stage.options.max_iterations = 100;  // Newton alone takes some sixty where eight elements yield at once
  for (std::size_t i = 1; i < reference.size(); ++i) stage.options.targets.push_back(reference[i][0]);
  Pushover pushover;
  const StageResult result = run_stage(system, stage, {{algorithm}, {&pushover}, {}}, state);
  REQUIRE_MESSAGE(result.completed, result.stop_reason);
  REQUIRE(result.points.size() == reference.size());
  double peak_force = 0, peak_sag = 0, force_error = 0, sag_error = 0;
  for (std::size_t i = 0; i < reference.size(); ++i) {
    peak_force = std::max(peak_force, std::abs(reference[i][1]));
    peak_sag = std::max(peak_sag, std::abs(reference[i][2]));
    force_error = std::max(force_error, std::abs(pushover.factors[i] - reference[i][1]));
    sag_error = std::max(sag_error, std::abs(pushover.states[i][tip + 1] - reference[i][2]));
  }
  CHECK(force_error < 1e-6 * peak_force);
  CHECK(sag_error < 1e-6 * peak_sag);
}

void compare_all(Geometry geometry) {
  const Steel01 steel01{235e6, 210e9, 0.01};
  const Steel02 steel02{235e6, 210e9, 0.01, 20.0, 0.925, 0.15};
  for (const int elements : {1, 8}) {
    compare("disp", ElementKind::displacement_beam, elements, "steel01", steel01, geometry);
    compare("disp", ElementKind::displacement_beam, elements, "steel02", steel02, geometry);
  }
  compare("force", ElementKind::force_beam, 1, "steel01", steel01, geometry);
  compare("force", ElementKind::force_beam, 1, "steel02", steel02, geometry);
}

}  // namespace

TEST_CASE("cyclic pushovers of a fiber cantilever equal OpenSees', linear geometry") { compare_all(Geometry::linear); }
TEST_CASE("cyclic pushovers of a fiber cantilever equal OpenSees', P-Delta") { compare_all(Geometry::p_delta); }

TEST_CASE("a column of eight yielding elements, where Newton takes sixty iterations, by line search and by Krylov acceleration") {
  const Steel02 steel02{235e6, 210e9, 0.01, 20.0, 0.925, 0.15};
  for (const std::string algorithm : {"line-search", "krylov"}) {
    CAPTURE(algorithm);
    compare("disp", ElementKind::displacement_beam, 8, "steel02", steel02, Geometry::linear, algorithm);
  }
}
