// Oscillators on a moving base against closed forms and against Chopra's values for the El Centro record.
#include <doctest/doctest.h>

#include <cmath>
#include <fstream>
#include <string>

#include "base/types.hpp"
#include "spectra/oscillators.hpp"

using namespace nsframe;

namespace {

const std::vector<double> periods = logarithmic_periods(0.02, 4, 13);

// u(t) of an oscillator at rest at t = 0 under a base acceleration of 1 m/s2.
double under_constant(double w, double xi, double t) {
  const double root = std::sqrt(1 - xi * xi), wd = w * root;
  return -(1 - std::exp(-xi * w * t) * (std::cos(wd * t) + xi / root * std::sin(wd * t))) / (w * w);
}

// The same under t m/s2: the integral of the former.
double under_ramp(double w, double xi, double t) {
  const double root = std::sqrt(1 - xi * xi), wd = w * root, e = std::exp(-xi * w * t);
  const double free = e * (2 * xi * std::cos(wd * t) + (2 * xi * xi - 1) / root * std::sin(wd * t));
  return -(t - 2 * xi / w + free / w) / (w * w);
}

}  // namespace

TEST_CASE("oscillators follow a constant and a rising base acceleration exactly, at any step") {
  for (const double xi : {0.0, 0.05, 0.7}) {
    for (const double h : {1e-5, 1e-3, 0.02, 0.3}) {
      CAPTURE(xi);
      CAPTURE(h);
      const OscillatorStep step(periods, xi, h);
      Oscillators constant(periods.size()), ramp(periods.size());
      for (int i = 0; i < 200; ++i) {
        constant.advance(step, 1, 1);
        ramp.advance(step, i * h, (i + 1) * h);
      }
      for (std::size_t i = 0; i < periods.size(); ++i) {
        CAPTURE(periods[i]);
        const double w = 2 * pi / periods[i], t = 200 * h;
        // rounding: 200 steps, and phases of w t
        const double accuracy = 1e-13 * (1 + w * t) / (w * w);
        CHECK(std::abs(constant.displacement()[i] - under_constant(w, xi, t)) < accuracy);
        CHECK(std::abs(ramp.displacement()[i] - under_ramp(w, xi, t)) < accuracy * std::max(t, 1 / w));
      }
    }
  }
}

TEST_CASE("a jump of the base throws an oscillator at exactly that speed, and its peak is found between the steps") {
  const double dv = 0.3, h = 0.009;
  for (const double xi : {0.0, 0.05, 0.2}) {
    const OscillatorStep step(periods, xi, h);
    Oscillators o(periods.size());
    o.jump(dv);
    for (int i = 0; i < 500; ++i) o.advance(step, 0, 0);
    for (std::size_t i = 0; i < periods.size(); ++i) {
      const double w = 2 * pi / periods[i], root = std::sqrt(1 - xi * xi);
      const double exact = dv / w * std::exp(-xi / root * std::atan2(root, xi));
      CHECK(o.peak()[i] == doctest::Approx(exact).epsilon(2e-4));  // of the cubic between steps of w h <= 1/2
    }
  }
}

TEST_CASE("a step taken in two parts is the same step") {
  const OscillatorStep whole(periods, 0.05, 0.01), first(periods, 0.05, 0.003), second(periods, 0.05, 0.007);
  Oscillators a(periods.size()), b(periods.size());
  for (int i = 0; i < 50; ++i) {
    const double from = std::sin(0.3 * i), to = std::sin(0.3 * (i + 1)), middle = from + 0.3 * (to - from);
    a.advance(whole, from, to);
    b.advance(first, from, middle);
    b.advance(second, middle, to);
  }
  for (std::size_t i = 0; i < periods.size(); ++i) {
    const double w = 2 * pi / periods[i];
    CHECK(std::abs(a.displacement()[i] - b.displacement()[i]) < 1e-13 / w);  // rounding, velocities of about 1 m/s
    CHECK(std::abs(a.velocity()[i] - b.velocity()[i]) < 1e-12);
  }
}

TEST_CASE("a thousand short steps are one long step: short ones lose no digits") {
  const OscillatorStep tiny(periods, 0.05, 1e-6), all(periods, 0.05, 1e-3);
  Oscillators a(periods.size()), b(periods.size());
  for (int i = 0; i < 1000; ++i) a.advance(tiny, 2 + 1e-3 * i, 2 + 1e-3 * (i + 1));
  b.advance(all, 2, 3);
  for (std::size_t i = 0; i < periods.size(); ++i) {
    CHECK(a.displacement()[i] == doctest::Approx(b.displacement()[i]).epsilon(1e-12));  // rounding of 1000 steps
    CHECK(a.velocity()[i] == doctest::Approx(b.velocity()[i]).epsilon(1e-12));
  }
}

TEST_CASE("spectral displacements of El Centro 1940 are those printed by Chopra, section 6.4") {
  std::ifstream file(std::string(NSFRAME_SOURCE_DIR) + "/examples/motions/el_centro_1940_ns.at2");
  std::string line;
  for (int i = 0; i < 4; ++i) std::getline(file, line);
  std::vector<double> record;
  for (double value; file >> value;) record.push_back(9.80665 * value);
  REQUIRE(record.size() == 1560);
  struct Printed {
    double period, damping, displacement;  // [s], [-], [in]
  };
  for (const auto& [period, damping, printed] : {Printed{0.5, 0.02, 2.67}, {1, 0.02, 5.97}, {2, 0.02, 7.47}, {2, 0, 9.91}, {2, 0.05, 5.37}}) {
    CAPTURE(period);
    CAPTURE(damping);
    Oscillators o(1);
    const OscillatorStep step({period}, damping, 0.02);
    double sampled = 0;
    for (std::size_t i = 0; i + 1 < record.size(); ++i) {
      o.advance(step, record[i], record[i + 1]);
      sampled = std::max(sampled, std::abs(o.displacement()[0]));
    }
    // the book looks at the ends of the record's steps; half a unit of its last digit, and the five digits of the record
    CHECK(std::abs(sampled / 0.0254 - printed) < 0.0055);
    CHECK(o.peak()[0] >= sampled);
    CHECK(o.peak()[0] < 1.007 * sampled);
  }
}

TEST_CASE("oscillators without period, with too much damping or without a step are refused") {
  CHECK_THROWS_AS(OscillatorStep({0.1, 0}, 0.05, 0.01), std::invalid_argument);
  CHECK_THROWS_AS(OscillatorStep({0.1}, 1, 0.01), std::invalid_argument);
  CHECK_THROWS_AS(OscillatorStep({0.1}, -0.1, 0.01), std::invalid_argument);
  CHECK_THROWS_AS(OscillatorStep({0.1}, 0.05, 0), std::invalid_argument);
}
