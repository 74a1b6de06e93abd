// When the histories of elements are read next, for schemes that leave them behind in between.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "models/results.hpp"

namespace nsframe {

class HistoryReads {
 public:
  HistoryReads(const std::vector<Observer*>& observers, double dt) : observers_(observers), dt_(dt) {}

  // How many steps from `time` on [s] until one that ends where an observer reads them, at most `left`.
  int steps(double time, int left) {
    if (time + 0.5 * dt_ >= next_) {
      next_ = std::numeric_limits<double>::infinity();
      for (const Observer* observer : observers_) next_ = std::min(next_, observer->next_history_time());
    }
    // to the nearest step, or the one before it where rounding decides which one that is
    const double steps = std::floor((next_ - time) / dt_ - 0.5 - 1e-6) + 1;
    return steps < left ? static_cast<int>(std::max(1.0, steps)) : left;
  }

 private:
  const std::vector<Observer*>& observers_;
  double dt_;
  double next_ = -std::numeric_limits<double>::infinity();  // of all observers [s]; asked for anew when it has come
};

}  // namespace nsframe
