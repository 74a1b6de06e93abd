#include "output/peaks.hpp"

#include <algorithm>
#include <cmath>

#include "models/snapshot.hpp"

namespace nsframe {
namespace {

void raise(double& peak, double value) { peak = std::max(peak, std::abs(value)); }

}  // namespace

void PeakTracker::start(const Model& model, const State& state) {
  model_ = &model;
  const auto nodes = find_nodes(model.nodes, names_);
  names_.clear();
  level_.clear();
  for (const int node : nodes) {
    names_.push_back(model.nodes.id[static_cast<std::size_t>(node)]);
    level_.push_back(model.nodes.position[static_cast<std::size_t>(node)].z());
  }
  moving_ = TransformationRows(model.dofs, full_dofs(nodes, {0, 1, 2, 5}));
  displacement_.assign(4 * nodes.size(), 0.0);
  velocity_.assign(3 * nodes.size(), 0.0);
  peak_acceleration_.assign(3 * nodes.size(), 0.0);
  ground_velocity_ = ground_velocity(model, state.time);
  raise_displacements(state);
  raise_velocities(state);
}

void PeakTracker::raise_displacements(const State& state) {
  for (int row = 0; row < moving_.size(); ++row) {
    raise(displacement_[static_cast<std::size_t>(row)], moving_.value(row, state.displacement.data()));
  }
}

void PeakTracker::raise_velocities(const State& state) {
  for (std::size_t i = 0; i < velocity_.size(); ++i) {
    raise(velocity_[i], moving_.value(static_cast<int>(i / 3 * 4 + i % 3), state.velocity.data()));
  }
}

void PeakTracker::step(const State& before, const State& after, const StepReport&, const Energy&) {
  raise_displacements(after);
  raise_velocities(after);
  const double inverse_dt = 1 / (after.time - before.time);
  const Vector3 ground_velocity_after = ground_velocity(*model_, after.time);
  const Vector3 ground = inverse_dt * (ground_velocity_after - ground_velocity_);
  ground_velocity_ = ground_velocity_after;
  acceleration_ = inverse_dt * (after.velocity - before.velocity);
  for (std::size_t i = 0; i < peak_acceleration_.size(); ++i) {
    const double relative = moving_.value(static_cast<int>(i / 3 * 4 + i % 3), acceleration_.data());
    raise(peak_acceleration_[i], relative + ground[static_cast<Eigen::Index>(i % 3)]);
  }
}

void PeakTracker::save(Snapshot& snapshot) {
  snapshot.put("peaks.displacement", displacement_);
  snapshot.put("peaks.velocity", velocity_);
  snapshot.put("peaks.acceleration", peak_acceleration_);
}

void PeakTracker::resume(const Model& model, const State& state, const Snapshot& snapshot) {
  start(model, state);
  snapshot.read("peaks.displacement", displacement_);
  snapshot.read("peaks.velocity", velocity_);
  snapshot.read("peaks.acceleration", peak_acceleration_);
}

std::vector<Peak> PeakTracker::peaks() const {
  std::vector<Peak> peaks(names_.size());
  for (std::size_t i = 0; i < names_.size(); ++i) {
    peaks[i].node = names_[i];
    for (std::size_t k = 0; k < 3; ++k) {
      const auto component = static_cast<Eigen::Index>(k);
      peaks[i].displacement[component] = displacement_[4 * i + k];
      peaks[i].velocity[component] = velocity_[3 * i + k];
      peaks[i].acceleration[component] = peak_acceleration_[3 * i + k];
    }
    peaks[i].twist = displacement_[4 * i + 3];
    peaks[i].level = level_[i];
  }
  return peaks;
}

}  // namespace nsframe
