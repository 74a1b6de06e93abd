// Which steps of a time history to keep when a fixed rate is asked for.
#pragma once

#include <cmath>
#include <limits>

namespace nsframe {

// Marks the step nearest to each multiple of 1 / rate; the first state counts as kept.
class SampleClock {
 public:
  explicit SampleClock(double rate = 0) : rate_(rate) {}  // [Hz]; 0: every step

  void start(double time) { next_ = std::floor(time * rate_ + 1e-6) + 1; }

  double next() const { return next_; }
  // [s]; before everything where every step is kept.
  double next_time() const { return rate_ > 0 ? next_ / rate_ : -std::numeric_limits<double>::infinity(); }
  void resume(double next) { next_ = next; }

  // True when the step that ends at `after` is the nearest to the next sample. Steps have one length, so the next
  // step would end at after + (after - before).
  bool due(double before, double after) {
    if (rate_ <= 0) return true;
    const double reach = (after + 0.5 * (after - before)) * rate_;
    if (next_ >= reach) return false;
    next_ = std::ceil(reach);
    return true;
  }

 private:
  double rate_;
  double next_ = 0;  // number of the next sample
};

}  // namespace nsframe
