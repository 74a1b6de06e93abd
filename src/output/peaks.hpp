// Largest displacements, velocities and accelerations of chosen nodes over a time history.
#pragma once

#include <string>
#include <vector>

#include "models/results.hpp"
#include "output/node_rows.hpp"

namespace nsframe {

class PeakTracker : public MotionObserver {
 public:
  // "structure.node"; empty: all nodes
  explicit PeakTracker(std::vector<std::string> nodes = {}) : names_(std::move(nodes)) {}

  void start(const Model& model, const State& state) override;
  void step(const State& before, const State& after, const StepReport& report, const Energy& energy) override;
  void save(Snapshot& snapshot) override;
  void resume(const Model& model, const State& state, const Snapshot& snapshot) override;

  std::vector<Peak> peaks() const;

 private:
  void raise_displacements(const State& state);
  void raise_velocities(const State& state);

  std::vector<std::string> names_;
  const Model* model_ = nullptr;
  TransformationRows moving_;  // ux, uy, uz, rz of each node
  Vector3 ground_velocity_ = Vector3::Zero();
  VectorX acceleration_;                   // free DOFs, relative to the base [m/s2]
  std::vector<double> level_;              // z of each node [m]
  std::vector<double> displacement_;       // 4 a node
  std::vector<double> velocity_;           // 3 a node
  std::vector<double> peak_acceleration_;  // 3 a node
};

}  // namespace nsframe
