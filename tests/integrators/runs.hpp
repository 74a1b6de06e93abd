// Runs of a scheme, and how far two of them are apart.
#pragma once

#include <doctest/doctest.h>

#include <algorithm>
#include <string>

#include "tests/integrators/oscillators.hpp"

namespace nsframe::test {

inline AnalysisOptions by_scheme(const std::string& scheme, double dt, double duration, double accuracy = 0) {
  AnalysisOptions o = options(0.5, dt, duration);
  o.scheme = scheme;
  o.accuracy = accuracy;
  return o;
}

inline Run completed(const ModelDescription& d, const AnalysisOptions& o) {
  Run result = run(d, o);
  CAPTURE(result.summary.stop_reason);
  REQUIRE(result.summary.completed);
  return result;
}

// Largest difference of displacements at the times of the coarser run [m], up to `until`.
inline double difference(const Run& coarse, const Run& fine, double until = 1e9) {
  const std::size_t stride = (fine.states.size() - 1) / (coarse.states.size() - 1);
  double largest = 0;
  for (std::size_t i = 0; i < coarse.states.size(); ++i) {
    const State &a = coarse.states[i], &b = fine.states[i * stride];
    REQUIRE(a.time == doctest::Approx(b.time).epsilon(1e-12));
    if (a.time <= until) largest = std::max(largest, (a.displacement - b.displacement).cwiseAbs().maxCoeff());
  }
  return largest;
}

// A run stopped after some steps and resumed from its snapshot ends with the bits of one that went through.
inline void check_resumed(const Model& model, const AnalysisOptions& o, int stop_at) {
  Simulation whole(model, o);
  whole.run({});
  Snapshot snapshot;
  int steps = 0;
  RunControl stop;
  stop.stop_requested = [&] { return ++steps > stop_at; };
  stop.keep_snapshot = [&](const Snapshot& kept) { snapshot = kept; };
  Simulation first(model, o);
  CHECK_FALSE(first.run({}, stop).completed);
  RunControl go_on;
  go_on.resume = &snapshot;
  Simulation second(model, o);
  CHECK(second.run({}, go_on).completed);
  CHECK(second.state().displacement == whole.state().displacement);
  CHECK(second.state().velocity == whole.state().velocity);
}

}  // namespace nsframe::test
