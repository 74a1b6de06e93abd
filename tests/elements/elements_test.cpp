// Every element: tangent against finite differences, no force under rigid-body motion, committed history unchanged;
// closed forms where there are any.
#include <doctest/doctest.h>

#include <functional>
#include <memory>

#include "elements/displacement_beam.hpp"
#include "elements/elastic_beam.hpp"
#include "elements/force_beam.hpp"
#include "elements/spring.hpp"
#include "elements/truss.hpp"
#include "tests/support/element_probe.hpp"

using namespace nsframe;
using namespace nsframe::test;

namespace {

const Vector3 end_i(0.2, -0.1, 0.3), end_j(1.1, 0.9, 2.4);
const Steel02 bilinear_steel{235e6, 210e9, 0.01};

BeamFrame skew_frame() { return {end_i, end_j, beam_axes(end_i, end_j, Vector3(0.3, 1, 0.1))}; }

std::shared_ptr<const FiberSection> five_by_seven(const UniaxialLaw& law) {
  std::vector<Fiber> fibers;
  for (int i = 0; i < 7; ++i) {
    for (int j = 0; j < 5; ++j) fibers.push_back({0.02 * (i - 3), 0.015 * (j - 2), 3e-4, law});
  }
  return std::make_shared<FiberSection>(fibers, 5e4);
}

FiberMember fiber_member(const BeamFrame& frame, const UniaxialLaw& law = bilinear_steel) {
  return {frame, gauss_lobatto(5), std::vector<std::shared_ptr<const FiberSection>>(5, five_by_seven(law))};
}

MemberLoad some_load() { return {Vector3(300, -900, 400), {{0.3, Vector3(200, 1500, -700)}}}; }
const Releases hinges{{false, true, false, true, true, false}};

struct Sample {
  std::string name;
  std::unique_ptr<ElementGroup> group;
  bool rigid_rotation = true;  // small rigid rotations make no force (P-Delta and pretension: only translations; corotational: corotational_test.cpp)
  bool loaded = false;         // between the ends
};

std::vector<Sample> all_elements() {
  std::vector<Sample> cases;
  const ElementNodes nodes{0, 1};
  const BeamFrame frame = skew_frame();
  const ElasticSection section{210e9, 81e9, 3e-3, 1e-5, 4e-6, 8e-8};
  for (const Geometry geometry : {Geometry::linear, Geometry::p_delta, Geometry::corotational}) {
    const std::string suffix = geometry == Geometry::linear ? "" : geometry == Geometry::p_delta ? ", P-Delta" : ", corotational";
    const bool small = geometry == Geometry::linear;
    auto elastic = std::make_unique<ElasticBeams>(geometry);
    elastic->add(nodes, "e", {frame, section});
    cases.push_back({"elastic" + suffix, std::move(elastic), small});
    auto displacement = std::make_unique<DisplacementBeams>(geometry);
    displacement->add(nodes, "d", fiber_member(frame));
    cases.push_back({"displacement" + suffix, std::move(displacement), small});
    auto force = std::make_unique<ForceBeams>(geometry);
    force->add(nodes, "f", fiber_member(frame));
    cases.push_back({"force" + suffix, std::move(force), small});
    auto truss = std::make_unique<Trusses>(Trusses::Kind::nonlinear, geometry);
    truss->add(nodes, "t", frame, bilinear_steel, 2e-4, 0);
    cases.push_back({"truss" + suffix, std::move(truss), small});
    auto special_elastic = std::make_unique<ElasticBeams>(geometry);
    special_elastic->add(nodes, "le", {frame, {210e9, 81e9, 3e-3, 1e-5, 4e-6, 8e-8, 1e-3, 8e-4}, {}, some_load(), hinges});
    cases.push_back({"elastic with shear, load and releases" + suffix, std::move(special_elastic), small, true});
    FiberMember member = fiber_member(frame);
    member.load = some_load();
    member.releases = hinges;
    auto special_displacement = std::make_unique<DisplacementBeams>(geometry);
    special_displacement->add(nodes, "ld", member);
    cases.push_back({"displacement with load and releases" + suffix, std::move(special_displacement), small, true});
    auto special_force = std::make_unique<ForceBeams>(geometry);
    special_force->add(nodes, "lf", member);
    cases.push_back({"force with load and releases" + suffix, std::move(special_force), small, true});
  }
  auto wrapped = std::make_unique<ForceBeams>(Geometry::linear);
  wrapped->add(nodes, "w", fiber_member(frame, Parallel{{inner(bilinear_steel), inner(InitStrain{inner(ENT{1e9}), 1e-4})}}));
  cases.push_back({"force-based, wrapped", std::move(wrapped), false});
  auto cable = std::make_unique<Trusses>(Trusses::Kind::cable, Geometry::linear);
  cable->add(nodes, "c", frame, Elastic{160e9}, 1e-4, 2e3);
  cases.push_back({"cable", std::move(cable), false});
  SpringProperties properties;
  properties.axes = frame.axes;
  properties.stiffness << 1e6, 2e6, 3e6, 4e4, 5e4, 6e4;
  properties.law[1] = Steel01{3e3, 2e6, 0.02};
  properties.law[2] = Series{{inner(Steel01{2e3, 1e6, 0.05}), inner(Elastic{3e6})}};
  properties.law[4] = MinMax{inner(Elastic{5e4}), -0.1, 0.1};
  auto spring = std::make_unique<Springs>(Springs::Kind{false});
  spring->add(nodes, "s", properties);
  cases.push_back({"spring", std::move(spring), false});
  properties.length = frame.length;
  properties.shear_distance = Vector2(0.3, 0.8);
  auto link = std::make_unique<Springs>(Springs::Kind{false});
  link->add(nodes, "l", properties);
  cases.push_back({"link", std::move(link)});
  properties.p_delta = {0.1, 0.3, 0.25, 0.15};
  auto leaning = std::make_unique<Springs>(Springs::Kind{false, false, true});
  leaning->add(nodes, "p", properties);
  cases.push_back({"link, P-Delta", std::move(leaning), false});
  for (const Geometry geometry : {Geometry::linear, Geometry::p_delta}) {
    const bool small = geometry == Geometry::linear;
    FiberMember member = fiber_member(frame);
    const FiberSection& plain = *member.sections[0];
    std::vector<Fiber> fibers;
    for (int i = 0; i < plain.fibers; ++i) {
      const auto at = static_cast<std::size_t>(i);
      fibers.push_back({plain.y[at], plain.z[at], plain.area[at], bilinear_steel});
    }
    const auto section = [&fibers](const AddedLaws& laws) { return std::make_shared<FiberSection>(fibers, 1e5, laws); };
    const UniaxialLaw shear = Steel01{2e3, 4e6, 0.05}, twist = Steel01{300, 1e5, 0.03};
    for (auto& s : member.sections) s = section(AddedLaws{shear, shear, twist});
    member.sections[1] = section(AddedLaws{std::nullopt, shear, std::nullopt});  // a section rigid in shear along y
    member.load = some_load();
    auto aggregated = std::make_unique<AggregatedForceBeams>(geometry);
    aggregated->add(nodes, "af", member);
    cases.push_back({small ? "force-based with laws of shear and torsion" : "the same, P-Delta", std::move(aggregated), small, true});
    for (auto& s : member.sections) s = section(AddedLaws{std::nullopt, std::nullopt, twist});
    auto twisted = std::make_unique<DisplacementBeams>(geometry);
    twisted->add(nodes, "td", member);
    cases.push_back({small ? "displacement-based with a law of torsion" : "that, P-Delta", std::move(twisted), small, true});
  }
  return cases;
}

// Some translations and rotations that take the sections well beyond yield.
Vector12 large_displacement() {
  Vector12 u;
  u << 1e-3, -2e-3, 5e-4, 8e-3, -1.1e-2, 4e-3, 9e-3, 1.5e-2, -3e-3, -1.2e-2, 7e-3, 1e-2;
  return u;
}

}  // namespace

