// Released ends against the second route to a hinge: a further node at the same place that follows in all directions
// but the released ones.
#include <doctest/doctest.h>

#include "integrators/simulation.hpp"
#include "tests/support/small_models.hpp"

using namespace nsframe;
using namespace nsframe::test;

namespace {

constexpr double length = 4;  // [m]

SectionDescription fibers() {
  FiberSectionDescription section;
  for (int i = 0; i < 8; ++i) {
    for (int j = 0; j < 4; ++j) section.fibers.push_back({0.03 * (i - 3.5), 0.03 * (j - 1.5), 6e-4, {"steel", {}}});
  }
  section.torsion_stiffness = 8e5;
  return {"s", {}, section, {}};
}

// Two beams in line between clamps, with a load on the first that makes it yield and one at the joint; a hinge about
// both axes at the joint's end of the first beam, by a release or by a node of its own.
ModelDescription two_beams(ElementKind kind, bool by_release, const MemberMass& mass) {
  ModelDescription d;
  d.materials.push_back({"steel", {}, Steel02{235e6, 210e9, 0.01}});
  d.sections = {fibers()};
  StructureDescription s;
  s.name = "a";
  s.nodes = {node("1", 0, 0, 0), node("2", length, 0, 0), node("3", 2 * length, 0, 0)};
  s.supports = {fixed("1"), fixed("3")};
  s.elements = {beam("e1", "1", "2", "s", kind), beam("e2", "2", "3", "s", kind)};
  for (ElementDescription& e : s.elements) e.mass = mass;
  if (by_release) {
    s.elements[0].releases.basic = {false, false, true, false, true, false};
  } else {
    s.nodes.push_back(node("hinge", length, 0, 0));
    s.elements[0].node_j.name = "hinge";
    s.constraints = {constraint(ConstraintKind::equal_dof, "2", {"hinge"})};
    s.constraints[0].dofs = {true, true, true, true, false, false};
  }
  LoadDescription load;
  load.elements = {{"e1", {}}};
  load.uniform = Vector3(0, 9e3, -30e3);
  load.force = Vector3(0, 0, -8e3);
  load.position = 0.25;
  s.loads = {load};
  s.masses = {::nsframe::test::mass("2", 500)};
  d.gravity.acceleration = Vector3(0, 0, -9.81);
  d.structures = {s};
  return d;
}

struct Answer {
  Vector6 joint;
  std::vector<double> frequencies;
};

Answer answer(const ModelDescription& d) {
  const Model model = build(d);
  AnalysisOptions options;
  options.scheme = "moreau-jean";
  options.duration = 1;
  Simulation simulation(model, options, 4);
  Answer out;
  out.joint = model.dofs.expand(simulation.state().displacement).segment<6>(full_dof(model, "a.2", 0));
  for (const double w : simulation.modes().front().modes.circular_frequency) out.frequencies.push_back(w);
  return out;
}

}  // namespace

TEST_CASE("a released end is a hinge made with a node of its own, in every kind of member, yielding, with its mass") {
  for (const ElementKind kind : {ElementKind::elastic_beam, ElementKind::displacement_beam, ElementKind::force_beam}) {
    for (const MemberMass& mass : {MemberMass{}, MemberMass{150, 0, false, false}}) {
      CAPTURE(static_cast<int>(kind));
      CAPTURE(mass.per_length);
      const Answer released = answer(two_beams(kind, true, mass)), noded = answer(two_beams(kind, false, mass));
      CHECK((released.joint - noded.joint).cwiseAbs().maxCoeff() < 1e-9 * noded.joint.cwiseAbs().maxCoeff());
      REQUIRE(released.frequencies.size() >= 3);
      for (std::size_t i = 0; i < 3; ++i)
        CHECK(released.frequencies[i] == doctest::Approx(noded.frequencies[i]).epsilon(1e-8));
    }
  }
}

TEST_CASE("a release that makes a mechanism is an error that names the structure, the node and the direction") {
  ModelDescription d = two_beams(ElementKind::elastic_beam, true, {});
  StructureDescription& s = d.structures.front();
  s.supports.pop_back();  // e2 hangs on the hinge alone
  s.at = at(3);
  AnalysisOptions options;
  options.scheme = "moreau-jean";
  options.duration = 1;
  const Model model = build(d);
  CHECK_THROWS_WITH_AS(Simulation(model, options), doctest::Contains("structure 'a' is unstable: node 'a."),
                       InputError);
}
