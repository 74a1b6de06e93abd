#include "scene/describe_stage.hpp"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <fstream>

namespace nsframe {

namespace {

constexpr std::size_t most_targets = 1'000'000;

// Numbers, one a line; blank lines and what follows a # don't count.
std::optional<std::vector<double>> read_targets(const Reference& name, const std::filesystem::path& directory,
                                                Diagnostics& diagnostics) {
  const std::filesystem::path path = directory / name.name;
  std::error_code ignored;
  std::ifstream file(path);
  if (!file || std::filesystem::is_directory(path, ignored)) {
    diagnostics.error(name.at, fmt::format("cannot open '{}'", path.string()));
    return std::nullopt;
  }
  std::vector<double> targets;
  std::string line;
  for (int number = 1; std::getline(file, line); ++number) {
    line = line.substr(0, line.find('#'));
    const auto begin = line.find_first_not_of(" \t\r"), end = line.find_last_not_of(" \t\r");
    if (begin == std::string::npos) continue;
    double value = 0;
    const char* const last = line.data() + end + 1;
    const auto [rest, error] = std::from_chars(line.data() + begin + (line[begin] == '+'), last, value);
    if (error != std::errc() || rest != last || !std::isfinite(value) || targets.size() == most_targets) {
      diagnostics.error({path.string(), number, static_cast<int>(begin) + 1},
                        targets.size() == most_targets ? fmt::format("more than {} targets", most_targets)
                                                       : std::string("a line must be one number"));
      return std::nullopt;
    }
    targets.push_back(value);
  }
  if (targets.empty()) {
    diagnostics.error(name.at, fmt::format("'{}' has no numbers", path.string()));
    return std::nullopt;
  }
  return targets;
}

}  // namespace

std::optional<StageDescription> describe(const StageTable& stage, std::size_t number,
                                         const std::filesystem::path& directory, Diagnostics& diagnostics) {
  StageDescription out;
  out.name = stage.name.empty() ? fmt::format("stage {}", number) : stage.name;
  out.at = stage.at;
  for (const StageLoadTable& load : stage.loads) out.loads.push_back({load.node, static_cast<int>(load.dof), load.value});
  if (stage.masses) out.masses = stage.masses->vector;
  out.mode = stage.mode;
  if (stage.control_dof) {
    out.control_node = stage.control_dof->node;
    out.control_dof = static_cast<int>(stage.control_dof->dof);
  }
  StageOptions& options = out.options;
  options.control = stage.control.name;
  options.control_at = stage.control.at;
  options.relative = !stage.by.empty();
  options.targets = options.relative ? stage.by : stage.to;
  for (const auto& [amplitude, count] : stage.cycles) {
    for (int cycle = 0; cycle < static_cast<int>(count); ++cycle) {
      options.targets.push_back(amplitude);
      options.targets.push_back(-amplitude);
    }
  }
  if (stage.file) {
    const auto targets = read_targets(*stage.file, directory, diagnostics);
    if (!targets) return std::nullopt;
    for (const double target : *targets) options.targets.push_back(stage.factor.value_or(1) * target);
  }
  if (options.targets.empty() && options.control == "load") options.targets = {1};
  options.step = stage.step.value_or(0);
  options.steps = stage.steps.value_or(options.steps);
  options.arc = stage.arc.value_or(options.arc);
  options.max_points = stage.max_points.value_or(options.max_points);
  options.tolerance = stage.tolerance;
  options.max_iterations = stage.max_iterations;
  return out;
}

}  // namespace nsframe