TEST_CASE("the tangent of every element equals central differences, elastic, yielding and unloading") {
  for (const Sample& c : all_elements()) {
    CAPTURE(c.name);
    ElementProbe probe(*c.group);
    for (const double factor : {0.02, 1.0, 0.8}) {
      CAPTURE(factor);
      const Vector12 u = factor * large_displacement();
      Matrix12 tangent, differences;
      probe.force(u, &tangent);
      for (int i = 0; i < 12; ++i) {
        const double h = 1e-6;  // [m, rad]
        differences.col(i) = (probe.force(u + h * Vector12::Unit(i)) - probe.force(u - h * Vector12::Unit(i))) / (2 * h);
      }
      // a force-based element's sections stop at 1e-4 of the step's change from the state of its tangent
      CHECK((tangent - differences).cwiseAbs().maxCoeff() < 1e-4 * tangent.cwiseAbs().maxCoeff());
      probe.force(u);
      probe.commit();
    }
  }
}

TEST_CASE("rigid-body motion makes no force in any element") {
  for (const Sample& c : all_elements()) {
    CAPTURE(c.name);
    ElementProbe probe(*c.group);
    Matrix12 tangent;
    const Vector12 at_rest = probe.force(Vector12::Zero(), &tangent);
    const double scale = tangent.cwiseAbs().maxCoeff() * 1e-3;
    for (int k = 0; k < (c.rigid_rotation ? 6 : 3); ++k) {
      Vector12 u = Vector12::Zero();
      if (k < 3) {
        u[k] = u[6 + k] = 1e-3;
      } else {
        const Vector3 rotation = 1e-3 * Vector3::Unit(k - 3);
        u.segment<3>(0) = rotation.cross(end_i);
        u.segment<3>(6) = rotation.cross(end_j);
        u.segment<3>(3) = u.segment<3>(9) = rotation;
      }
      CHECK((probe.force(u) - at_rest).cwiseAbs().maxCoeff() < 1e-12 * scale);
    }
  }
}

