// What those who watch a run are shown: the states that the scheme steps or, where it works on a model made smaller, those of the model
// that the scene describes.
#pragma once

#include "models/reduction.hpp"
#include "models/results.hpp"

namespace nsframe {

// The model that a smaller one stands for, and the way back to it.
struct LargerModel {
  const Model* model = nullptr;
  Reduction reduction;
};

// A state of the larger model while it is looked at. What both models have alike - histories of elements, impulses - may be long: it is
// lent to `shown`, and goes back at the end.
class LentState {
 public:
  LentState(State& owner, State& shown) : owner_(owner), shown_(shown) { exchange(); }
  ~LentState() { exchange(); }
  LentState(const LentState&) = delete;
  LentState& operator=(const LentState&) = delete;

 private:
  void exchange() {
    owner_.history.swap(shown_.history);
    owner_.impulse.swap(shown_.impulse);
    owner_.contact_episodes.swap(shown_.contact_episodes);
  }
  State &owner_, &shown_;
};

// Shows observers the states of a run; without a larger model, the run's own.
class ShownStates {
 public:
  ShownStates(const Model& own, const LargerModel* larger) : own_(own), larger_(larger) {}

  // Calls look(model, state) with the first state, that of a start or a resumption.
  template <class Look>
  void begin(State& state, const Look& look) {
    if (!larger_) return look(own_, state);
    larger_->reduction.expand(state, larger_->model->motions, after_);
    const LentState lent(state, after_);
    look(*larger_->model, after_);
  }
  // Calls look(before, after, report) with the step from the state shown last; jumps of velocity are expanded too.
  template <class Look>
  void step(State& before, State& after, const StepReport& report, const Look& look) {
    if (!larger_) return look(before, after, report);
    std::swap(before_, after_);
    larger_->reduction.expand(after, larger_->model->motions, after_);
    const LentState lent_before(before, before_), lent_after(after, after_);
    if (report.jumps.empty()) return look(before_, after_, report);
    StepReport expanded = report;
    for (VelocityJump& jump : expanded.jumps) jump.change = larger_->reduction.expand_change(jump.change);
    look(before_, after_, expanded);
  }

 private:
  const Model& own_;
  const LargerModel* larger_;
  State before_, after_;
};

}  // namespace nsframe
