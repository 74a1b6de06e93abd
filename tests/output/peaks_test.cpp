#include <doctest/doctest.h>

#include <chrono>

#include "base/errors.hpp"
#include "output/peaks.hpp"
#include "output/sample_clock.hpp"
#include "tests/output/sample_pair.hpp"

using namespace nsframe;
using namespace nsframe::test;

TEST_CASE("peaks are the largest absolute values of the nodes' motion over a run") {
  const Model model = sample_pair();
  PeakTracker tracker({"right.22", "left.1"});
  State before = sample_state(model);
  tracker.start(model, before);
  const int node = node_index(model, "right.22");
  Vector3 displacement = model.dofs.expand(before.displacement).segment<3>(6 * node).cwiseAbs(),
          acceleration = Vector3::Zero();
  for (int i = 1; i <= 50; ++i) {
    State after = before;
    after.time = 0.01 * i;
    after.displacement *= std::cos(0.2 * i);
    after.velocity = before.velocity * std::sin(0.3 * i);
    tracker.step(before, after, {}, {});
    const VectorX full = model.dofs.expand(after.displacement);
    displacement = displacement.cwiseMax(full.segment<3>(6 * node).cwiseAbs());
    Vector3 a = model.dofs.expand((after.velocity - before.velocity) / 0.01).segment<3>(6 * node);
    a.x() += (model.motions[0].velocity_at(after.time) - model.motions[0].velocity_at(before.time)) / 0.01;
    acceleration = acceleration.cwiseMax(a.cwiseAbs());
    before = after;
  }
  const auto peaks = tracker.peaks();
  REQUIRE(peaks.size() == 2);
  CHECK(peaks[0].node == "right.22");
  CHECK((peaks[0].displacement - displacement).norm() == doctest::Approx(0).epsilon(1e-15));
  CHECK((peaks[0].acceleration - acceleration).norm() < 1e-12);  // rounding of velocity differences over 0.01 s
  // the foot of a column moves with the ground: its absolute acceleration is the ground's, as the mean over a step
  CHECK(peaks[1].displacement.norm() == 0);
  CHECK(peaks[1].acceleration.x() == doctest::Approx(3).epsilon(0.02));
}

TEST_CASE("a node that does not exist is an error that names the nearest one") {
  const Model model = sample_pair();
  PeakTracker tracker({"leftt.21"});
  CHECK_THROWS_WITH_AS(tracker.start(model, sample_state(model)),
                       "output: node 'leftt.21' does not exist; did you mean 'left.21'?", InputError);
}

TEST_CASE("a sample clock takes the step nearest to each sample") {
  SampleClock every(0);
  every.start(0);
  CHECK(every.due(0, 1e-3));
  SampleClock clock(300);  // a sample each 3.33 ms
  clock.start(0);
  std::vector<int> kept;
  for (int i = 1; i <= 20; ++i) {
    if (clock.due(1e-3 * (i - 1), 1e-3 * i)) kept.push_back(i);
  }
  CHECK(kept == std::vector<int>{3, 7, 10, 13, 17, 20});
  SampleClock fast(5000);  // more samples than steps
  fast.start(0);
  CHECK(fast.due(0, 1e-3));
  CHECK(fast.due(1e-3, 2e-3));
}

TEST_CASE("tracking the peaks of all nodes costs about a microsecond a step") {
  const Model model = sample_pair();
  PeakTracker tracker;
  const State state = sample_state(model);
  State after = state;
  after.time = 1e-3;
  tracker.start(model, state);
  const auto begin = std::chrono::steady_clock::now();
  for (int i = 0; i < 100000; ++i) tracker.step(state, after, {}, {});
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  MESSAGE("peaks of " << model.nodes.size() << " nodes: " << 1e6 * seconds / 100000 << " us a step");
  CHECK(seconds / 100000 < 50e-6);  // loose: debug builds and busy machines run this too
}
