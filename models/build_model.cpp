#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <numeric>
#include <set>

#include "models/build_constants.hpp"
#include "models/build_contacts.hpp"
#include "models/build_elements.hpp"
#include "models/build_motions.hpp"
#include "models/constraints.hpp"
#include "models/dof_names.hpp"
#include "models/model.hpp"

namespace nsframe {

namespace {

// Connected components of the nodes.
class Components {
 public:
  explicit Components(int count) : parent_(static_cast<std::size_t>(count)) { std::iota(parent_.begin(), parent_.end(), 0); }
  int root(int i) {
    while (parent_[static_cast<std::size_t>(i)] != i) i = parent_[static_cast<std::size_t>(i)] = parent_[static_cast<std::size_t>(parent_[static_cast<std::size_t>(i)])];
    return i;
  }
  void join(int i, int j) {
    if (i >= 0 && j >= 0) parent_[static_cast<std::size_t>(std::max(root(i), root(j)))] = std::min(root(i), root(j));
  }

 private:
  std::vector<int> parent_;
};

class ModelBuilder {
 public:
  ModelBuilder(const ModelDescription& description, Diagnostics& diagnostics)
      : description_(description), diagnostics_(diagnostics), library_(build_library(description, diagnostics)),
        groups_(library_, description.gravity.acceleration, diagnostics) {}

  Model build() {
    for (const StructureDescription& structure : description_.structures) add_nodes(structure);
    for (const StructureDescription& structure : description_.structures) {
      add_elements(structure);
      add_constraints(structure);
      add_supports(structure);
      add_masses(structure);
      add_slabs(structure);
    }
    concentrated_mass_ = model_.nodal_mass;
    share_member_masses(model_, groups_.masses());
    model_.groups = groups_.take();
    lay_out_histories();
    find_structures();
    release_unstressed_rotations();
    const std::vector<MovedSupports> moved = find_moved_supports(description_.motions, model_.nodes, fixed_, diagnostics_);
    for (const MovedSupports& supports : moved) {
      for (const auto& [dof, part] : supports.dofs) {
        fixed_[static_cast<std::size_t>(dof)] = false;
        driven_.insert(dof);
      }
    }
    number_dofs();
    for (const StructureDescription& structure : description_.structures) set_initial_values(structure);
    model_.contacts = build_contacts(description_, model_, diagnostics_);
    require_freedom();
    diagnostics_.throw_if_any();
    assemble_constants(model_, concentrated_mass_, groups_.masses(), description_.gravity);
    add_motions(model_, description_.motions, moved, diagnostics_);
    build_stages(description_, model_, diagnostics_);
    diagnostics_.throw_if_any();
    return std::move(model_);
  }

 private:
  void add_nodes(const StructureDescription& structure);
  std::map<std::string, std::vector<const LoadDescription*>> loads_by_element(const StructureDescription& structure);
  void add_elements(const StructureDescription& structure);
  void add_constraints(const StructureDescription& structure);
  void add_supports(const StructureDescription& structure);
  void add_masses(const StructureDescription& structure);
  void add_slabs(const StructureDescription& structure);
  void lay_out_histories();
  void find_structures();
  void release_unstressed_rotations();
  VectorX resistance() const;
  void number_dofs();
  void require_freedom();
  void set_initial_values(const StructureDescription& structure);
  int node(const StructureDescription& structure, const Reference& reference);
  bool new_id(const std::string& id, const Location& at, const char* what);

