// One pass an evaluation with the rest carried to the next, against the same members that iterate at every evaluation.
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <memory>

#include "elements/force_beam.hpp"
#include "tests/support/element_probe.hpp"

using namespace nsframe;
using namespace nsframe::test;

namespace {

struct CarriedCase {
  std::string name;
  std::unique_ptr<ElementGroup> group;
  bool sharp = false;  // laws with corners
};

const Releases carried_hinge{{false, true, false, false, true, false}};

template <class Group>
CarriedCase carried_case(const std::string& name, Geometry geometry, const UniaxialLaw& law, bool sharp, bool added, bool loaded,
                         const Releases& releases = {}) {
  std::vector<Fiber> fibers;
  for (int i = 0; i < 7; ++i) {
    for (int j = 0; j < 5; ++j) fibers.push_back({0.02 * (i - 3), 0.015 * (j - 2), 3e-4, law});
  }
  const AddedLaws laws = added ? AddedLaws{Steel01{4e4, 4e6, 0.05}, Steel02{3e4, 4e6, 0.05}, Elastic{1e5}} : AddedLaws{};
  const auto section = std::make_shared<FiberSection>(fibers, 5e4, laws);
  FiberMember member{leaning_frame(false), gauss_lobatto(5), std::vector<std::shared_ptr<const FiberSection>>(5, section), {}, {}, releases};
  if (loaded && geometry == Geometry::corotational) {
    member.load.dead_uniform = Vector3(900, -2500, 1400);
    member.load.dead_points = {{0.3, Vector3(-700, 1500, 2100)}};
  } else if (loaded) {
    member.load = {Vector3(300, -900, 400), {{0.3, Vector3(200, 1500, -700)}}};
  }
  auto group = std::make_unique<Group>(geometry);
  group->add({0, 1}, name, std::move(member));
  return {name, std::move(group), sharp};
}

std::vector<CarriedCase> carried_cases() {
  std::vector<CarriedCase> cases;
  const Steel02 curved{235e6, 210e9, 0.01, 20, 0.925, 0.15};
  const Steel01 bilinear{235e6, 210e9, 0.02};
  for (const Geometry geometry : {Geometry::linear, Geometry::p_delta, Geometry::corotational}) {
    const std::string suffix = " " + std::to_string(static_cast<int>(geometry));
    cases.push_back(carried_case<ForceBeams>("Steel02" + suffix, geometry, curved, false, false, false));
    cases.push_back(carried_case<ForceBeams>("Steel02, loaded" + suffix, geometry, curved, false, false, true));
    cases.push_back(carried_case<ForceBeams>("Steel01, hinges, loaded" + suffix, geometry, bilinear, true, false, true, carried_hinge));
    cases.push_back(carried_case<AggregatedForceBeams>("with shear" + suffix, geometry, curved, true, true, true));
  }
  cases.push_back(carried_case<ForceBeams>("nearly perfect plasticity", Geometry::linear, Steel01{235e6, 210e9, 0.001}, true, false, false));
  cases.push_back(carried_case<ForceBeams>("Hardening", Geometry::linear, Hardening{210e9, 235e6, 2e9, 1e9}, true, false, false));
  return cases;
}

struct CarriedCounts {
  long carried = 0, forced = 0, evaluations = 0;
  double largest_error = 0, largest_unsettled = 0;
};

// A random walk with steps of several evaluations that come near the end of the step, as Newton's do; the last one ends with respond().
CarriedCounts walk(const CarriedCase& c, unsigned seed, int steps) {
  RandomMotion random(seed);
  ElementProbe oracle(*c.group);
  VectorX committed = oracle.committed(), trial = committed;
  CarriedCounts counts;
  Vector12 u = Vector12::Zero(), force;
  Matrix12 tangent, expected_tangent;
  double largest_force = 1;
  for (int step = 0; step < steps; ++step) {
    const Vector12 change = random.vector12(step % 9 == 0 ? 3e-3 : 4e-4);
    const VectorX before = committed;
    c.group->start_step(0, committed.data(), trial.data());
    double off = 0.2;
    for (int evaluation = 0; evaluation < 3; ++evaluation, off *= 0.05) {
      const Vector12 there = u + change + off * change.cwiseAbs().maxCoeff() * random.vector12(1);
      const VectorX same = trial;
      c.group->respond_once(0, there, committed.data(), trial.data(), force, &tangent);
      const StateWork work = c.group->state_work(0, trial.data());
      ++counts.evaluations;
      if (work.unsettled > 1) ++counts.carried;
      if (work.passes > 1) ++counts.forced;
      counts.largest_unsettled = std::max(counts.largest_unsettled, work.unsettled);
      VectorX again = same;  // a function of its arguments
      Vector12 force_again;
      c.group->respond_once(0, there, committed.data(), again.data(), force_again, nullptr);
      REQUIRE(force_again == force);
      REQUIRE(again == trial);
    }
    u += change;
    c.group->respond_once(0, u, committed.data(), trial.data(), force, nullptr);
    c.group->respond(0, u, committed.data(), trial.data(), force, &tangent);
    REQUIRE(c.group->state_work(0, trial.data()).unsettled == 0);
    REQUIRE(committed == before);
    const Vector12 expected = oracle.force(u, &expected_tangent);
    largest_force = std::max(largest_force, expected.cwiseAbs().maxCoeff());
    counts.largest_error = std::max(counts.largest_error, (force - expected).cwiseAbs().maxCoeff() / largest_force);
    committed = trial;
    oracle.commit();
  }
  return counts;
}

}  // namespace

