// Histories of runs at common times, held in memory, and how far one is from another.
#pragma once

#include <vector>

#include "models/results.hpp"

namespace nsframe {

// Keeps the displacements of nodes along x, y, z each `interval` [s], a multiple of the run's dt.
class HistoryRecorder : public MotionObserver {
 public:
  HistoryRecorder(std::vector<int> nodes, double interval, double dt);
  void start(const Model& model, const State& state) override;
  void step(const State& before, const State& after, const StepReport& report, const Energy& energy) override;
  const std::vector<VectorX>& rows() const { return rows_; }  // the first is the start

 private:
  void keep(const State& state);
  std::vector<int> nodes_;
  long every_;  // steps
  const Model* model_ = nullptr;
  std::vector<VectorX> rows_;
};

// Smallest interval [s] that every step divides. Throws InputError where it would leave fewer than ten over `duration`.
double common_interval(const std::vector<double>& steps, double duration);

double largest(const std::vector<VectorX>& rows);
// Over the times that both have; of histories of different length, the common part.
double largest_difference(const std::vector<VectorX>& a, const std::vector<VectorX>& b);

struct Matches {
  int matched = 0, missed = 0, extra = 0;  // missed: of the reference; extra: of the run
};
// Poundings of the same pair that begin less than `window` [s] apart, each counted once, in the order of time.
Matches match(const std::vector<Pounding>& reference, const std::vector<Pounding>& run, double window);

}  // namespace nsframe
