// Time a step of the two-story pair, without output: from 2.2 s of El Centro, 500 steps of 1 ms with the first impacts
// in them (at about 2.5 s), over and over from the same state. By moreau-jean also with and without its DOFs without mass condensed.
#include <benchmark/benchmark.h>

#include <optional>

#include "base/errors.hpp"
#include "integrators/scheme.hpp"
#include "integrators/reduced_simulation.hpp"
#include "scene/scene.hpp"

namespace {

using namespace nsframe;

constexpr double start = 2.2;  // [s]
constexpr int steps = 500;

enum class Massless { as_the_scheme_does, kept, condensed };

void pair(benchmark::State& state, const std::string& example, const std::string& columns, Massless massless) {
  std::vector<std::string> overrides;
  if (massless != Massless::as_the_scheme_does) overrides.push_back("analysis.scheme=moreau-jean");
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
  std::optional<ReducedSimulation> reduced;
  std::optional<Simulation> whole;
  Simulation& simulation = massless == Massless::condensed ? reduced.emplace(model, options).simulation() : whole.emplace(model, options);
  simulation.run({});
  const std::unique_ptr<Scheme> scheme = make_scheme(options, simulation.system());
  const State& before = simulation.state();
  State committed, trial = before;
  StepResult result;
  long iterations = 0, impacts = 0;
  for (auto _ : state) {
    committed = before;
    scheme->begin_anew(simulation.system(), committed);
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
  state.counters["dofs"] = simulation.system().model.dofs.size();
  state.counters["impacts"] = static_cast<double>(impacts) / runs;
}

BENCHMARK_CAPTURE(pair, elastic, "two_story_elastic", "", Massless::as_the_scheme_does)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(pair, displacement, "two_story", "displacement", Massless::as_the_scheme_does)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(pair, force_based, "two_story", "force-based", Massless::as_the_scheme_does)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(pair, elastic_moreau_jean, "two_story_elastic", "", Massless::kept)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(pair, elastic_moreau_jean_condensed, "two_story_elastic", "", Massless::condensed)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(pair, force_based_moreau_jean, "two_story", "force-based", Massless::kept)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(pair, force_based_moreau_jean_condensed, "two_story", "force-based", Massless::condensed)->Unit(benchmark::kMillisecond);

}  // namespace
