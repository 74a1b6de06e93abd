#include "output/node_rows.hpp"

#include <fmt/format.h>

#include <numeric>
#include <unordered_map>

#include "base/diagnostics.hpp"
#include "base/errors.hpp"

namespace nsframe {

TransformationRows::TransformationRows(const DofMap& dofs, const std::vector<int>& full_dofs) {
  begin_.reserve(full_dofs.size() + 1);
  for (const int full : full_dofs) {
    for (SparseRows::InnerIterator entry(dofs.transformation, full); entry; ++entry) {
      column_.push_back(static_cast<int>(entry.col()));
      factor_.push_back(entry.value());
    }
    begin_.push_back(static_cast<int>(column_.size()));
  }
}

std::vector<int> find_nodes(const Nodes& nodes, const std::vector<std::string>& names) {
  if (names.empty()) {
    std::vector<int> all(static_cast<std::size_t>(nodes.size()));
    std::iota(all.begin(), all.end(), 0);
    return all;
  }
  std::unordered_map<std::string, int> index;
  for (int i = 0; i < nodes.size(); ++i) index.emplace(nodes.id[static_cast<std::size_t>(i)], i);
  std::vector<int> found;
  std::string errors;
  for (const auto& name : names) {
    const auto at = index.find(name);
    if (at != index.end()) {
      found.push_back(at->second);
    } else {
      errors += fmt::format("{}output: node '{}' does not exist{}", errors.empty() ? "" : "\n", name,
                            did_you_mean(name, nodes.id));
    }
  }
  if (!errors.empty()) throw InputError(errors);
  return found;
}

std::vector<int> full_dofs(const std::vector<int>& nodes, const std::vector<int>& directions) {
  std::vector<int> full;
  full.reserve(nodes.size() * directions.size());
  for (const int node : nodes) {
    for (const int direction : directions) full.push_back(6 * node + direction);
  }
  return full;
}

Vector3 ground_velocity(const Model& model, double time) {
  Vector3 velocity = Vector3::Zero();
  for (const auto& motion : model.motions) {
    if (!motion.of_supports) velocity += motion.velocity_at(time) * motion.direction;
  }
  return velocity;
}

Vector3 ground_acceleration(const Model& model, double time) {
  Vector3 acceleration = Vector3::Zero();
  for (const auto& motion : model.motions) {
    if (!motion.of_supports) acceleration += motion.acceleration_at(time) * motion.direction;
  }
  return acceleration;
}

}  // namespace nsframe
