#include <doctest/doctest.h>

#include "models/snapshot.hpp"
#include "output/drifts.hpp"
#include "tests/output/sample_pair.hpp"
#include "tests/verification/pair_of_masses.hpp"

using namespace nsframe;
using namespace nsframe::test;

namespace {

// Mean over the corners of a floor of the sample frame: nodes 10 floor + 1 to 4.
Vector2 mean_of_corners(const Model& model, const State& state, const std::string& frame, int floor) {
  const VectorX full = model.dofs.expand(state.displacement);
  Vector2 sum = Vector2::Zero();
  for (int i = 1; i <= 4; ++i) {
    sum += full.segment<2>(6 * node_index(model, fmt::format("{}.{}", frame, 10 * floor + i)));
  }
  return sum / 4;
}

}  // namespace

TEST_CASE("a drift is the largest relative displacement of two floors over the height between them") {
  const Model model = sample_pair();
  DriftTracker tracker;
  State before = sample_state(model);
  tracker.start(model, before);
  Vector2 first = Vector2::Zero(), second = Vector2::Zero();
  const auto raise = [&](const State& state) {
    const Vector2 low = mean_of_corners(model, state, "right", 1), high = mean_of_corners(model, state, "right", 2);
    first = first.cwiseMax(low.cwiseAbs() / story_height);
    second = second.cwiseMax((high - low).cwiseAbs() / story_height);
  };
  raise(before);
  for (int i = 1; i <= 30; ++i) {
    State after = before;
    after.time = 0.01 * i;
    after.displacement = before.displacement * std::cos(0.2 * i);
    after.displacement[i] += 0.002 * i;
    tracker.step(before, after, {}, {});
    raise(after);
    before = after;
  }
  const auto& drifts = tracker.drifts();
  REQUIRE(drifts.size() == 4);
  CHECK(drifts[0].structure == "left");
  CHECK(drifts[2].structure == "right");
  CHECK(drifts[2].story == 1);
  CHECK(drifts[3].bottom == story_height);
  CHECK(drifts[3].top == 2 * story_height);
  CHECK((drifts[2].drift - first).norm() < 1e-15);  // rounding of a mean of four
  CHECK((drifts[3].drift - second).norm() < 1e-15);
}

TEST_CASE("a rigid translation of both floors drifts in the first story only") {
  const Model model = sample_pair();
  State state = sample_state(model);
  state.displacement.setZero();
  for (std::size_t i = 0; i < model.dofs.free.size(); ++i) {
    if (model.dofs.free[i].direction == 0) state.displacement[static_cast<Eigen::Index>(i)] = 0.025;
  }
  DriftTracker tracker;
  tracker.start(model, state);
  REQUIRE(tracker.drifts().size() == 4);
  CHECK(tracker.drifts()[0].drift.x() == doctest::Approx(0.01));
  CHECK(tracker.drifts()[0].drift.y() == 0);
  CHECK(tracker.drifts()[1].drift.norm() < 1e-15);
}

TEST_CASE("without slabs the floors are where mass is, and a structure without height has no story") {
  ModelDescription d = sample_description();
  for (StructureDescription& frame : d.structures) frame.slabs.clear();
  d.contacts.clear();
  Diagnostics diagnostics;
  const Model frames = build_model(d, diagnostics);
  DriftTracker tracker;
  tracker.start(frames, sample_state(frames));
  CHECK(tracker.drifts().size() == 4);

  ModelDescription masses;
  masses.structures = {oscillator(0, {4600, 2.11e6, 0.005}), oscillator(1, {3500, 5.31e6, 0.005})};
  const Model pair = build_model(masses, diagnostics);
  tracker.start(pair, sample_state(pair));
  CHECK(tracker.drifts().empty());
}

TEST_CASE("drifts go on from a snapshot") {
  const Model model = sample_pair();
  DriftTracker tracker, resumed;
  State state = sample_state(model);
  tracker.start(model, state);
  Snapshot snapshot;
  tracker.save(snapshot);
  state.displacement *= 0.5;
  resumed.resume(model, state, snapshot);
  REQUIRE(resumed.drifts().size() == tracker.drifts().size());
  for (std::size_t i = 0; i < tracker.drifts().size(); ++i)
    CHECK(resumed.drifts()[i].drift == tracker.drifts()[i].drift);
}