  const ModelDescription& description_;
  Diagnostics& diagnostics_;
  Library library_;
  GroupBuilder groups_;
  Model model_;
  std::map<std::string, int> node_index_;          // "structure.node"
  std::vector<Location> node_at_;
  std::vector<int> node_description_;              // structure description of every node
  std::set<std::string> ids_;
  std::vector<bool> mentioned_;                    // nodes that something refers to
  std::vector<bool> fixed_;                        // full DOFs
  std::set<int> driven_;                           // full DOFs that a motion prescribes, which are no longer fixed_
  std::vector<NodeConstraint> constraints_;
  VectorX concentrated_mass_;                      // of nodes, without the members' own
};

int ModelBuilder::node(const StructureDescription& structure, const Reference& reference) {
  const auto found = node_index_.find(structure.name + "." + reference.name);
  if (found != node_index_.end()) {
    mentioned_[static_cast<std::size_t>(found->second)] = true;
    return found->second;
  }
  if (reference.name.empty() && !diagnostics_.empty()) return -1;  // what should have named it was told
  std::vector<std::string> known;
  for (const NodeDescription& candidate : structure.nodes) known.push_back(candidate.id);
  diagnostics_.error(reference.at, fmt::format("node '{}' is not defined in structure '{}'{}", reference.name,
                                               structure.name, did_you_mean(reference.name, known)));
  return -1;
}

bool ModelBuilder::new_id(const std::string& id, const Location& at, const char* what) {
  if (ids_.insert(std::string(what) + " " + id).second) return true;
  diagnostics_.error(at, fmt::format("{} '{}' is defined twice", what, id));
  return false;
}

void ModelBuilder::add_nodes(const StructureDescription& structure) {
  new_id(structure.name, structure.at, "structure");
  const int index = static_cast<int>(&structure - description_.structures.data());
  for (const NodeDescription& item : structure.nodes) {
    const std::string id = structure.name + "." + item.id;
    if (!new_id(id, item.at, "node")) continue;
    if (!item.position.allFinite()) diagnostics_.error(item.at, fmt::format("node '{}': coordinates must be finite", id));
    node_index_[id] = model_.nodes.size();
    model_.nodes.id.push_back(id);
    model_.nodes.position.push_back(item.position);
    node_at_.push_back(item.at);
    node_description_.push_back(index);
  }
  mentioned_.resize(node_at_.size(), false);
  fixed_.resize(6 * node_at_.size(), false);
  model_.nodal_mass = VectorX::Zero(static_cast<Eigen::Index>(fixed_.size()));
}

// The loads of a structure by the element that they act on.
std::map<std::string, std::vector<const LoadDescription*>> ModelBuilder::loads_by_element(const StructureDescription& structure) {
  std::set<std::string> known;
  for (const ElementDescription& element : structure.elements) known.insert(element.id);
  std::map<std::string, std::vector<const LoadDescription*>> loads;
  for (const LoadDescription& load : structure.loads) {
    if (!(load.position >= 0 && load.position <= 1)) {
      diagnostics_.error(load.at, fmt::format("a load at {} of the beam's length, must lie in [0, 1]", load.position));
    }
    for (const Reference& element : load.elements) {
      if (known.count(element.name)) {
        loads[element.name].push_back(&load);
      } else {
        diagnostics_.error(element.at, fmt::format("element '{}' is not defined in structure '{}'{}", element.name, structure.name,
                                                   did_you_mean(element.name, {known.begin(), known.end()})));
      }
    }
  }
  return loads;
}

void ModelBuilder::add_elements(const StructureDescription& structure) {
  const auto loads = loads_by_element(structure);
  for (const ElementDescription& element : structure.elements) {
    const std::string id = structure.name + "." + element.id;
    const ElementNodes nodes{node(structure, element.node_i), node(structure, element.node_j)};
    if (!new_id(id, element.at, "element") || nodes[0] < 0 || nodes[1] < 0) continue;
    const auto& position = model_.nodes.position;
    const auto acting = loads.find(element.id);
    groups_.add(element, nodes, position[static_cast<std::size_t>(nodes[0])], position[static_cast<std::size_t>(nodes[1])], id,
                acting == loads.end() ? std::vector<const LoadDescription*>{} : acting->second);
  }
  for (const SpringDescription& spring : structure.springs) {
    const std::string id = structure.name + "." + spring.id;
    const ElementNodes nodes{node(structure, spring.node_i), spring.node_j ? node(structure, *spring.node_j) : -1};
    if (!new_id(id, spring.at, "element") || nodes[0] < 0 || (spring.node_j && nodes[1] < 0)) continue;
    if ((spring.stiffness.array() < 0).any() || (spring.damping.array() < 0).any()) {
      diagnostics_.error(spring.at, fmt::format("spring '{}': negative stiffness or damping", id));
    }
    if (spring.shear_distance && !spring.node_j) {
      diagnostics_.error(spring.at, fmt::format("link '{}' needs two nodes", id));
      continue;
    }
    const auto place = [this](int at) { return at < 0 ? Vector3(Vector3::Zero()) : model_.nodes.position[static_cast<std::size_t>(at)]; };
    groups_.add(spring, nodes, place(nodes[0]), place(nodes[1]), id);
  }
}

void ModelBuilder::add_constraints(const StructureDescription& structure) {
  for (const ConstraintDescription& item : structure.constraints) {
    const int master = node(structure, item.master);
    for (const Reference& reference : item.slaves) {
      const int slave = node(structure, reference);
      if (master < 0 || slave < 0) continue;
      if (master == slave) {
        diagnostics_.error(reference.at, fmt::format("node '{}' cannot follow itself", reference.name));
        continue;
      }
      const Vector3 arm = model_.nodes.position[static_cast<std::size_t>(slave)] - model_.nodes.position[static_cast<std::size_t>(master)];
      switch (item.kind) {
        case ConstraintKind::rigid_body: constraints_.push_back(rigid_body_constraint(master, slave, arm, item.at)); break;
        case ConstraintKind::diaphragm: constraints_.push_back(diaphragm_constraint(master, slave, arm, item.normal, item.at)); break;
        case ConstraintKind::equal_dof: constraints_.push_back(equal_dof_constraint(master, slave, item.dofs, item.at)); break;
      }
    }
  }
}

void ModelBuilder::add_supports(const StructureDescription& structure) {
  for (const SupportDescription& support : structure.supports) {
    const int at = node(structure, support.node);
    for (std::size_t k = 0; at >= 0 && k < 6; ++k) {
      if (support.fixed[k]) fixed_[6 * static_cast<std::size_t>(at) + k] = true;
    }
  }
}

void ModelBuilder::add_masses(const StructureDescription& structure) {
  for (const MassDescription& item : structure.masses) {
    const int at = node(structure, item.node);
    if (at < 0) continue;
    Vector6 mass;
    mass << item.mass, item.inertia;
    if (!(mass.array() >= 0).all() || !mass.allFinite()) {
      diagnostics_.error(item.node.at, fmt::format("mass of node '{}.{}' must be positive or zero", structure.name, item.node.name));
      continue;
    }
    model_.nodal_mass.segment<6>(6 * at) += mass;
  }
}

void ModelBuilder::add_slabs(const StructureDescription& structure) {
  for (const SlabDescription& item : structure.slabs) {
    Slab slab;
    slab.id = structure.name + "." + item.id;
    new_id(slab.id, item.at, "slab");
    for (const Reference& corner : item.corners) slab.corners.push_back(node(structure, corner));
    if (slab.corners.size() < 3) diagnostics_.error(item.at, fmt::format("slab '{}' needs at least three corners", slab.id));
    if (item.center) slab.center = node(structure, *item.center);
    slab.thickness = item.thickness;
    slab.rigid = item.rigid;
    slab.description = static_cast<int>(&structure - description_.structures.data());
    model_.slabs.push_back(std::move(slab));
  }
}

void ModelBuilder::lay_out_histories() {
  model_.history_begin.assign(1, 0);
  for (const auto& group : model_.groups) {
    model_.history_begin.push_back(model_.history_begin.back() + aligned_size(group->history_begin(group->size())));
  }
}

void ModelBuilder::find_structures() {
  const int count = model_.nodes.size();
  Components components(count);
  for (const auto& group : model_.groups) {
    for (int e = 0; e < group->size(); ++e) components.join(group->nodes(e)[0], group->nodes(e)[1]);
  }
  for (const NodeConstraint& constraint : constraints_) components.join(constraint.master, constraint.slave);
  std::map<int, std::vector<int>> members;  // by root, in the order of the nodes
  for (int i = 0; i < count; ++i) members[components.root(i)].push_back(i);
  std::map<int, int> parts;
  for (const auto& [root, nodes] : members) ++parts[node_description_[static_cast<std::size_t>(root)]];
  std::map<int, int> seen;
  model_.nodes.structure.assign(static_cast<std::size_t>(count), -1);
  for (const auto& [root, nodes] : members) {
    const int which = node_description_[static_cast<std::size_t>(root)];
    const StructureDescription& description = description_.structures[static_cast<std::size_t>(which)];
    Structure structure{description.name, description.at, 0, 0, nodes, description.damping, description.may_move_freely};
    const int part = ++seen[which];
    if (parts[which] > 1) structure.name += fmt::format("/{}", part);
    for (const int i : nodes) model_.nodes.structure[static_cast<std::size_t>(i)] = static_cast<int>(model_.structures.size());
    model_.structures.push_back(std::move(structure));
  }
  for (Slab& slab : model_.slabs) {
    if (!slab.corners.empty() && slab.corners[0] >= 0) slab.structure = model_.nodes.structure[static_cast<std::size_t>(slab.corners[0])];
  }
}

// Absolute diagonal of stiffness and mass, full DOFs.
VectorX ModelBuilder::resistance() const {
  VectorX resistance = model_.nodal_mass;
  VectorX history(model_.history_size()), trial(model_.history_size());
  for (std::size_t g = 0; g < model_.groups.size(); ++g) {
    const ElementGroup& group = *model_.groups[g];
    for (int e = 0; e < group.size(); ++e) {
      const int begin = model_.history_begin[g] + group.history_begin(e);
      group.initialize_history(e, history.data() + begin);
      group.start_step(e, history.data() + begin, trial.data() + begin);
      Vector12 force;
      Matrix12 tangent;
      group.respond(e, Vector12::Zero(), history.data() + begin, trial.data() + begin, force, &tangent);
      for (int end = 0; end < 2; ++end) {
        const int at = group.nodes(e)[static_cast<std::size_t>(end)];
        if (at >= 0) resistance.segment<6>(6 * at) += tangent.diagonal().segment<6>(6 * end).cwiseAbs();
      }
    }
  }
  return resistance;
}

// Rotations that nothing resists and that carry no inertia (nodes of trusses) are held, so that users need not do it.
// A translation, or a whole node, that nothing resists and that has no mass is an error. After other errors elements
// are missing or have no valid law: then only nodes are reported that nothing refers to.
void ModelBuilder::release_unstressed_rotations() {
  const bool complete = diagnostics_.empty();
  const VectorX resistance = complete ? this->resistance() : VectorX::Zero(model_.nodal_mass.size());
  std::vector<bool> tied(fixed_.size(), false);
  for (const NodeConstraint& c : constraints_) {
    for (std::size_t k = 0; k < 6; ++k) tied[6 * static_cast<std::size_t>(c.slave) + k] = tied[6 * static_cast<std::size_t>(c.slave) + k] || c.constrained[k];
    for (int k = 0; k < 6; ++k) {
      if (c.follows.col(k).any()) tied[6 * static_cast<std::size_t>(c.master) + static_cast<std::size_t>(k)] = true;
    }
  }
  for (int i = 0; i < model_.nodes.size(); ++i) {
    if (!complete && mentioned_[static_cast<std::size_t>(i)]) continue;
    for (int k = 0; k < 6; ++k) {
      const auto dof = static_cast<std::size_t>(6 * i + k);
      if (fixed_[dof] || tied[dof] || resistance[static_cast<Eigen::Index>(dof)] > 0) continue;
      if (k >= 3) {
        fixed_[dof] = true;
      } else {
        diagnostics_.error(node_at_[static_cast<std::size_t>(i)],
                           fmt::format("node '{}' is not held in {}: no element with stiffness, support or mass acts there",
                                       model_.nodes.id[static_cast<std::size_t>(i)], node_dof_names[static_cast<std::size_t>(k)]));
        break;
      }
    }
  }
}

void ModelBuilder::number_dofs() {
  std::vector<int> order;
  for (const Structure& structure : model_.structures) order.insert(order.end(), structure.nodes.begin(), structure.nodes.end());
  model_.dofs = build_dof_map(fixed_, constraints_, order, model_.nodes.id, diagnostics_);
  int dof = 0;
  for (std::size_t s = 0; s < model_.structures.size(); ++s) {
    model_.structures[s].first_dof = dof;
    while (dof < model_.dofs.size() &&
           model_.nodes.structure[static_cast<std::size_t>(model_.dofs.free[static_cast<std::size_t>(dof)].node)] == static_cast<int>(s)) {
      ++dof;
    }
    model_.structures[s].last_dof = dof;
  }
  model_.initial_displacement = model_.initial_velocity = VectorX::Zero(model_.dofs.size());
}

void ModelBuilder::require_freedom() {
  if (!diagnostics_.empty() || model_.dofs.size() > static_cast<int>(driven_.size())) return;
  diagnostics_.error(description_.structures.empty() ? Location{} : description_.structures.front().at,
                     description_.structures.empty() ? "there is no structure"
                                                     : "nothing can move: supports hold every degree of freedom");
}

void ModelBuilder::set_initial_values(const StructureDescription& structure) {
  const auto set = [&](const std::vector<InitialDescription>& items, VectorX& values) {
    for (const InitialDescription& item : items) {
      const int at = node(structure, item.node);
      if (at < 0) continue;
      const auto free = std::find_if(model_.dofs.free.begin(), model_.dofs.free.end(),
                                     [&](const FreeDof& dof) { return dof.node == at && dof.direction == item.dof; });
      if (free == model_.dofs.free.end() || driven_.count(6 * at + item.dof) > 0) {
        diagnostics_.error(item.node.at, fmt::format("{} of node '{}.{}' is not free: its initial value cannot be set",
                                                     node_dof_names[static_cast<std::size_t>(item.dof)], structure.name, item.node.name));
        continue;
      }
      values[free - model_.dofs.free.begin()] = item.value;
    }
  };
  set(structure.initial_displacements, model_.initial_displacement);
  set(structure.initial_velocities, model_.initial_velocity);
}

}  // namespace

Model build_model(const ModelDescription& description, Diagnostics& diagnostics) {
  return ModelBuilder(description, diagnostics).build();
}

}  // namespace nsframe
