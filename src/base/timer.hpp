// Wall-clock time.
#pragma once

#include <chrono>
#include <cstdint>
#if defined(__x86_64__)
#include <x86intrin.h>
#endif

namespace nsframe {

class Timer {
 public:
  double seconds() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

// A timer that knows how much of its time went to some calls, which may be as short as the reading of a clock: these are measured as a
// share, by the processor's counter where it has one that takes less.
class SharedTimer {
 public:
  double seconds() const { return timer_.seconds(); }
  template <class Call>
  void apart(const Call& call) {
    const std::uint64_t before = ticks();
    call();
    apart_ += ticks() - before;
  }
  double apart_seconds() const { return apart_ == 0 ? 0 : seconds() * static_cast<double>(apart_) / static_cast<double>(ticks() - start_); }

 private:
  static std::uint64_t ticks() {
#if defined(__x86_64__)
    return __rdtsc();
#else
    return static_cast<std::uint64_t>(std::chrono::steady_clock::now().time_since_epoch().count());
#endif
  }

  Timer timer_;
  std::uint64_t start_ = ticks(), apart_ = 0;
};

}  // namespace nsframe
