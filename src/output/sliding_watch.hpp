// Where the constant directions of contact (theory.md, "Contact geometry") don't hold: pairs whose gap is wrong by sliding
// along a face that has turned (187), and pairs that touch after one side has slid off the other.
#pragma once

#include <string>
#include <vector>

#include "models/results.hpp"

namespace nsframe {

// The worst of one pair over the run.
struct SlidingFault {
  double gap_error = 0, error_time = 0;  // while the pair was as near as that [m], [s]
  double slid_off = 0, off_time = 0;     // beyond its room, while touching [m], [s]
};

class SlidingWatch : public MotionObserver {
 public:
  void start(const Model& model, const State& state) override;
  void step(const State& before, const State& after, const StepReport& report, const Energy& energy) override;
  void save(Snapshot& snapshot) override;
  void resume(const Model& model, const State& state, const Snapshot& snapshot) override;

  const std::vector<SlidingFault>& faults() const { return faults_; }
  // Plain sentences, one of each sort, that name the worst pair.
  std::vector<std::string> warnings() const;

 private:
  const Model* model_ = nullptr;
  SparseRows measures_;  // rows of a pair: gap, sliding along both tangents, slopes of a along both, slopes of b
  VectorX values_;
  std::vector<SlidingFault> faults_;
};

}  // namespace nsframe