TEST_CASE("a force-based member that carries what is left of its balance ends a step where one that iterates does") {
  long fell_back = 0;
  for (const CarriedCase& c : carried_cases()) {
    CAPTURE(c.name);
    for (unsigned seed = 1; seed < 4; ++seed) {
      const CarriedCounts counts = walk(c, seed, 120);
      CHECK(counts.carried > counts.evaluations / 50);
      CHECK(counts.largest_unsettled <= 1000.1);  // a tenth of the change over the step, of 1e-4
      // the sections' own tolerance is 1e-4 of a step's change, here up to all of the force, whichever way they come there
      CHECK(counts.largest_error < (c.sharp ? 2e-4 : 3e-5));
      fell_back += counts.forced;
    }
  }
  CHECK(fell_back > 100);
}

TEST_CASE("what a force-based member carries is compatible with its ends") {
  // sum w b'e = v at every evaluation, settled or not: curvatures of a member in its plane
  const CarriedCase c = carried_case<ForceBeams>("m", Geometry::linear, Steel02{235e6, 210e9, 0.01}, false, false, false);
  VectorX committed = ElementProbe(*c.group).committed(), trial = committed;
  const Quadrature rule = gauss_lobatto(5);
  const BeamFrame frame = leaning_frame(false);
  long carried = 0;
  for (int k = 1; k <= 40; ++k) {
    Vector12 u = Vector12::Zero();
    u.segment<3>(9) = 6e-4 * k * frame.axes.row(2).transpose();  // the second end turns about local z
    c.group->start_step(0, committed.data(), trial.data());
    Vector12 force;
    c.group->respond_once(0, u, committed.data(), trial.data(), force, nullptr);
    if (c.group->state_work(0, trial.data()).unsettled > 1) ++carried;
    double at_i = 0, at_j = 0;
    for (const SectionResult& section : c.group->sections(0, u, trial.data())) {
      const std::size_t i = static_cast<std::size_t>(std::find(rule.position.begin(), rule.position.end(), section.position) - rule.position.begin());
      at_i += rule.weight[i] * frame.length * (section.position - 1) * section.deformation[1];
      at_j += rule.weight[i] * frame.length * section.position * section.deformation[1];
    }
    CHECK(std::abs(at_i) < 1e-14);
    CHECK(at_j == doctest::Approx(6e-4 * k).epsilon(1e-12));
    c.group->respond(0, u, committed.data(), trial.data(), force, nullptr);
    committed = trial;
  }
  CHECK(carried > 5);
}

