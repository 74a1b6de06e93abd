// Target spectra by hand, and artificial motions against them by an integrator of its own.
#include "motion/target.hpp"

#include <doctest/doctest.h>
#include <fmt/format.h>

#include <cmath>

#include "base/types.hpp"
#include "motion/artificial.hpp"
#include "motion/history.hpp"
#include "motion/record.hpp"
#include "spectra/oscillators.hpp"
#include "tests/support/files.hpp"

using namespace nsframe;

namespace {

// Largest pseudo-acceleration by Newmark's average acceleration on the record's straight lines, `parts` steps a sample:
// another method than that of the program, with an error of (w h)^2 / 12 of the period.
double newmark(const std::vector<double>& a, double dt, double period, double xi) {
  const double w = 2 * pi / period;
  const int parts = static_cast<int>(std::ceil(60 * dt * w));
  const double h = dt / parts, mass = 1 + xi * w * h + w * w * h * h / 4;
  double u = 0, v = 0, acc = -a.front(), peak = 0;
  for (std::size_t i = 0; i + 1 < a.size(); ++i) {
    for (int k = 1; k <= parts; ++k) {
      const double ground = a[i] + (a[i + 1] - a[i]) * k / parts;
      const double u_guess = u + h * v + h * h / 4 * acc, v_guess = v + h / 2 * acc;
      const double next = (-ground - 2 * xi * w * v_guess - w * w * u_guess) / mass;
      u = u_guess + h * h / 4 * next;
      v = v_guess + h / 2 * next;
      acc = next;
      peak = std::max(peak, std::abs(u));
    }
  }
  return w * w * peak;
}

}  // namespace

TEST_CASE("the spectrum of Eurocode 8 has the values of its four branches") {
  const TargetSpectrum b = eurocode8({1, 'B', 2, 0.05});  // S 1.2, T 0.15, 0.5, 2
  CHECK(b.acceleration(0) == doctest::Approx(2.4));
  CHECK(b.acceleration(0.075) == doctest::Approx(2.4 * 1.75));
  CHECK(b.acceleration(0.3) == doctest::Approx(6));
  CHECK(b.acceleration(1) == doctest::Approx(3));
  CHECK(b.acceleration(4) == doctest::Approx(6 * 0.5 * 2 / 16));
  const TargetSpectrum d = eurocode8({2, 'D', 1, 0.02});  // S 1.8, T 0.1, 0.3, 1.2; eta = sqrt(10 / 7)
  CHECK(d.acceleration(0.2) == doctest::Approx(1.8 * 2.5 * std::sqrt(10.0 / 7)));
  CHECK(d.acceleration(2) == doctest::Approx(1.8 * 2.5 * std::sqrt(10.0 / 7) * 0.3 * 1.2 / 4));
  CHECK(eurocode8({1, 'A', 1, 0.5}).acceleration(0.2) == doctest::Approx(2.5 * 0.55));  // eta is not below 0.55
  CHECK_THROWS_AS(eurocode8({3, 'A', 1, 0.05}), InputError);
  CHECK_THROWS_AS(eurocode8({1, 'F', 1, 0.05}), InputError);
  CHECK_THROWS_AS(eurocode8({1, 'A', 0, 0.05}), InputError);
}

TEST_CASE("the spectrum of ASCE 7 has the values of its four branches") {
  const TargetSpectrum s = asce7({10, 6, 4});  // T0 0.12, Ts 0.6
  CHECK(s.acceleration(0) == doctest::Approx(4));
  CHECK(s.acceleration(0.06) == doctest::Approx(7));
  CHECK(s.acceleration(0.5) == doctest::Approx(10));
  CHECK(s.acceleration(2) == doctest::Approx(3));
  CHECK(s.acceleration(8) == doctest::Approx(6.0 * 4 / 64));
  CHECK_THROWS_AS(asce7({10, 6, 0.5}), InputError);
}

