// One line on the terminal that says how far a run is; nothing when standard error is not a terminal.
#pragma once

#include "base/timer.hpp"
#include "models/results.hpp"

namespace nsframe::app {

class ProgressBar : public MotionObserver {
 public:
  ProgressBar(double duration, bool quiet);
  void start(const Model& model, const State& state) override;
  void step(const State& before, const State& after, const StepReport& report, const Energy& energy) override;
  void impact(const Impact&) override { ++impacts_; }
  void finish() override;
  void save(Snapshot& snapshot) override;
  void resume(const Model& model, const State& state, const Snapshot& snapshot) override;

 private:
  void draw(double time) const;

  double duration_, start_ = 0, resumed_ = 0, last_drawn_ = -1;
  bool shown_;
  long impacts_ = 0;
  int steps_ = 0;
  Timer timer_;
};

}  // namespace nsframe::app
