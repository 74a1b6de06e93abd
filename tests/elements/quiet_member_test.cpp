// Displacement-based members that are quiet as a whole, against the same members whose fibers are evaluated at every call.
#include <doctest/doctest.h>

#include <random>

#include "elements/displacement_beam.hpp"
#include "tests/support/simd_targets.hpp"

using namespace nsframe;

namespace {

const Vector3 end_i(0.2, -0.1, 0.3), end_j(1.1, 0.9, 2.4);
constexpr double yield_strain = 235e6 / 210e9;  // [-]

std::shared_ptr<const FiberSection> steel_section(double width, bool screened) {
  std::vector<Fiber> fibers;
  for (int i = 0; i < 7; ++i) {
    for (int j = 0; j < 5; ++j) fibers.push_back({0.02 * (i - 3), width * (j - 2), 3e-4, Steel02{235e6, 210e9, 0.01, 20, 0.925, 0.15, 0, 1, 0, 1, 5e6}});
  }
  FiberSection made(fibers, 5e4);
  made.screened = made.screened && screened;
  return std::make_shared<FiberSection>(std::move(made));
}

// Sections of two widths, a load between the ends.
std::unique_ptr<DisplacementBeams> steel_member(Geometry geometry, bool screened) {
  const auto narrow = steel_section(0.01, screened), wide = steel_section(0.015, screened);
  auto group = std::make_unique<DisplacementBeams>(geometry);
  FiberMember beam{{end_i, end_j, beam_axes(end_i, end_j, Vector3(0.3, 1, 0.1))}, gauss_lobatto(5), {narrow, narrow, wide, wide, wide}};
  beam.load = {Vector3(300, -900, 400), {}};
  group->add({0, 1}, "d", beam);
  return group;
}

struct TrialBuffers {
  const DisplacementBeams& group;
  std::vector<VectorX> history;
  std::size_t committed = 0;
  explicit TrialBuffers(const DisplacementBeams& the_group) : group(the_group), history(4, VectorX::Zero(the_group.history_begin(1))) {
    for (VectorX& one : history) {
      group.initialize_history(0, one.data());
      *group.load_factor(0, one.data()) = 1;
    }
  }
  const double* now() const { return history[committed].data(); }
};

struct LargestDifference {
  double force = 0, tangent = 0;
  long quiet = 0, steps = 0;
};

// Members that sway about a point that moves outwards, with refused trials and changing trial histories, as halved and repeated steps
// leave them.
LargestDifference sway(Geometry geometry, unsigned seed, int steps) {
  const auto quiet = steel_member(geometry, true), full = steel_member(geometry, false);
  TrialBuffers a(*quiet), b(*full);
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform(-1, 1);
  LargestDifference difference;
  Vector12 u = Vector12::Zero(), target = u;
  Vector12 scale;
  scale << Vector3::Constant(yield_strain), Vector3::Constant(yield_strain / 0.06), Vector3::Constant(yield_strain), Vector3::Constant(yield_strain / 0.06);
  const double all = full->fibers(0);
  for (int step = 0; step < steps; ++step) {
    if (step % 15 == 0) {
      for (int i = 0; i < 12; ++i) target[i] = (0.02 + 0.6 * step / steps) * uniform(random) * scale[i];
    }
    u += 0.1 * (target - u);
    std::size_t trial = a.committed;
    while (trial == a.committed) trial = random() % a.history.size();
    Vector12 force, expected;
    Matrix12 tangent, expected_tangent;
    quiet->start_step(0, a.now(), a.history[trial].data());
    if (step % 3 == 0) quiet->respond(0, 4 * u, a.now(), a.history[trial].data(), force, nullptr);
    if (step % 5 == 0) {
      while (trial == a.committed) trial = random() % a.history.size();
    }
    const VectorX before = a.history[a.committed];
    quiet->respond(0, u, a.now(), a.history[trial].data(), force, &tangent);
    REQUIRE(a.history[a.committed] == before);
    a.committed = trial;
    const std::size_t other = 1 - std::min<std::size_t>(b.committed, 1);
    full->start_step(0, b.now(), b.history[other].data());
    full->respond(0, u, b.now(), b.history[other].data(), expected, &expected_tangent);
    b.committed = other;
    // of the forces at yield, and of the virgin tangent
    const double stiffness = 210e9 * 35 * 3e-4 / 2.5;
    difference.force = std::max(difference.force, (force - expected).cwiseAbs().maxCoeff() / (stiffness * yield_strain));
    difference.tangent = std::max(difference.tangent, (tangent - expected_tangent).cwiseAbs().maxCoeff() / stiffness);
    const int count = quiet->quiet_fibers(0, a.now());
    difference.quiet += count == all ? 1 : 0;
    ++difference.steps;
    if (step % 7 != 0) continue;
    const auto states = quiet->fiber_states(0, u, a.now()), expected_states = full->fiber_states(0, u, b.now());
    REQUIRE(states.size() == expected_states.size());
    for (std::size_t i = 0; i < states.size(); ++i) {
      REQUIRE(states[i].yielded == expected_states[i].yielded);
      REQUIRE(std::abs(states[i].stress - expected_states[i].stress) < 1e-10 * 235e6);
    }
  }
  return difference;
}

}  // namespace

TEST_CASE("a member that is quiet as a whole answers like its fibers, before and after one leaves the elastic line") {
  test::on_every_simd_target([](const std::string&) {
    for (const Geometry geometry : {Geometry::linear, Geometry::p_delta, Geometry::corotational}) {
      CAPTURE(static_cast<int>(geometry));
      for (unsigned seed = 1; seed < 5; ++seed) {
        const LargestDifference found = sway(geometry, seed, 400);
        CHECK(found.force < 2e-12);
        CHECK(found.tangent < 1e-10);  // powers of a curve of R = 20
        CHECK(found.quiet > 30);
        CHECK(found.quiet < found.steps - 100);
      }
    }
  });
}

TEST_CASE("a quiet member keeps the same history in any trial buffer, bit by bit") {
  // what decides how fibers leave the line: reversals on it, told at the end of two runs that went different ways through their buffers
  const auto group = steel_member(Geometry::linear, true);
  TrialBuffers a(*group), b(*group);
  Vector12 u = Vector12::Zero(), force;
  for (int step = 0; step < 200; ++step) {
    u[6] = 2e-4 * std::sin(0.7 * step);
    u[10] = 3e-4 * std::sin(0.3 * step);
    const std::size_t next = (a.committed + 1) % 4, other = 1 - b.committed;
    if (step % 4 == 0) group->respond(0, 20 * u, b.now(), b.history[other].data(), force, nullptr);
    group->respond(0, u, a.now(), a.history[next].data(), force, nullptr);
    group->respond(0, u, b.now(), b.history[other].data(), force, nullptr);
    a.committed = next;
    b.committed = other;
  }
  CHECK(group->quiet_fibers(0, a.now()) == group->fibers(0));
  const auto states = group->fiber_states(0, u, a.now()), others = group->fiber_states(0, u, b.now());
  for (std::size_t i = 0; i < states.size(); ++i) REQUIRE(states[i].stress == others[i].stress);
  Vector12 from_a, from_b;
  const Vector12 far = 30 * u;
  std::size_t trial_a = (a.committed + 2) % 4, trial_b = 1 - b.committed;
  group->respond(0, far, a.now(), a.history[trial_a].data(), from_a, nullptr);
  group->respond(0, far, b.now(), b.history[trial_b].data(), from_b, nullptr);
  CHECK(from_a == from_b);
}
