#include "output/floors.hpp"

#include <algorithm>
#include <cmath>
#include <map>

namespace nsframe {
namespace {

long millimetres(double level) { return std::lround(1e3 * level); }

double level_of(const Model& model, int node) { return model.nodes.position[static_cast<std::size_t>(node)].z(); }

bool carries_mass(const Model& model, int node) { return model.nodal_mass.segment<2>(6 * node).maxCoeff() > 0; }

}  // namespace

std::vector<Floor> floors_of(const Model& model, int structure) {
  std::map<long, Floor> by_level;
  const auto add = [&](double level, const std::vector<int>& nodes) {
    Floor& floor = by_level[millimetres(level)];
    floor.level = level;
    floor.nodes.insert(floor.nodes.end(), nodes.begin(), nodes.end());
  };
  for (const Slab& slab : model.slabs) {
    if (slab.structure != structure || slab.corners.empty()) continue;
    const std::vector<int> nodes = slab.center >= 0 ? std::vector<int>{slab.center} : slab.corners;
    add(level_of(model, nodes.front()), nodes);
  }
  const std::vector<int>& nodes = model.structures[static_cast<std::size_t>(structure)].nodes;
  if (by_level.empty()) {
    for (const int node : nodes) {
      if (carries_mass(model, node)) add(level_of(model, node), {node});
    }
  }
  if (by_level.empty()) return {};
  double base = by_level.begin()->second.level;
  for (const int node : nodes) base = std::min(base, level_of(model, node));
  if (millimetres(base) < by_level.begin()->first) {
    for (const int node : nodes) {
      if (millimetres(level_of(model, node)) == millimetres(base)) add(base, {node});
    }
  }
  std::vector<Floor> floors;
  for (auto& [level, floor] : by_level) floors.push_back(std::move(floor));
  return floors;
}

}  // namespace nsframe
