#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "models/build_motions.hpp"
#include "models/dof_names.hpp"
#include "models/model.hpp"

namespace nsframe {

namespace {

int find_node(const Model& model, const Reference& reference, Diagnostics& diagnostics) {
  const auto& ids = model.nodes.id;
  const auto found = std::find(ids.begin(), ids.end(), reference.name);
  if (found != ids.end()) return static_cast<int>(found - ids.begin());
  diagnostics.error(reference.at, fmt::format("there is no node '{}'{}", reference.name, did_you_mean(reference.name, ids)));
  return -1;
}

// A DOF that something may be done to, or -1 and an error.
int free_dof(const Model& model, const Reference& reference, int dof, const char* what, Diagnostics& diagnostics) {
  const int node = find_node(model, reference, diagnostics);
  if (node < 0) return -1;
  if (!model.dofs.fixed(6 * node + dof) && !prescribed(model, 6 * node + dof)) return 6 * node + dof;
  diagnostics.error(reference.at, fmt::format("{} of node '{}' is held: {}", node_dof_names[static_cast<std::size_t>(dof)],
                                              reference.name, what));
  return -1;
}

void set_pattern(const StageDescription& item, const Model& model, StaticStage& stage, Diagnostics& diagnostics) {
  VectorX full = VectorX::Zero(model.dofs.full);
  for (const NodalLoadDescription& load : item.loads) {
    const int dof = free_dof(model, load.node, load.dof, "a load there does nothing", diagnostics);
    if (dof >= 0) full[dof] += load.value;
  }
  if (item.masses) {
    for (int i = 0; i < model.nodes.size(); ++i) {
      full.segment<3>(6 * i).array() += model.nodal_mass.segment<3>(6 * i).array() * item.masses->array();
    }
  }
  stage.pattern = model.dofs.transformation_transposed * full;
  if (!item.mode && diagnostics.empty() && !(stage.pattern.norm() > 0)) {
    diagnostics.error(item.at, fmt::format("stage '{}' has no load{}", item.name,
                                           item.masses ? ": there is no mass in that direction" : ""));
  }
}

// Whether "structure.mode" names a structure; the mode is looked up when the modes are known.
void set_mode(const StageDescription& item, const Model& model, StaticStage& stage, Diagnostics& diagnostics) {
  if (!item.mode) return;
  stage.mode = item.mode->name;
  stage.mode_at = item.mode->at;
  const std::string structure = stage.mode.substr(0, stage.mode.rfind('.'));
  std::vector<std::string> names;
  for (const Structure& known : model.structures) names.push_back(known.name);
  if (std::find(names.begin(), names.end(), structure) == names.end()) {
    diagnostics.error(item.mode->at, fmt::format("mode = \"{}\": there is no structure '{}'{}", stage.mode, structure,
                                                 did_you_mean(structure, names)));
  }
}

}  // namespace

void build_stages(const ModelDescription& description, Model& model, Diagnostics& diagnostics) {
  std::set<std::string> names;
  for (const StageDescription& item : description.stages) {
    StaticStage stage;
    stage.name = item.name;
    stage.at = item.at;
    stage.options = item.options;
    if (!names.insert(item.name).second) diagnostics.error(item.at, fmt::format("there is another stage '{}'", item.name));
    set_pattern(item, model, stage, diagnostics);
    set_mode(item, model, stage, diagnostics);
    if (item.control_node) {
      const int dof = free_dof(model, *item.control_node, item.control_dof, "it cannot be the control displacement", diagnostics);
      if (dof >= 0) {
        stage.control_row = model.dofs.transformation.row(dof).transpose();
        stage.control_name = fmt::format("{} {}", item.control_node->name, node_dof_names[static_cast<std::size_t>(item.control_dof)]);
      }
    }
    model.stages.push_back(std::move(stage));
  }
}

}  // namespace nsframe