TEST_CASE("a force-based member remembers that a section softened, and not one that only yields") {
  for (const double b : {0.05, 0.0, -0.02}) {
    CAPTURE(b);
    const Steel01 law{235e6, 210e9, b};
    ForceBeams group(Geometry::linear);
    group.add({0, 1}, "f", fiber_member(skew_frame(), law));
    ElementProbe probe(group);
    const Vector12 turn = 0.3 * (Vector12::Unit(11) - Vector12::Unit(5));  // ends turn against each other
    probe.force(0.001 * turn);
    probe.commit();
    CHECK_FALSE(group.softened(0, probe.committed().data()));
    for (int k = 1; k <= 20; ++k) {
      probe.force(0.05 * k * turn);
      probe.commit();
    }
    CHECK(group.softened(0, probe.committed().data()) == (b < 0));
    probe.force(Vector12::Zero());  // unloaded elastically: it has been so all the same
    probe.commit();
    CHECK(group.softened(0, probe.committed().data()) == (b < 0));
  }
}

TEST_CASE("a force-based member with sections that hardly resist finds its forces in small increments") {
  for (const double b : {3e-5, -3e-5, 1e-7}) {
    CAPTURE(b);
    ForceBeams group(Geometry::linear);
    FiberMember member = fiber_member(skew_frame(), Steel01{235e6, 210e9, b});
    member.releases.basic = {false, false, true, false, true, false};  // so that one end alone yields
    group.add({0, 1}, "f", member);
    ElementProbe probe(group);
    Vector12 direction = Vector12::Zero(), u = Vector12::Zero(), force;
    direction.segment<3>(6) << 1, -0.7, -0.1;  // bends both ways and stretches
    for (int i = 0; i < 100; ++i) {
      u += 2e-3 * direction;
      probe.force(u);
      probe.commit();
    }
    Matrix12 tangent;
    Vector12 before = probe.force(u, &tangent);
    for (const double increment : {1e-5, 1e-6, 1e-7, 1e-8}) {
      CAPTURE(increment);
      for (int i = 0; i < 30; ++i) {
        u += increment * direction;
        REQUIRE_NOTHROW(force = probe.force(u, &tangent));
        CHECK((force - before - increment * (tangent * direction)).norm() < 1e-3 * increment * (tangent * direction).norm() + 1e-10 * force.norm());
        probe.commit();
        before = force;
      }
    }
  }
}