TEST_CASE("a table is linear between its rows, and its faults have their lines") {
  const test::TemporaryFolder folder;
  const auto read = [&](const char* text, std::optional<AccelerationUnit> unit = {}) {
    return target_table(folder.write("t.csv", text), unit, 0.05);
  };
  const TargetSpectrum t = read("period [s], PSA [g]\n0, 0.4\n0.2, 1.0\n1, 0.5\n");
  CHECK(t.acceleration(0.1) == doctest::Approx(0.7 * 9.80665));
  CHECK(t.acceleration(1) == doctest::Approx(0.5 * 9.80665));
  CHECK(t.longest == 1);
  CHECK_THROWS_WITH_AS(check_range(t, 0.1, 2), "error: periods from 0.1 to 2 s, but t.csv is given from 0 to 1 s",
                       InputError);
  const auto message = [&](const char* text) {
    try {
      read(text, AccelerationUnit::g);
      return std::string();
    } catch (const RecordError& fault) {
      return fmt::format("{}: {}", fault.at.line, fault.text);
    }
  };
  CHECK(message("0.1 1\n0.1 2\n") == "2: periods must rise, from 0 or more");
  CHECK(message("0.1 1\n0.2 0\n") == "2: pseudo-accelerations must be positive");
  CHECK(message("0.1 1\n") == "1: a target spectrum needs two rows of period and pseudo-acceleration");
  CHECK(message("0.1 1 2\n") == "1: 3 columns, must be 1 or 2");
  CHECK(message("# unit: m/s2\n0.1 1\n0.2 1\n") == "0: 't.csv' is in units of m/s2, not g");
}

TEST_CASE("artificial motions match their targets within 10 % from 0.2 T to 2 T, by another integrator") {
  struct Case {
    TargetSpectrum target;
    double period;  // T [s]
    std::uint32_t seed;
  };
  for (const auto& [target, period, seed] :
       {Case{eurocode8({1, 'B', 3, 0.05}), 0.5, 1}, Case{eurocode8({2, 'D', 1, 0.05}), 0.25, 2},
        Case{asce7({9.81, 5.9, 8}), 0.8, 3}}) {
    CAPTURE(target.name);
    ArtificialOptions options;
    options.shortest = 0.2 * period;
    options.longest = 2 * period;
    options.seed = seed;
    const ArtificialMotion motion = artificial_motion(target, options);
    CHECK(motion.misfit <= 0.08);
    double worst = 0;
    for (const double t : logarithmic_periods(options.shortest, options.longest, 97))
      worst = std::max(worst, std::abs(newmark(motion.acceleration, options.dt, t, 0.05) / target.acceleration(t) - 1));
    CHECK(worst < 0.10);
    CHECK(worst > 0.3 * motion.misfit);  // the two see the same spectrum
    const MotionMeasures m = measure(motion.acceleration, options.dt);
    CHECK(std::abs(m.final_velocity) < 1e-9);
    CHECK(std::abs(m.final_displacement) < 1e-9);
    CHECK(m.from_5 > 0.3);  // the envelope: 2 s rise, 10 s level, then a fall
    CHECK(m.to_95 < 17);
    CHECK(artificial_motion(target, options).acceleration == motion.acceleration);
    options.seed += 10;
    CHECK(artificial_motion(target, options).acceleration != motion.acceleration);
  }
}

TEST_CASE("artificial motions refuse what they cannot do") {
  const TargetSpectrum target = eurocode8({1, 'A', 1, 0.05});
  ArtificialOptions options;
  options.shortest = 0.1, options.longest = 1;
  const auto with = [&](auto change) {
    ArtificialOptions changed = options;
    change(changed);
    return changed;
  };
  CHECK_THROWS_WITH_AS(artificial_motion(target, with([](auto& o) { o.dt = 0.02; })),
                       "error: periods from 0.1 s need a step of 0.0125 s or less", InputError);
  CHECK_THROWS_WITH_AS(
      artificial_motion(target, with([](auto& o) { o.longest = 3.9, o.duration = 7, o.envelope.level = 2; })),
      "error: periods to 3.9 s need a duration of 7.8 s or more", InputError);
  CHECK_THROWS_AS(artificial_motion(target, with([](auto& o) { o.longest = 5; })), InputError);
  CHECK_THROWS_AS(artificial_motion(target, with([](auto& o) { o.envelope.level = 30; })), InputError);
  CHECK_THROWS_AS(
      artificial_motion(target, with([](auto& o) { o.tolerance = 1e-4, o.max_iterations = 2, o.max_draws = 2; })),
      ConvergenceError);
}
