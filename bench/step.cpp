// Time a step of the two-story pair, without output: from 2.2 s of El Centro, 500 steps of 1 ms with the first impacts
// in them (at about 2.5 s), over and over from the same state.
#include <benchmark/benchmark.h>

#include "base/errors.hpp"
#include "integrators/scheme.hpp"
#include "integrators/simulation.hpp"
#include "scene/scene.hpp"

namespace {

using namespace nsframe;

constexpr double start = 2.2;  // [s]
constexpr int steps = 500;

void pair(benchmark::State& state, const std::string& example, const std::string& columns) {
  std::vector<std::string> overrides;
  if (!columns.empty()) {
    for (const char* side : {"left", "right"}) {
      overrides.push_back(std::string("structure.") + side + ".columns.element=" + columns);
    }
  }
  Diagnostics diagnostics;
  const Scene scene =
      read_scene(std::string(NSFRAME_SOURCE_DIR) + "/examples/" + example + "/scene.toml", overrides, diagnostics);
  const Model model = build_model(scene.model, diagnostics);
  diagnostics.throw_if_any();
  AnalysisOptions options = scene.analysis;
  options.duration = start;
  Simulation simulation(model, options);
  simulation.run({});
  const std::unique_ptr<Scheme> scheme = make_scheme(options, simulation.system());
  const State& before = simulation.state();
  State committed, trial = before;
  StepResult result;
  long iterations = 0, impacts = 0;
  for (auto _ : state) {
    committed = before;
    for (int i = 0; i < steps; ++i) {
      scheme->step(simulation.system(), committed, trial, options.dt, result);
      std::swap(committed, trial);
      iterations += result.newton_iterations;
      impacts += static_cast<long>(result.impacts.size());
    }
  }
  const auto runs = static_cast<double>(state.iterations());
  state.counters["s/step"] =
      benchmark::Counter(steps, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
  state.counters["iterations/step"] = static_cast<double>(iterations) / (runs * steps);
  state.counters["impacts"] = static_cast<double>(impacts) / runs;
}

BENCHMARK_CAPTURE(pair, elastic, "two_story_elastic", "")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(pair, displacement, "two_story", "displacement")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(pair, force_based, "two_story", "force-based")->Unit(benchmark::kMillisecond);

}  // namespace
