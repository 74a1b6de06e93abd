// Times of the step loop of a scene, run over and over in one process and without output, as the peers' scripts repeat theirs:
//   bench_run_loop SCENE REPEAT ENOUGH [KEY=VALUE ...]
// repeats it REPEAT times, or until the loops together have taken ENOUGH seconds, whichever comes last, but at most thrice REPEAT times.
// Prints JSON: {"wall_s": [...], "cpu_s": [...]}.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <ctime>

#include "base/errors.hpp"
#include "integrators/reduced_simulation.hpp"
#include "scene/scene.hpp"

namespace {

using namespace nsframe;

double process_seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

void repeat(const std::string& path, std::size_t times, double enough, const std::vector<std::string>& settings) {
  Diagnostics diagnostics;
  const Scene scene = read_scene(path, settings, diagnostics);
  const Model model = build_model(scene.model, diagnostics);
  diagnostics.throw_if_any();
  std::vector<double> wall, cpu;
  double sum = 0;
  while (wall.size() < times || (sum < enough && wall.size() < 3 * times)) {
    ReducedSimulation simulation(model, scene.analysis);
    const double before = process_seconds();
    const Summary summary = simulation.run({});
    cpu.push_back(process_seconds() - before);
    wall.push_back(summary.timing.step_loop);
    sum += wall.back();
    if (!summary.completed) throw ConvergenceError(summary.stop_reason);
  }
  fmt::print("{{\"wall_s\": [{}], \"cpu_s\": [{}]}}\n", fmt::join(wall, ", "), fmt::join(cpu, ", "));
}

}  // namespace

int main(int count, char** words) {
  if (count < 4) {
    fmt::print(stderr, "usage: bench_run_loop SCENE REPEAT ENOUGH [KEY=VALUE ...]\n");
    return 2;
  }
  try {
    repeat(words[1], std::stoul(words[2]), std::stod(words[3]), {words + 4, words + count});
  } catch (const std::exception& problem) {
    fmt::print(stderr, "{}\n", problem.what());
    return 2;
  }
}
