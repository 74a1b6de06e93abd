// Dead loads between the ends of corotational members: they keep their direction, and their work depends on the places alone.
#include <doctest/doctest.h>

#include <functional>
#include <memory>

#include "base/rotation.hpp"
#include "elements/displacement_beam.hpp"
#include "elements/elastic_beam.hpp"
#include "elements/force_beam.hpp"
#include "tests/support/element_probe.hpp"

using namespace nsframe;
using namespace nsframe::test;

namespace {

const ElasticSection dead_section{2.1e9, 8.1e8, 3e-3, 1e-5, 4e-6, 8e-6, 2e-3, 1.5e-3};  // deforms in shear
const Vector3 dead_uniform(900, -2500, 1400);                                          // [N/m]
const Vector3 dead_force(-700, 1500, 2100), second_force(400, -300, -900);             // [N]

enum class Direction { dead, local, both };

MemberLoad load_of(Direction direction) {
  MemberLoad load;
  if (direction != Direction::local) {
    load.dead_uniform = dead_uniform;
    load.dead_points = {{0.3, dead_force}, {0.55, second_force}};
  }
  if (direction != Direction::dead) {
    load.uniform = Vector3(-300, 1200, 800);
    load.points = {{0.4, Vector3(500, -900, 300)}};
  }
  return load;
}

std::shared_ptr<const FiberSection> dead_fibers(const UniaxialLaw& law, bool added) {
  std::vector<Fiber> list;
  for (int i = 0; i < 7; ++i) {
    for (int j = 0; j < 5; ++j) list.push_back({0.02 * (i - 3), 0.015 * (j - 2), 3e-4, law});
  }
  return std::make_shared<FiberSection>(list, 5e4, added ? AddedLaws{Elastic{3e6}, Elastic{2e6}, std::nullopt} : AddedLaws{});
}

FiberMember dead_fiber_member(bool offsets, const UniaxialLaw& law, const MemberLoad& load, const Releases& releases, bool added = false) {
  return {leaning_frame(offsets), gauss_lobatto(5), std::vector<std::shared_ptr<const FiberSection>>(5, dead_fibers(law, added)), {}, load, releases};
}

struct DeadCase {
  std::string name;
  std::unique_ptr<ElementGroup> group;
  bool smooth;  // solves no equations inside
};

std::vector<DeadCase> dead_cases(const UniaxialLaw& law, Direction direction) {
  std::vector<DeadCase> cases;
  const auto add = [&](const std::string& name, auto group, auto member, bool smooth) {
    group->add({0, 1}, name, std::move(member));
    cases.push_back({name, std::move(group), smooth});
  };
  const MemberLoad load = load_of(direction);
  constexpr Geometry large = Geometry::corotational;
  for (const bool offsets : {false, true}) {
    for (const bool hinged : {false, true}) {
      const std::string suffix = std::string(offsets ? " with offsets" : "") + (hinged ? " with hinges" : "");
      const Releases releases = hinged ? Releases{{false, true, false, true, true, false}} : Releases{};
      add("elastic" + suffix, std::make_unique<ElasticBeams>(large), ElasticMember{leaning_frame(offsets), dead_section, {}, load, releases}, true);
      add("displacement" + suffix, std::make_unique<DisplacementBeams>(large), dead_fiber_member(offsets, law, load, releases), !hinged);
      add("force" + suffix, std::make_unique<ForceBeams>(large), dead_fiber_member(offsets, law, load, releases), false);
      add("force with shear" + suffix, std::make_unique<AggregatedForceBeams>(large), dead_fiber_member(offsets, law, load, releases, true), false);
    }
  }
  return cases;
}

// Work of the element's forces along the straight path from a to b: moments do theirs on the spins of the nodes, whose rotation
// since the (virgin) committed state is exp of their DOFs.
double work_along(ElementProbe& probe, const Vector12& a, const Vector12& b) {
  const Quadrature rule = gauss_lobatto(10);
  constexpr int pieces = 6;
  double work = 0;
  for (int piece = 0; piece < pieces; ++piece) {
    for (std::size_t k = 0; k < rule.weight.size(); ++k) {
      const Vector12 u = a + (piece + rule.position[k]) / pieces * (b - a);
      Vector12 rate = b - a;
      for (const int at : {3, 9}) rate.segment<3>(at) = (spin_by_vector(u.segment<3>(at)) * rate.segment<3>(at)).eval();
      work += rule.weight[k] / pieces * probe.force(u).dot(rate);
    }
  }
  return work;
}

}  // namespace

