// Largest story drifts over a time history: relative displacement of two floors over the height between them.
#pragma once

#include <string>
#include <vector>

#include "models/results.hpp"
#include "output/node_rows.hpp"

namespace nsframe {

class DriftTracker : public MotionObserver {
 public:
  void start(const Model& model, const State& state) override;
  void step(const State& before, const State& after, const StepReport& report, const Energy& energy) override;
  void save(Snapshot& snapshot) override;
  void resume(const Model& model, const State& state, const Snapshot& snapshot) override;

  // Structure by structure, from the lowest story; none for a structure without height.
  const std::vector<StoryDrift>& drifts() const { return drifts_; }

 private:
  void raise(const State& state);
  double mean(int first_row, int nodes, const VectorX& q) const;

  struct Story {
    int lower_row = 0, lower_nodes = 0, upper_row = 0, upper_nodes = 0;  // x and y rows of each node follow each other
    double height = 0;                                                   // [m]
  };

  std::vector<StoryDrift> drifts_;
  std::vector<Story> stories_;  // of each of drifts_
  TransformationRows rows_;
};

}  // namespace nsframe
