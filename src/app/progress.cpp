#include "app/progress.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>

#include "models/snapshot.hpp"

namespace nsframe::app {

namespace {

constexpr int steps_between_looks = 64;    // at the clock
constexpr double seconds_between_draws = 0.1;

}  // namespace

ProgressBar::ProgressBar(double duration, bool quiet) : duration_(duration), shown_(!quiet && isatty(STDERR_FILENO) != 0) {}

void ProgressBar::start(const Model&, const State& state) { start_ = resumed_ = state.time; }

void ProgressBar::save(Snapshot& snapshot) {
  snapshot.put("progress.start", start_);
  snapshot.put("progress.impacts", static_cast<double>(impacts_));
}

void ProgressBar::resume(const Model&, const State& state, const Snapshot& snapshot) {
  start_ = snapshot.number("progress.start");
  impacts_ = static_cast<long>(snapshot.number("progress.impacts"));
  resumed_ = state.time;
}

void ProgressBar::step(const State&, const State& after, const StepReport&, const Energy&) {
  if (!shown_ || ++steps_ % steps_between_looks != 0) return;
  const double now = timer_.seconds();
  if (now - last_drawn_ < seconds_between_draws) return;
  last_drawn_ = now;
  draw(after.time);
}

void ProgressBar::draw(double time) const {
  constexpr int width = 30;
  const double part = std::clamp((time - start_) / duration_, 0.0, 1.0);
  const int full = static_cast<int>(part * width);
  const double elapsed = timer_.seconds();
  const double made = time - resumed_, to_make = start_ + duration_ - time;
  const std::string left = made > 0.01 * duration_ ? fmt::format("{:.0f} s left", elapsed * to_make / made) : "";
  fmt::print(stderr, "\r[{:=<{}}{:{}}] {:7.3f} of {:g} s, {} impacts, {:<14}", "", full, "", width - full, time,
             start_ + duration_, impacts_, left);
  std::fflush(stderr);
}

void ProgressBar::finish() {
  if (shown_) fmt::print(stderr, "\r{:100}\r", "");
}

}  // namespace nsframe::app