TEST_CASE("responding leaves the committed history as it was, and repeats to the same bits") {
  for (const Sample& c : all_elements()) {
    CAPTURE(c.name);
    ElementProbe probe(*c.group);
    const VectorX before = probe.committed();
    const Vector12 first = probe.force(large_displacement());
    CHECK(probe.committed() == before);
    CHECK(probe.force(large_displacement()) == first);
  }
}

TEST_CASE("element forces are in equilibrium with each other about any point") {
  for (const Sample& c : all_elements()) {
    if (c.loaded || c.name == "spring" || c.name.ends_with("P-Delta") || c.name.ends_with("corotational")) continue;  // zero length; deformed equilibrium
    CAPTURE(c.name);
    ElementProbe probe(*c.group);
    const Vector12 f = probe.force(large_displacement());
    const Vector3 sum = f.segment<3>(0) + f.segment<3>(6);
    const Vector3 moment = f.segment<3>(3) + f.segment<3>(9) + end_i.cross(f.segment<3>(0).eval()) + end_j.cross(f.segment<3>(6).eval());
    CHECK(sum.norm() < 1e-12 * f.norm());
    CHECK(moment.norm() < 1e-11 * f.norm());
  }
}

TEST_CASE("a cantilever of one elastic beam bends by FL^3/3EI and twists by TL/GJ") {
  const double L = 2, F = 1e3;
  const ElasticSection s{210e9, 81e9, 3e-3, 1e-5, 4e-6, 8e-8};
  const BeamFrame frame(Vector3::Zero(), Vector3(L, 0, 0), beam_axes(Vector3::Zero(), Vector3(L, 0, 0), Vector3::UnitZ()));
  ElasticBeams beams(Geometry::linear);
  beams.add({0, 1}, "e", {frame, s});
  Vector12 force;
  Matrix12 k;
  beams.respond(0, Vector12::Zero(), nullptr, nullptr, force, &k);
  const Matrix6 tip = k.bottomRightCorner<6, 6>().inverse();
  // orientation z in the x-z plane: local y is global y, so loads along y bend about z
  CHECK(F * tip(1, 1) == doctest::Approx(F * L * L * L / (3 * s.E * s.Iz)).epsilon(1e-12));
  CHECK(F * tip(2, 2) == doctest::Approx(F * L * L * L / (3 * s.E * s.Iy)).epsilon(1e-12));
  CHECK(F * tip(3, 3) == doctest::Approx(F * L / (s.G * s.J)).epsilon(1e-12));
  CHECK(F * tip(0, 0) == doctest::Approx(F * L / (s.E * s.A)).epsilon(1e-12));
}

TEST_CASE("a cable is slack below its pretension and carries EA/L above") {
  const BeamFrame frame(Vector3::Zero(), Vector3(2, 0, 0), beam_axes(Vector3::Zero(), Vector3(2, 0, 0), {}));
  Trusses cables(Trusses::Kind::cable, Geometry::linear);
  cables.add({0, 1}, "c", frame, Elastic{160e9}, 1e-4, 2e3);
  ElementProbe probe(cables);
  const auto pull = [&](double elongation) { return probe.force(elongation * Vector12::Unit(6))[6]; };
  CHECK(pull(0) == doctest::Approx(2e3));
  CHECK(pull(1e-3) == doctest::Approx(2e3 + 160e9 * 1e-4 / 2 * 1e-3));
  CHECK(pull(-1e-3) == 0);
}
