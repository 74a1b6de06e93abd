#include "output/drifts.hpp"

#include <algorithm>
#include <cmath>

#include "models/snapshot.hpp"
#include "output/floors.hpp"

namespace nsframe {
void DriftTracker::start(const Model& model, const State& state) {
  drifts_.clear();
  stories_.clear();
  std::vector<int> tracked;
  for (int s = 0; s < static_cast<int>(model.structures.size()); ++s) {
    const std::vector<Floor> floors = floors_of(model, s);
    std::vector<int> first_row;
    for (const Floor& floor : floors) {
      first_row.push_back(2 * static_cast<int>(tracked.size()));
      tracked.insert(tracked.end(), floor.nodes.begin(), floor.nodes.end());
    }
    for (std::size_t i = 1; i < floors.size(); ++i) {
      StoryDrift drift;
      drift.structure = model.structures[static_cast<std::size_t>(s)].name;
      drift.story = static_cast<int>(i);
      drift.bottom = floors[i - 1].level;
      drift.top = floors[i].level;
      drifts_.push_back(std::move(drift));
      stories_.push_back({first_row[i - 1], static_cast<int>(floors[i - 1].nodes.size()), first_row[i],
                          static_cast<int>(floors[i].nodes.size()), floors[i].level - floors[i - 1].level});
    }
  }
  rows_ = TransformationRows(model.dofs, full_dofs(tracked, {0, 1}));
  raise(state);
}

double DriftTracker::mean(int first_row, int nodes, const VectorX& q) const {
  double sum = 0;
  for (int i = 0; i < nodes; ++i) sum += rows_.value(first_row + 2 * i, q.data());
  return sum / nodes;
}

void DriftTracker::raise(const State& state) {
  const VectorX& q = state.displacement;
  for (std::size_t i = 0; i < stories_.size(); ++i) {
    const Story& story = stories_[i];
    for (int k = 0; k < 2; ++k) {
      const double relative =
          mean(story.upper_row + k, story.upper_nodes, q) - mean(story.lower_row + k, story.lower_nodes, q);
      drifts_[i].drift[k] = std::max(drifts_[i].drift[k], std::abs(relative) / story.height);
    }
  }
}

void DriftTracker::save(Snapshot& snapshot) {
  std::vector<double> values;
  for (const StoryDrift& drift : drifts_) values.insert(values.end(), {drift.drift.x(), drift.drift.y()});
  snapshot.put("drifts", values);
}

void DriftTracker::resume(const Model& model, const State& state, const Snapshot& snapshot) {
  start(model, state);
  std::vector<double> values(2 * drifts_.size());
  snapshot.read("drifts", values);
  for (std::size_t i = 0; i < drifts_.size(); ++i) drifts_[i].drift = Vector2(values[2 * i], values[2 * i + 1]);
}

void DriftTracker::step(const State&, const State& after, const StepReport&, const Energy&) { raise(after); }

}  // namespace nsframe
