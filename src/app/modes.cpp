#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "app/commands.hpp"
#ifdef NSFRAME_HAS_VTK
#include "output/vtk_frames.hpp"
#endif

namespace nsframe::app {

namespace {

// A ratio that is only rounding is none.
double damping_of(const StructureModes& modes, int mode) {
  const double ratio = modes.damping_ratio[mode];
  return std::abs(ratio) < 1e-9 ? 0.0 : ratio;
}

void print_table(const Model& model, const std::vector<StructureModes>& all) {
  fmt::print("{:<12} {:<5} {:>10} {:>10} {:>10} {:>8} {:>8} {:>8}\n", "structure", "mode", "f [Hz]", "T [s]", "damping %",
             "mass x %", "mass y %", "mass z %");
  for (std::size_t s = 0; s < all.size(); ++s) {
    for (int i = 0; i < all[s].modes.size(); ++i) {
      const auto at = static_cast<std::size_t>(i);
      const double f = all[s].modes.circular_frequency[i] / (2 * pi);
      const Vector3 mass = 100 * all[s].participation[at];
      fmt::print("{:<12} {:<5} {:>10.4f} {:>10} {:>10.3f} {:>8.2f} {:>8.2f} {:>8.2f}\n", model.structures[s].name,
                 all[s].names[at], f, f > 0 ? fmt::format("{:.5f}", 1 / f) : "-", 100 * damping_of(all[s], i), mass.x(), mass.y(), mass.z());
    }
  }
}

void print_json(const Model& model, const std::vector<StructureModes>& all) {
  nlohmann::json list = nlohmann::json::array();
  for (std::size_t s = 0; s < all.size(); ++s) {
    for (int i = 0; i < all[s].modes.size(); ++i) {
      const auto at = static_cast<std::size_t>(i);
      const Vector3& mass = all[s].participation[at];
      list.push_back({{"structure", model.structures[s].name},
                      {"mode", all[s].names[at]},
                      {"frequency", all[s].modes.circular_frequency[i] / (2 * pi)},
                      {"damping_ratio", damping_of(all[s], i)},
                      {"participation", {mass.x(), mass.y(), mass.z()}}});
    }
  }
  fmt::print("{}\n", list.dump(2));
}

#ifdef NSFRAME_HAS_VTK
// One frame a mode, at the "time" of its number: mode 1 of every structure in frame 1, and so on; the largest
// translation of every shape is a metre.
void write_shapes(const Model& model, Simulation& simulation, const std::filesystem::path& folder) {
  OutputOptions options;
  options.frames = 1;
  VtkFrames frames(folder, options);
  State state = simulation.state();
  state.displacement.setZero();
  frames.start(model, state);
  int most = 0;
  for (const StructureModes& modes : simulation.modes()) most = std::max(most, modes.modes.size());
  for (int mode = 0; mode < most; ++mode) {
    State shape = state;
    shape.time = mode + 1;
    for (std::size_t s = 0; s < simulation.modes().size(); ++s) {
      const Modes& modes = simulation.modes()[s].modes;
      const Structure& structure = model.structures[s];
      if (mode >= modes.size()) continue;
      shape.displacement.segment(structure.first_dof, structure.last_dof - structure.first_dof) = modes.shape.col(mode);
      const VectorX full = model.dofs.expand(shape.displacement);
      double largest = 0;
      for (const int node : structure.nodes) largest = std::max(largest, full.segment<3>(6 * node).norm());
      if (largest > 0) shape.displacement.segment(structure.first_dof, structure.last_dof - structure.first_dof) /= largest;
    }
    frames.step(state, shape, {}, {});
  }
  frames.finish();
}
#endif

}  // namespace

int modes(const SceneArguments& arguments) {
  const LoadedScene loaded = load(arguments);
  Simulation simulation(loaded.model, loaded.scene.analysis);
  if (arguments.json) {
    print_json(loaded.model, simulation.modes());
  } else {
    print_table(loaded.model, simulation.modes());
  }
  if (arguments.output.empty()) return done;
#ifdef NSFRAME_HAS_VTK
  make_folder(arguments.output);
  write_shapes(loaded.model, simulation, arguments.output);
  if (!arguments.json) fmt::print("mode shapes: {} (one frame a mode)\n", (arguments.output / "frames.pvd").string());
  return done;
#else
  throw InputError("error: -o: this nsframe was built without VTK and cannot write mode shapes");
#endif
}

}  // namespace nsframe::app