TEST_CASE("a step begins from the committed state, whatever an abandoned one has carried") {
  for (const CarriedCase& c : carried_cases()) {
    CAPTURE(c.name);
    ElementProbe probe(*c.group);
    RandomMotion random(7);
    for (int k = 0; k < 20; ++k) {
      const Vector12 u = random.vector12(2e-3), elsewhere = random.vector12(4e-3);
      VectorX fresh = probe.committed(), used = probe.committed();
      Vector12 force, expected;
      c.group->start_step(0, probe.committed().data(), used.data());
      c.group->respond_once(0, elsewhere, probe.committed().data(), used.data(), force, nullptr);
      c.group->start_step(0, probe.committed().data(), used.data());
      c.group->start_step(0, probe.committed().data(), fresh.data());
      c.group->respond_once(0, u, probe.committed().data(), used.data(), force, nullptr);
      c.group->respond_once(0, u, probe.committed().data(), fresh.data(), expected, nullptr);
      CHECK(force == expected);
      probe.force(u);
      probe.commit();
    }
  }
}

TEST_CASE("at a settled state the tangent of one pass is the derivative of the next one") {
  for (const CarriedCase& c : carried_cases()) {
    if (c.sharp) continue;
    CAPTURE(c.name);
    ElementProbe probe(*c.group);
    RandomMotion random(3);
    for (int k = 0; k < 5; ++k) {
      const Vector12 u = random.vector12(4e-3);
      Vector12 force;
      Matrix12 tangent, differences;
      VectorX settled = probe.committed();
      c.group->start_step(0, probe.committed().data(), settled.data());
      c.group->respond(0, u, probe.committed().data(), settled.data(), force, &tangent);
      for (int i = 0; i < 12; ++i) {
        const double h = 1e-7;  // [m, rad]
        Vector12 more, less;
        VectorX a = settled, b = settled;
        c.group->respond_once(0, u + h * Vector12::Unit(i), probe.committed().data(), a.data(), more, nullptr);
        c.group->respond_once(0, u - h * Vector12::Unit(i), probe.committed().data(), b.data(), less, nullptr);
        differences.col(i) = (more - less) / (2 * h);
      }
      CHECK((tangent - differences).cwiseAbs().maxCoeff() < 1e-4 * tangent.cwiseAbs().maxCoeff());
      probe.force(u);
      probe.commit();
    }
  }
}

TEST_CASE("members that are to iterate at every evaluation leave nothing to the next one") {
  ForceBeams group(Geometry::linear);
  const auto section = std::make_shared<FiberSection>(
      std::vector<Fiber>{{0.05, 0.04, 1e-3, Steel02{235e6, 210e9, 0.01}}, {-0.05, 0.04, 1e-3, Steel02{235e6, 210e9, 0.01}},
                         {0.05, -0.04, 1e-3, Steel02{235e6, 210e9, 0.01}}, {-0.05, -0.04, 1e-3, Steel02{235e6, 210e9, 0.01}}}, 5e4);
  FiberMember member{leaning_frame(false), gauss_lobatto(5), std::vector<std::shared_ptr<const FiberSection>>(5, section)};
  group.add({0, 1}, "carries", member);
  member.inner_iterations = true;
  group.add({0, 1}, "iterates", member);
  std::array<VectorX, 2> committed, trial;
  std::array<long, 2> left{}, passes{};
  for (int e : {0, 1}) {
    VectorX whole = VectorX::Zero(group.history_begin(2));
    group.initialize_history(e, whole.data());
    committed[static_cast<std::size_t>(e)] = trial[static_cast<std::size_t>(e)] = whole;
  }
  RandomMotion random(11);
  for (int k = 0; k < 50; ++k) {
    const Vector12 u = random.vector12(3e-3);
    for (int e : {0, 1}) {
      const auto i = static_cast<std::size_t>(e);
      Vector12 force;
      group.start_step(e, committed[i].data(), trial[i].data());
      group.respond_once(e, u, committed[i].data(), trial[i].data(), force, nullptr);
      const StateWork work = group.state_work(e, trial[i].data());
      left[i] += work.unsettled > 1 ? 1 : 0;
      passes[i] += work.passes;
      group.respond(e, u, committed[i].data(), trial[i].data(), force, nullptr);
      committed[i] = trial[i];
    }
  }
  CHECK(left[0] > 5);
  CHECK(left[1] == 0);
  CHECK(passes[1] > passes[0]);
}
