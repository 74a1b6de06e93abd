#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include <algorithm>

#include "app/commands.hpp"
#include "app/shape_frames.hpp"

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

// Mode 1 of every structure together, and so on; the largest translation of every shape is a metre.
std::vector<VectorX> shapes_of(const Model& model, const std::vector<StructureModes>& all) {
  std::vector<VectorX> shapes;
  for (std::size_t s = 0; s < all.size(); ++s) {
    const Structure& structure = model.structures[s];
    for (int mode = 0; mode < all[s].modes.size(); ++mode) {
      if (static_cast<std::size_t>(mode) == shapes.size()) shapes.push_back(VectorX::Zero(model.dofs.size()));
      auto part = shapes[static_cast<std::size_t>(mode)].segment(structure.first_dof, structure.last_dof - structure.first_dof);
      VectorX alone = VectorX::Zero(model.dofs.size());
      alone.segment(structure.first_dof, part.size()) = all[s].modes.shape.col(mode);
      const VectorX full = model.dofs.expand(alone);
      double largest = 0;
      for (const int node : structure.nodes) largest = std::max(largest, full.segment<3>(6 * node).norm());
      part = all[s].modes.shape.col(mode) / (largest > 0 ? largest : 1);
    }
  }
  return shapes;
}

}  // namespace

int modes(const SceneArguments& arguments) {
  const LoadedScene loaded = load_at_rest(arguments);
  Simulation simulation(loaded.model, loaded.scene.analysis);
  if (arguments.json) {
    print_json(loaded.model, simulation.modes());
  } else {
    print_table(loaded.model, simulation.modes());
  }
  if (arguments.output.empty()) return done;
  make_folder(arguments.output);
  write_shape_frames(loaded.model, simulation.state(), shapes_of(loaded.model, simulation.modes()), arguments.output);
  if (!arguments.json) fmt::print("mode shapes: {} (one frame a mode)\n", (arguments.output / "frames.pvd").string());
  return done;
}

}  // namespace nsframe::app
