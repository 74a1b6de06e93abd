// Rigid end offsets of a column and a beam in space against OpenSees' -jntOffset, and against rigid links. OpenSees 3.7.1
// leaves offsets out of its Corotational transformation (with a warning), so there the second route is another one.
#include <doctest/doctest.h>

#include "integrators/static_analysis.hpp"
#include "tests/support/small_models.hpp"

using namespace nsframe;
using namespace nsframe::test;

namespace {

const ElasticSection section{210e9, 81e9, 3e-3, 1e-5, 4e-6, 8e-6};
const std::array<Vector3, 2> column_offset{Vector3(0.05, 0.02, 0.3), Vector3(-0.1, 0.04, -0.25)};
const std::array<Vector3, 2> beam_offset{Vector3(0.2, -0.03, 0.05), Vector3(-0.15, 0.02, 0.06)};

ModelDescription bent(Geometry geometry) {
  ModelDescription d;
  d.sections = {elastic_section("c", section)};
  StructureDescription s;
  s.name = "a";
  s.nodes = {node("1", 0, 0, 0), node("2", 0.2, 0.1, 3), node("3", 2.5, 0.4, 3.2)};
  s.supports = {fixed("1")};
  s.elements = {beam("column", "1", "2", "c"), beam("beam", "2", "3", "c")};
  s.elements[0].orientation = Vector3::UnitY();
  s.elements[1].orientation = Vector3::UnitZ();
  s.elements[0].offset = column_offset;
  s.elements[1].offset = beam_offset;
  for (ElementDescription& e : s.elements) e.geometry = geometry;
  d.structures = {s};
  return d;
}

// Displacements of nodes 2 and 3 under a force at node 3, times `factor`.
Vector12 displaced(const ModelDescription& description, double factor, int steps = 1, const StaticOptions& options = {}) {
  const Model model = build(description);
  System system(model, 1);
  State state = virgin_state(system);
  VectorX load = VectorX::Zero(model.dofs.full);
  load.segment<3>(12) = factor * Vector3(3e3, 5e3, -8e3);
  for (int i = 1; i <= steps; ++i) {
    solve_static(system, double(i) / steps * (model.dofs.transformation_transposed * load), options, state);
  }
  return model.dofs.expand(state.displacement).segment<12>(6);
}

Vector12 values(std::initializer_list<double> list) { return Eigen::Map<const Vector12>(list.begin()); }

}  // namespace

TEST_CASE("a frame with rigid end offsets moves as OpenSees', linear and P-Delta") {
  const Vector12 linear = values({0.0453216581083, 0.0602484990717, -0.00484795732388, -0.0316831103905, 0.0300879354283,
                                  0.0451302061629, 0.0384477771997, 0.177652285654, -0.115046752697, -0.0339111270084,
                                  0.0519775082606, 0.050185645456});
  CHECK((displaced(bent(Geometry::linear), 1) - linear).norm() < 1e-8 * linear.norm());
  const Vector12 p_delta = values({0.0451067751565, 0.0607869960023, -0.00484068490959, -0.0319937322014, 0.0298823342297,
                                   0.043996708207, 0.0385344025943, 0.175439247342, -0.114155560575, -0.0341464251681,
                                   0.0514352488219, 0.0489138106628});
  CHECK((displaced(bent(Geometry::p_delta), 1) - p_delta).norm() < 1e-8 * p_delta.norm());
}

TEST_CASE("rigid end offsets act as rigid links to the member's ends in linear geometry") {
  ModelDescription linked = bent(Geometry::linear);
  StructureDescription& s = linked.structures[0];
  const auto far = [&](const std::string& id, const Vector3& from, const Vector3& arm, const std::string& master) {
    s.nodes.push_back({id, {}, from + arm});
    s.constraints.push_back(constraint(ConstraintKind::rigid_body, master, {id}));
  };
  const Vector3 two(0.2, 0.1, 3), three(2.5, 0.4, 3.2);
  s.nodes.push_back({"1a", {}, column_offset[0]});
  s.supports.push_back(fixed("1a"));
  far("2a", two, column_offset[1], "2");
  far("2b", two, beam_offset[0], "2");
  far("3b", three, beam_offset[1], "3");
  s.elements[0].node_i = {"1a", {}};
  s.elements[0].node_j = {"2a", {}};
  s.elements[1].node_i = {"2b", {}};
  s.elements[1].node_j = {"3b", {}};
  for (ElementDescription& e : s.elements) e.offset = {Vector3::Zero(), Vector3::Zero()};
  s.nodes.erase(s.nodes.begin());  // node 1 holds nothing now
  s.supports.erase(s.supports.begin());
  const Model model = build(linked);
  System system(model, 1);
  State state = virgin_state(system);
  VectorX load = VectorX::Zero(model.dofs.full);
  load.segment<3>(full_dof(model, "a.3", 0)) = Vector3(3e3, 5e3, -8e3);
  solve_static(system, model.dofs.transformation_transposed * load, StaticOptions{}, state);
  const Vector12 with_links = model.dofs.expand(state.displacement).head<12>();
  const Vector12 with_offsets = displaced(bent(Geometry::linear), 1);
  CHECK((with_links - with_offsets).norm() < 1e-9 * with_offsets.norm());  // static tolerance 1e-10
}

TEST_CASE("corotational rigid offsets act as very stiff short members, at large rotations") {
  ModelDescription stiff = bent(Geometry::corotational);
  StructureDescription& s = stiff.structures[0];
  // arms 3000 times stiffer: their share of the sway is below 1e-3, and rounding of their rotations leaves 1e-6 of the load
  stiff.sections.push_back(elastic_section("rigid", {210e11, 81e11, 9e-2, 3e-4, 3e-4, 3e-4}));
  const auto arm = [&](const std::string& id, const std::string& from, const Vector3& start, const Vector3& offset) {
    s.nodes.push_back({id, {}, start + offset});
    ElementDescription e = beam("arm" + id, from, id, "rigid");
    e.geometry = Geometry::corotational;
    s.elements.push_back(e);
  };
  const Vector3 two(0.2, 0.1, 3), three(2.5, 0.4, 3.2);
  arm("1a", "1", Vector3::Zero(), column_offset[0]);
  arm("2a", "2", two, column_offset[1]);
  arm("2b", "2", two, beam_offset[0]);
  arm("3b", "3", three, beam_offset[1]);
  s.elements[0].node_i = {"1a", {}};
  s.elements[0].node_j = {"2a", {}};
  s.elements[1].node_i = {"2b", {}};
  s.elements[1].node_j = {"3b", {}};
  for (int i : {0, 1}) s.elements[static_cast<std::size_t>(i)].offset = {Vector3::Zero(), Vector3::Zero()};
  const Vector12 exact = displaced(bent(Geometry::corotational), 8, 10), with_arms = displaced(stiff, 8, 10, {1e-5, 50, 10});
  CHECK(exact.segment<3>(9).norm() > 0.3);  // rotations in radians
  CHECK((with_arms - exact).norm() < 1e-3 * exact.norm());
}
