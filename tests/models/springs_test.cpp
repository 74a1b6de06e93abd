// Springs with local axes, and links between nodes apart against the same made of rigid arms and a spring of no length.
#include <doctest/doctest.h>

#include "integrators/static_analysis.hpp"
#include "tests/support/reference_data.hpp"
#include "tests/support/small_models.hpp"

using namespace nsframe;
using namespace nsframe::test;

namespace {

Vector6 displacement(const ModelDescription& d, const std::string& node, const Vector6& force) {
  const Model model = build(d);
  System system(model, 1);
  State state = virgin_state(system);
  VectorX load = VectorX::Zero(model.dofs.full);
  load.segment<6>(full_dof(model, node, 0)) = force;
  solve_static(system, model.dofs.transformation_transposed * load, StaticOptions{}, state);
  return model.dofs.expand(state.displacement).segment<6>(full_dof(model, node, 0));
}

const Vector3 start(0.5, -0.2, 1), end(1.1, 0.9, 2.4);
const Vector3 in_plane(0.2, 0.3, 1);
Vector6 stiffness() { return (Vector6() << 4e6, 2e6, 3e6, 5e5, 6e5, 7e5).finished(); }

ModelDescription two_nodes() {
  ModelDescription d;
  StructureDescription s;
  s.name = "a";
  s.nodes = {node("1", start.x(), start.y(), start.z()), node("2", end.x(), end.y(), end.z())};
  s.supports = {fixed("1")};
  d.structures = {s};
  return d;
}

ModelDescription linked(const Vector2& shear_distance) {
  ModelDescription d = two_nodes();
  SpringDescription link = ground_spring("l", "1", stiffness());
  link.node_j = Reference{"2", {}};
  link.shear_distance = shear_distance;
  link.in_plane = in_plane;
  link.law[1] = Reference{"yielding", {}};
  d.materials = {{"yielding", {}, Steel01{800, 2e6, 0.05}}};
  d.structures[0].springs = {link};
  return d;
}

// Rigid arms from both nodes to one place, and a spring of no length there with the same local axes.
ModelDescription with_arms(double part) {
  ModelDescription d = linked(Vector2::Constant(part));
  StructureDescription& s = d.structures[0];
  const Vector3 at = start + part * (end - start);
  for (const char* id : {"i", "j"}) s.nodes.push_back(node(id, at.x(), at.y(), at.z()));
  s.constraints = {constraint(ConstraintKind::rigid_body, "1", {"i"}),
                   constraint(ConstraintKind::rigid_body, "2", {"j"})};
  SpringDescription& spring = s.springs[0];
  spring.node_i.name = "i";
  spring.node_j->name = "j";
  spring.shear_distance.reset();
  spring.x = end - start;
  return d;
}

}  // namespace

TEST_CASE("a link is rigid arms and a spring of no length where they meet, with stiffnesses and a yielding law") {
  const Vector6 force = (Vector6() << 900, -700, 400, 300, -500, 200).finished();
  for (const double part : {0.0, 0.3, 0.5, 1.0}) {
    CAPTURE(part);
    const Vector6 link = displacement(linked(Vector2::Constant(part)), "a.2", force);
    const Vector6 arms = displacement(with_arms(part), "a.2", force);
    CHECK((link - arms).cwiseAbs().maxCoeff() < 1e-9 * arms.cwiseAbs().maxCoeff());
  }
}

TEST_CASE("the places of a link's two shear springs are apart: a couple bends it about each axis by its own arm") {
  const double L = (end - start).norm();
  ModelDescription d = linked(Vector2(0.25, 0.75));
  d.structures[0].springs[0].law = {};
  const Vector3 x = (end - start) / L, z = x.cross(in_plane).normalized(), y = z.cross(x);
  const auto flexibility = [&](const Vector3& direction) {  // of a force at node 2 along a local direction
    return displacement(d, "a.2", (Vector6() << direction, Vector3::Zero()).finished()).head<3>().dot(direction);
  };
  const Vector6 k = stiffness();
  CHECK(flexibility(y) == doctest::Approx(1 / k[1] + std::pow(0.75 * L, 2) / k[5]).epsilon(1e-9));
  CHECK(flexibility(z) == doctest::Approx(1 / k[2] + std::pow(0.25 * L, 2) / k[4]).epsilon(1e-9));
  CHECK(flexibility(x) == doctest::Approx(1 / k[0]).epsilon(1e-9));
}

