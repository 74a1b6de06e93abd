// An observer that keeps every state and impact of a time history.
#pragma once

#include <vector>

#include "models/results.hpp"

namespace nsframe::test {

class Recorder : public Observer {
 public:
  std::vector<State> states;
  std::vector<Impact> impacts;
  void start(const Model&, const State& state) override { states.push_back(state); }
  void step(const State&, const State& after, const StepReport&, const Energy&) override { states.push_back(after); }
  void impact(const Impact& impact) override { impacts.push_back(impact); }
};

}  // namespace nsframe::test
