#include "models/build_motions.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "models/dof_names.hpp"

namespace nsframe {

namespace {

// Nodes that a motion moves; empty after an error.
std::vector<int> nodes_of(const MotionDescription& motion, const Nodes& nodes, const std::vector<bool>& fixed, Diagnostics& diagnostics) {
  const auto held = [&](int node, int k) { return fixed[static_cast<std::size_t>(6 * node + k)]; };
  std::vector<int> found;
  bool faulty = false;
  const auto add = [&](int node, const Location& at) {
    for (int k = 0; k < 3; ++k) {
      if (motion.direction[k] == 0 || held(node, k)) continue;
      faulty = true;
      diagnostics.error(at, fmt::format("node '{}' is moved along ({:g}, {:g}, {:g}), but no support holds its {}", nodes.id[static_cast<std::size_t>(node)],
                                        motion.direction.x(), motion.direction.y(), motion.direction.z(), node_dof_names[static_cast<std::size_t>(k)]));
      return;
    }
    found.push_back(node);
  };
  for (const Reference& support : motion.supports) {
    const auto at = std::find(nodes.id.begin(), nodes.id.end(), support.name);
    if (at != nodes.id.end()) {
      add(static_cast<int>(at - nodes.id.begin()), support.at);
    } else {
      faulty = true;
      diagnostics.error(support.at, fmt::format("node '{}' is not defined{}", support.name, did_you_mean(support.name, nodes.id)));
    }
  }
  for (int i = 0; motion.supports.empty() && i < nodes.size(); ++i) {
    bool any = false;
    for (int k = 0; k < 3; ++k) any = any || (motion.direction[k] != 0 && held(i, k));
    if (any) add(i, motion.wave->at);
  }
  if (found.empty() && !faulty) diagnostics.error(motion.at, "no support holds a node along the direction of this motion");
  if (faulty) found.clear();
  return found;
}

}  // namespace

std::vector<MovedSupports> find_moved_supports(const std::vector<MotionDescription>& motions, const Nodes& nodes,
                                               const std::vector<bool>& fixed, Diagnostics& diagnostics) {
  std::vector<MovedSupports> moved;
  for (std::size_t m = 0; m < motions.size(); ++m) {
    const MotionDescription& motion = motions[m];
    if (motion.supports.empty() && !motion.wave) {
      moved.push_back({m, motion.delay, {}});
      continue;
    }
    const std::vector<int> found = nodes_of(motion, nodes, fixed, diagnostics);
    const auto along = [&](int node) { return motion.wave ? motion.wave->direction.dot(nodes.position[static_cast<std::size_t>(node)]) : 0.0; };
    double first = std::numeric_limits<double>::infinity();
    for (const int node : found) first = std::min(first, along(node));
    std::map<double, std::vector<int>> fronts;  // nodes by what the wave has run to them [m]
    for (const int node : found) {
      const double way = along(node) - first;
      auto front = fronts.lower_bound(way - 1e-9);  // m
      if (front == fronts.end() || front->first > way + 1e-9) front = fronts.emplace(way, std::vector<int>{}).first;
      front->second.push_back(node);
    }
    for (const auto& [way, together] : fronts) {
      MovedSupports& supports = moved.emplace_back(MovedSupports{m, motion.delay + (motion.wave ? way / motion.wave->velocity : 0), {}});
      for (const int node : together) {
        for (int k = 0; k < 3; ++k) {
          if (motion.direction[k] != 0) supports.dofs.emplace_back(6 * node + k, motion.direction[k]);
        }
      }
    }
  }
  return moved;
}

bool Model::drives_dofs() const {
  return std::any_of(driven.begin(), driven.end(), [](const VectorX& unit) { return unit.size() > 0; });
}

bool prescribed(const Model& model, int full_dof) {
  for (const VectorX& unit : model.driven) {
    for (SparseRows::InnerIterator entry(model.dofs.transformation, full_dof); unit.size() > 0 && entry; ++entry) {
      if (unit[entry.col()] != 0) return true;
    }
  }
  return false;
}

void add_motions(Model& model, const std::vector<MotionDescription>& motions, const std::vector<MovedSupports>& moved, Diagnostics& diagnostics) {
  std::vector<int> place(static_cast<std::size_t>(model.dofs.full), -1);
  for (std::size_t i = 0; i < model.dofs.free.size(); ++i) {
    place[static_cast<std::size_t>(6 * model.dofs.free[i].node + model.dofs.free[i].direction)] = static_cast<int>(i);
  }
  for (const MovedSupports& supports : moved) {
    const MotionDescription& item = motions[supports.motion];
    GroundMotion motion{item.source, item.direction, item.dt, item.acceleration, {}, supports.delay, !supports.dofs.empty(), {}};
    motion.prepare();
    VectorX load = VectorX::Zero(model.dofs.size()), driven;
    if (supports.dofs.empty()) {
      for (int k = 0; k < 3; ++k) load -= item.direction[k] * model.inertia[static_cast<std::size_t>(k)];
    } else {
      driven = VectorX::Zero(model.dofs.size());
    }
    for (const auto& [dof, part] : supports.dofs) {
      const int at = place[static_cast<std::size_t>(dof)];
      if (at < 0) {
        diagnostics.error(item.at, fmt::format("the moved support of node '{}' is tied to another node: move that one",
                                               model.nodes.id[static_cast<std::size_t>(dof / 6)]));
        continue;
      }
      driven[at] += part;
    }
    model.motion_load.push_back(std::move(load));
    model.driven.push_back(std::move(driven));
    model.motions.push_back(std::move(motion));
  }
}

}  // namespace nsframe