TEST_CASE("the tangent of members with dead loads equals central differences at large rotations, elastic and yielding") {
  RandomMotion random(7);
  for (const UniaxialLaw& law : {UniaxialLaw(Elastic{2.1e9}), UniaxialLaw(Steel02{2e7, 2.1e9, 0.01})}) {
    for (const Direction direction : {Direction::dead, Direction::both}) {
      for (const DeadCase& c : dead_cases(law, direction)) {
        CAPTURE(c.name);
        ElementProbe probe(*c.group);
        const Vector12 start = moved(random.vector12(0.02), rotation_exponential(random.vector(1.5)), random.vector(3));
        probe.force(start);
        probe.commit();
        const Vector12 u = start + random.vector12(0.03);
        Matrix12 tangent, differences;
        probe.force(u, &tangent);
        for (int i = 0; i < 12; ++i) {
          const double h = 1e-6;  // [m, rad]
          differences.col(i) = (probe.force(u + h * Vector12::Unit(i)) - probe.force(u - h * Vector12::Unit(i))) / (2 * h);
        }
        const double error = (tangent - differences).cwiseAbs().maxCoeff() / tangent.cwiseAbs().maxCoeff();
        // elastic members: rounding 1e-16 / h; the others as in corotational_test.cpp
        const bool linear = std::holds_alternative<Elastic>(law) || c.name.starts_with("elastic");
        CHECK(error < (linear ? 1e-7 : 3e-4));
      }
    }
  }
}

TEST_CASE("the work on an elastic member under dead loads doesn't depend on the path; under loads that turn with it it does") {
  RandomMotion random(7);
  for (const Direction direction : {Direction::dead, Direction::local}) {
    double most = 0;
    for (const DeadCase& c : dead_cases(Elastic{2.1e9}, direction)) {
      CAPTURE(c.name);
      ElementProbe probe(*c.group);
      const Vector12 a = moved(random.vector12(0.05), rotation_exponential(random.vector(0.6)), random.vector(1));
      const Vector12 b = moved(random.vector12(0.05), rotation_exponential(random.vector(0.6)), random.vector(1));
      // through deformations that differ: with less, a path of rigid motions would hide what the load does on bent members
      const double loop = work_along(probe, Vector12::Zero(), a) + work_along(probe, a, b) + work_along(probe, b, Vector12::Zero());
      const double scale = std::abs(work_along(probe, Vector12::Zero(), a));
      if (direction == Direction::dead) {
        CHECK(std::abs(loop) < 1e-8 * scale);
      } else {
        most = std::max(most, std::abs(loop) / scale);
      }
    }
    if (direction == Direction::local) CHECK(most > 1e-3);
  }
}

TEST_CASE("forces of a bent clamped member are in equilibrium with dead loads at the places to which these have moved") {
  RandomMotion random(7);
  const double L = (leaning_j - leaning_i).norm();
  ElasticSection s = dead_section;
  s.Ay = s.Az = 0;
  MemberLoad load;
  load.dead_uniform = dead_uniform;
  load.dead_points = {{0.5, dead_force}};
  ElasticBeams beams(Geometry::corotational);
  beams.add({0, 1}, "e", {leaning_frame(false), s, {}, load});
  const MemberGeometry& geometry = beam_geometry(Geometry::corotational);
  for (int repeat = 0; repeat < 5; ++repeat) {
    ElementProbe probe(beams);
    const Vector12 u = moved(random.vector12(0.05), rotation_exponential(random.vector(2)), random.vector(3)), f = probe.force(u);
    std::vector<double> history(14), trial(14);
    geometry.initialize_history(history.data());
    const Vector6 v = geometry.deformation(leaning_frame(false), u, history.data(), trial.data());
    const ElementPose pose = geometry.pose(leaning_frame(false), u, history.data());
    // textbook deflections of a clamped beam under P in the middle and w all along, those of its ends' rotations beside
    const Vector3 w = pose.axes * dead_uniform, P = pose.axes * dead_force;
    const Vector3 stiff(s.E * s.A, s.E * s.Iz, s.E * s.Iy);
    Vector3 middle(L / 2 + v[0] / 2 + P.x() * L / (4 * stiff[0]) + w.x() * L * L / (8 * stiff[0]), L / 8 * (v[1] - v[2]), -L / 8 * (v[3] - v[4]));
    Vector3 mean(L / 2 + v[0] / 2 + P.x() * L / (8 * stiff[0]) + w.x() * L * L / (12 * stiff[0]), L / 12 * (v[1] - v[2]), -L / 12 * (v[3] - v[4]));
    for (const int axis : {1, 2}) {
      middle[axis] += (P[axis] / 192 + w[axis] * L / 384) * L * L * L / stiff[axis];
      mean[axis] += (P[axis] / 384 + w[axis] * L / 720) * L * L * L / stiff[axis];
    }
    const Vector3 x_i = leaning_i + u.segment<3>(0), x_j = leaning_j + u.segment<3>(6);
    const auto place = [&](const Vector3& local) { return Vector3(x_i + pose.axes.transpose() * local); };
    CHECK((f.segment<3>(0) + f.segment<3>(6) + dead_force + L * dead_uniform).norm() < 1e-12 * f.norm());
    const Vector3 moment = f.segment<3>(3) + f.segment<3>(9) + x_i.cross(f.segment<3>(0).eval()) + x_j.cross(f.segment<3>(6).eval()) +
                           place(middle).cross(dead_force) + L * place(mean).cross(dead_uniform);
    CHECK(moment.norm() < 1e-11 * f.norm());
  }
}