TEST_CASE("a spring to the ground acts along its own axes") {
  ModelDescription d = two_nodes();
  StructureDescription& s = d.structures[0];
  s.nodes.pop_back();
  s.supports.clear();
  SpringDescription spring = ground_spring("k", "1", stiffness());
  spring.x = Vector3(1, 1, 0);
  spring.in_plane = Vector3(0, 0, 2);
  s.springs = {spring};
  const Vector3 x = Vector3(1, 1, 0).normalized(), y = Vector3::UnitZ(), z = x.cross(y);
  const Vector6 u = displacement(d, "a.1", (Vector6() << 4e3 * x + 2e3 * y + 3e3 * z, 5e2 * z).finished());
  CHECK((u.head<3>() - 1e-3 * (x + y + z)).norm() < 1e-12);
  CHECK((u.tail<3>() - 5e2 / 7e5 * z).norm() < 1e-12);
}

TEST_CASE("a law sees a node that goes down on the ground in compression, as on a node that is held") {
  const UniaxialLaw laws[] = {ENT{1e6}, Concrete02{-30e3, -0.02, -6e3, -0.1, 0.1, 3e3, 1e6}};
  for (const UniaxialLaw& law : laws) {
    ModelDescription d = two_nodes();
    StructureDescription& s = d.structures[0];
    s.nodes[1].position = start;
    d.materials = {{"law", {}, law}};
    SpringDescription spring = ground_spring("k", "2", stiffness());
    spring.law[2] = Reference{"law", {}};
    s.springs = {spring};
    const Vector6 force = (Vector6() << 1e3, 2e3, -5e3, 0, 0, 0).finished(), on_ground = displacement(d, "a.2", force);
    s.springs[0].node_i.name = "1";
    s.springs[0].node_j = Reference{"2", {}};
    const Vector6 on_node = displacement(d, "a.2", force);
    CHECK((on_ground - on_node).norm() < 1e-14);
    CHECK(on_ground[2] < -1e-3);
    if (std::holds_alternative<ENT>(law)) CHECK(on_ground[2] == doctest::Approx(-5e-3).epsilon(1e-12));
  }
}

TEST_CASE("P-Delta moments of a link are those of OpenSees' twoNodeLink for all ratios") {
  for (const auto& row : read_reference("pdelta_link")) {
    ModelDescription d = two_nodes();
    StructureDescription& s = d.structures[0];
    s.nodes = {node("1", 0, 0, 0), node("2", 0, 0, 2.4)};
    SpringDescription link = ground_spring("l", "1", (Vector6() << 8e6, 90e3, 60e3, 40e3, 70e3, 110e3).finished());
    link.node_j = Reference{"2", {}};
    link.shear_distance = Vector2(0.5, 0.5);
    link.in_plane = Vector3::UnitX();
    link.p_delta = {row[0], row[1], row[2], row[3]};
    s.springs = {link};
    const Vector6 u = displacement(d, "a.2", (Vector6() << 3e3, 2e3, -30e3, 400, -300, 200).finished());
    for (int i = 0; i < 6; ++i) CHECK(std::abs(u[i] - row[static_cast<std::size_t>(4 + i)]) < 1e-9 * 0.1);
  }
}

TEST_CASE("springs without axes and links of no length are errors") {
  ModelDescription d = two_nodes();
  SpringDescription spring = ground_spring("k", "2", stiffness());
  spring.at = at(4);
  spring.in_plane = Vector3::UnitX();
  d.structures[0].springs = {spring};
  CHECK(error_of(d) == "s.toml:4:3: error: spring 'a.k': the vector in the x-y plane is parallel to x");
  d = linked(Vector2(0.5, 0.5));
  d.structures[0].nodes[1].position = start;
  d.structures[0].springs[0].at = at(4);
  CHECK(error_of(d) == "s.toml:4:3: error: spring 'a.l': zero length");
  d.structures[0].springs[0].node_j.reset();
  CHECK(error_of(d).find("s.toml:4:3: error: link 'a.l' needs two nodes") != std::string::npos);
}
