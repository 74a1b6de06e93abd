// Steps of which nobody reads histories: a scheme may leave these behind there, and nowhere else.
#include <doctest/doctest.h>

#include "integrators/history_reads.hpp"
#include "output/sample_clock.hpp"

using namespace nsframe;

namespace {

class Reader : public Observer {
 public:
  explicit Reader(double rate) : clock(rate) { clock.start(0); }
  double next_history_time() const override { return clock.next_time(); }
  SampleClock clock;
};

}  // namespace

TEST_CASE("history reads: no step that an observer reads comes before the one that was told, whatever the rates") {
  for (const double dt : {1e-3, 0.3e-3, 7e-3}) {
    for (const double rate : {25.0, 40.0, 300.0, 333.0, 1000.0, 2000.0, 1 / 3e-3, 1 / 1.5e-3, 1 / 10.5e-3}) {
      CAPTURE(dt);
      CAPTURE(rate);
      Reader often(rate), seldom(0.7 * rate);
      const std::vector<Observer*> observers{&often, &seldom};
      HistoryReads reads(observers, dt);
      const int steps = 3000;
      int read = 0, early = 0, asked = 0;
      for (int i = 0; i < steps;) {
        const int told = reads.steps(i * dt, steps - i);
        REQUIRE(told >= 1);
        REQUIRE(told <= steps - i);
        ++asked;
        for (int k = 1; k <= told; ++k) {
          const bool first = often.clock.due((i + k - 1) * dt, (i + k) * dt), second = seldom.clock.due((i + k - 1) * dt, (i + k) * dt);
          if (!first && !second) continue;
          ++read;
          if (k < told) ++early;
        }
        i += told;
      }
      CHECK(early == 0);
      CHECK(asked <= 2 * read + 2);  // not step by step without need
    }
  }
}

TEST_CASE("history reads: without observers, or with one that reads every step") {
  const std::vector<Observer*> none;
  CHECK(HistoryReads(none, 1e-3).steps(0, 50) == 50);
  Observer every;
  const std::vector<Observer*> one{&every};
  CHECK(HistoryReads(one, 1e-3).steps(0, 50) == 1);
  CHECK(HistoryReads(one, 1e-3).steps(1, 1) == 1);
}