TEST_CASE("the work under a dead load is strain energy minus the load times the way of its place") {
  // a clamped member of linear fibers under a load at its middle, moved rigidly: strain energy stays, the way is that of the middle
  RandomMotion random(7);
  MemberLoad load;
  load.dead_points = {{0.5, dead_force}};
  for (const bool force_based : {false, true}) {
    std::unique_ptr<ElementGroup> group;
    if (force_based) {
      auto beams = std::make_unique<ForceBeams>(Geometry::corotational);
      beams->add({0, 1}, "f", dead_fiber_member(false, Elastic{2.1e12}, load, {}));  // so stiff that turning against the load bends it little
      group = std::move(beams);
    } else {
      auto beams = std::make_unique<DisplacementBeams>(Geometry::corotational);
      beams->add({0, 1}, "d", dead_fiber_member(false, Elastic{2.1e12}, load, {}));
      group = std::move(beams);
    }
    ElementProbe probe(*group);
    const Vector3 turn = random.vector(1.5);
    const Vector12 end = moved(Vector12::Zero(), rotation_exponential(turn), Vector3::Zero());
    // along the rotation itself: the nodes go on circles
    const Quadrature rule = gauss_lobatto(10);
    double work = 0;
    for (int piece = 0; piece < 6; ++piece) {
      for (std::size_t k = 0; k < rule.weight.size(); ++k) {
        const double at = (piece + rule.position[k]) / 6;
        const Vector12 u = moved(Vector12::Zero(), rotation_exponential(at * turn), Vector3::Zero());
        Vector12 rate;
        for (int e = 0; e < 2; ++e) {
          rate.segment<3>(6 * e) = turn.cross(Vector3((e == 0 ? leaning_i : leaning_j) + u.segment<3>(6 * e)));
          rate.segment<3>(6 * e + 3) = turn;
        }
        work += rule.weight[k] / 6 * probe.force(u).dot(rate);
      }
    }
    const Vector3 way = (end.segment<3>(0) + end.segment<3>(6)) / 2;
    // what is left is the work that bends the clamped member, P d/2 with d of P L^3/192EI, a thousandth of the way's
    CHECK(work == doctest::Approx(-dead_force.dot(way)).epsilon(1e-4));
  }
}

TEST_CASE("along a step the tangent of elastic members with dead loads changes by what buckling takes for it") {
  RandomMotion random(7);
  for (const DeadCase& c : dead_cases(Elastic{2.1e9}, Direction::both)) {
    CAPTURE(c.name);
    ElementProbe probe(*c.group);
    const Vector12 u = moved(random.vector12(0.02), rotation_exponential(random.vector(1.5)), random.vector(3)), step = random.vector12(1e-3);
    Matrix12 after, before;
    probe.force(u + step, &after);
    probe.force(u - step, &before);
    const Matrix12 exact = 0.5 * (after - before);
    CHECK((probe.change(u, step) - exact).cwiseAbs().maxCoeff() < 1e-6 * exact.cwiseAbs().maxCoeff());
  }
}
