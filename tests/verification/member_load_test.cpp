// Frames with loads on their members against OpenSees' eleLoad: a portal under uniform and point loads, which yields,
// then pushed sideways (tests/reference/README.md).
#include <doctest/doctest.h>

#include "tests/support/displacement_control.hpp"
#include "tests/support/reference_data.hpp"
#include "tests/support/small_models.hpp"

using namespace nsframe;
using namespace nsframe::test;

namespace {

constexpr double E = 210e9, G = E / 2.6, J = 8.13e-8;

LoadDescription on(const std::string& element, const Vector3& uniform, const Vector3& force = Vector3::Zero(),
                   double position = 0.5) {
  LoadDescription load;
  load.elements = {{element, {}}};
  load.local = true;
  load.uniform = uniform;
  load.force = force;
  load.position = position;
  return load;
}

// HEA140 portal of 5 m x 3 m in the x-z plane; `axial`: with the parts of the loads along the members.
ModelDescription portal(ElementKind kind, Geometry geometry, bool axial) {
  ModelDescription d;
  d.materials.push_back({"steel", {}, Steel02{235e6, E, 0.01, 20.0, 0.925, 0.15}});
  FiberSectionDescription section;
  for (const auto& row : read_reference("hea140_fibers"))
    section.fibers.push_back({row[0], row[1], row[2], {"steel", {}}});
  section.torsion_stiffness = G * J;
  d.sections.push_back({"HEA140", {}, section, {}});
  StructureDescription s;
  s.name = "portal";
  s.nodes = {node("1", 0, 0, 0), node("2", 0, 0, 3), node("3", 5, 0, 3), node("4", 5, 0, 0)};
  s.supports = {fixed("1"), fixed("4")};
  for (const char* top : {"2", "3"}) s.supports.push_back(fixed(top, {false, true, false, true, false, true}));
  s.elements = {beam("left", "1", "2", "HEA140", kind), beam("beam", "2", "3", "HEA140", kind),
                beam("right", "4", "3", "HEA140", kind)};
  for (ElementDescription& e : s.elements) e.geometry = geometry;
  const double part = axial ? 1 : 0;
  s.loads = {on("beam", Vector3(part * 2e3, -12e3, 0), Vector3(part * 3e3, -20e3, 0), 0.4),
             on("left", Vector3(-part * 1e3, 1.5e3, 0))};
  d.structures = {s};
  return d;
}

// Forces of the nodes on the ends of an element, global axes.
Vector12 end_forces(const Model& model, const State& state, const std::string& id) {
  for (std::size_t g = 0; g < model.groups.size(); ++g) {
    const ElementGroup& group = *model.groups[g];
    for (int e = 0; e < group.size(); ++e) {
      if (group.id(e) != id) continue;
      const VectorX u = model.dofs.expand(state.displacement);
      Vector12 ends, force;
      ends << u.segment<6>(6 * group.nodes(e)[0]), u.segment<6>(6 * group.nodes(e)[1]);
      const double* const committed = state.history.data() + model.history_begin[g] + group.history_begin(e);
      VectorX trial(state.history.size() + 1);
      group.start_step(e, committed, trial.data());
      group.respond(e, ends, committed, trial.data(), force, nullptr);
      return force;
    }
  }
  return Vector12::Zero();
}

void compare(const std::string& file, ElementKind kind, Geometry geometry) {
  CAPTURE(file);
  const Model model = build(portal(kind, geometry, geometry == Geometry::linear));
  System system(model, 1);
  State state = virgin_state(system);
  solve_static(system, model.gravity_load, StaticOptions{}, state);
  DisplacementControl control(system, model.gravity_load, 0);
  const Table reference = read_reference(file);
  VectorX peak = VectorX::Zero(14), error = VectorX::Zero(14);
  for (const auto& row : reference) {
    if (&row != &reference.front()) control.reach(row[0], state);
    const VectorX& q = state.displacement;  // ux, uz, ry of nodes 2 and 3
    const Vector12 beam = end_forces(model, state, "portal.beam"), left = end_forces(model, state, "portal.left");
    VectorX found(14);
    found << q[0], control.factor, q[1], q[2], q[5], beam[0], beam[2], beam[4], beam[6], beam[8], beam[10], left[0],
        left[2], left[4];
    const auto expected = Eigen::Map<const VectorX>(row.data(), 14);
    peak = peak.cwiseMax(expected.cwiseAbs());
    error = error.cwiseMax((found - expected).cwiseAbs());
  }
  for (int k = 0; k < 14; ++k) {
    CAPTURE(k);
    CHECK(error[k] < 1e-6 * peak[k]);
  }
}

}  // namespace

TEST_CASE("a portal under loads on its members, then pushed, is OpenSees' with eleLoad: elastic") {
  compare("loaded_portal_elastic_linear", ElementKind::elastic_beam, Geometry::linear);
}
TEST_CASE("a portal under loads on its members, then pushed, is OpenSees' with eleLoad: displacement-based") {
  compare("loaded_portal_disp_linear", ElementKind::displacement_beam, Geometry::linear);
}
TEST_CASE("a portal under loads on its members, then pushed, is OpenSees' with eleLoad: force-based, also P-Delta") {
  compare("loaded_portal_force_linear", ElementKind::force_beam, Geometry::linear);
  compare("loaded_portal_force_pdelta", ElementKind::force_beam, Geometry::p_delta);
}
