#include "integrators/buckling.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "app/commands.hpp"
#include "app/shape_frames.hpp"
#include "base/errors.hpp"
#include "integrators/static_analysis.hpp"

namespace nsframe::app {

namespace {

constexpr int shown_modes = 6;

// The loads that grow, and the state of equilibrium under those that don't.
struct Reference {
  std::string name;
  VectorX pattern;
  State state;
  double member_loads = 0;  // of the loads on members, which grow too
};

// The last static stage, after gravity and the stages before it; without stages, gravity itself.
Reference reference_loads(const Model& model, const AnalysisOptions& options, Simulation& simulation) {
  if (!simulation.stages().empty()) {
    std::vector<StageResult> results;
    if (!simulation.run_stages(simulation.stages().size() - 1, {options.algorithm, {}, {}}, results)) {
      throw ConvergenceError(results.back().stop_reason);
    }
    const StaticStage& last = simulation.stages().back();
    return {fmt::format("stage '{}'", last.name), last.pattern, simulation.state()};
  }
  if (!model.loaded()) {
    throw InputError("error: buckling needs a load pattern: a [[static]] stage, [gravity] with masses, or loads on beams");
  }
  State state = virgin_state(simulation.system());
  if (!state.internal_force.isZero(0)) {
    solve_static(simulation.system(), VectorX::Zero(model.dofs.size()), {}, state);
  }
  return {"gravity", model.gravity_load, state, 1};
}

// The structure that a shape moves most.
std::string structure_of(const Model& model, const VectorX& shape) {
  std::string name;
  double most = -1;
  for (const Structure& structure : model.structures) {
    if (structure.last_dof == structure.first_dof) continue;
    const double share = shape.segment(structure.first_dof, structure.last_dof - structure.first_dof).norm();
    if (share > most) {
      most = share;
      name = structure.name;
    }
  }
  return name;
}

}  // namespace

int buckling(const SceneArguments& arguments) {
  const LoadedScene loaded = load_at_rest(arguments);
  Simulation simulation(loaded.model, loaded.scene.analysis);
  const Reference reference = reference_loads(loaded.model, loaded.scene.analysis, simulation);
  const std::vector<BucklingMode> modes = buckling_modes(simulation.system(), reference.state, reference.pattern, shown_modes, reference.member_loads);
  if (arguments.json) {
    nlohmann::json list = nlohmann::json::array();
    for (const BucklingMode& mode : modes) {
      list.push_back({{"structure", structure_of(loaded.model, mode.shape)}, {"load_factor", mode.load_factor}});
    }
    fmt::print("{}\n", nlohmann::json{{"reference", reference.name}, {"modes", list}}.dump(2));
  } else {
    fmt::print("critical factors of the loads of {}\n", reference.name);
    if (modes.empty()) fmt::print("  none: these loads cannot make the structure buckle (is its geometry linear?)\n");
    for (std::size_t i = 0; i < modes.size(); ++i) {
      fmt::print("  {:>3}  {:<12} {:>14.6g}\n", i + 1, structure_of(loaded.model, modes[i].shape), modes[i].load_factor);
    }
  }
  if (arguments.output.empty()) return done;
  std::vector<VectorX> shapes;
  for (const BucklingMode& mode : modes) shapes.push_back(mode.shape);
  make_folder(arguments.output);
  write_shape_frames(loaded.model, simulation.state(), shapes, arguments.output);
  if (!arguments.json) fmt::print("buckling shapes: {} (one frame a mode)\n", (arguments.output / "frames.pvd").string());
  return done;
}

}  // namespace nsframe::app
