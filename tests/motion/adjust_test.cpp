// What is done to records, against closed forms: measures, filters, baselines, rotation, AT2 written and read again.
#include "motion/adjust.hpp"

#include <doctest/doctest.h>

#include <cmath>

#include "base/types.hpp"
#include "motion/equations.hpp"
#include "motion/history.hpp"
#include "motion/write_at2.hpp"
#include "tests/support/files.hpp"

using namespace nsframe;

namespace {

std::vector<double> sine(double amplitude, double frequency, double dt, double duration) {
  std::vector<double> out;
  for (int i = 0; i * dt <= duration * (1 + 1e-12); ++i)
    out.push_back(amplitude * std::sin(2 * pi * frequency * i * dt));
  return out;
}

double off(double found, double exact) { return std::abs(found / exact - 1); }

}  // namespace

TEST_CASE("the measures of a sine are its closed forms") {
  const double A = 3, f = 0.5, dt = 1e-3, w = 2 * pi * f;
  const MotionMeasures m = measure(sine(A, f, dt, 10), dt);  // five periods: at rest again
  CHECK(off(m.acceleration.value, A) < 1e-6);
  CHECK(m.acceleration.time == doctest::Approx(0.5));
  CHECK(off(m.velocity.value, 2 * A / w) < 1e-5);       // chords for arcs: (w dt)^2 / 12
  CHECK(off(m.displacement.value, A / w * 10) < 1e-5);  // drift of velocity A / w
  CHECK(std::abs(m.final_velocity) < 1e-12);
  CHECK(off(m.arias, pi / (2 * 9.80665) * A * A / 2 * 10) < 1e-5);
  CHECK(m.significant_95() == doctest::Approx(9).epsilon(5e-3));  // nearly uniform: within a fortieth of a period each
}

TEST_CASE("significant times of a constant acceleration are shares of its length, also within one step") {
  const MotionMeasures m = measure(std::vector<double>{2, 2, 2}, 4);
  CHECK(m.from_5 == doctest::Approx(0.4).epsilon(1e-9));
  CHECK(m.to_75 == doctest::Approx(6).epsilon(1e-9));
  CHECK(m.to_95 == doctest::Approx(7.6).epsilon(1e-9));
  const MotionMeasures ramp = measure(std::vector<double>{0, 1}, 1);  // t^3
  CHECK(ramp.to_75 == doctest::Approx(std::cbrt(0.75)).epsilon(1e-9));
  CHECK(off(ramp.arias, pi / (2 * 9.80665) / 3) < 1e-12);
  CHECK(off(ramp.displacement.value, 1.0 / 6) < 1e-12);
}

TEST_CASE("the filter passes a sine with the amplitude of Butterworth's formula, squared, and without shift") {
  const double dt = 0.005;
  for (const int order : {1, 2, 3, 4, 7}) {
    for (const double f : {0.2, 0.5, 1.0, 3.0, 10.0, 20.0}) {
      CAPTURE(order);
      CAPTURE(f);
      const std::vector<double> in = sine(1, f, dt, 80);
      const Filtered out = band_passed(in, dt, {0.5, 10, order, false});
      // the bilinear transform bends frequencies: tan(pi f dt)
      const double low = std::tan(pi * 0.5 * dt), high = std::tan(pi * 10 * dt), x = std::tan(pi * f * dt);
      const double gain = 1 / (1 + std::pow(low / x, 2 * order)) / (1 + std::pow(x / high, 2 * order));
      double across = 0, along = 0;  // over whole periods in the middle
      for (std::size_t i = 6000; i < 10000; ++i) {
        along += out.acceleration[i] * std::sin(2 * pi * f * dt * static_cast<double>(i)) / 2000;
        across += out.acceleration[i] * std::cos(2 * pi * f * dt * static_cast<double>(i)) / 2000;
      }
      CHECK(std::abs(along - gain) < 2e-4);  // transients of the ends, 30 s away
      CHECK(std::abs(across) < 2e-4);
      CHECK(out.acceleration.size() == in.size());
    }
  }
}

TEST_CASE("pads hold what the filter brings before the record, and wrong corners are refused") {
  std::vector<double> pulse(401);
  pulse[200] = 1;
  const Filtered f = band_passed(pulse, 0.01, {0.5, 0, 2, true});
  REQUIRE(f.begins < 0);
  const auto middle = static_cast<std::size_t>(std::lround(-f.begins / 0.01)) + 200;
  for (std::size_t k = 1; k < 700; ++k)
    CHECK(f.acceleration[middle - k] == doctest::Approx(f.acceleration[middle + k]).scale(1e-3).epsilon(1e-2));
  const Filtered cut = band_passed(pulse, 0.01, {0.5, 0, 2, false});
  CHECK(cut.begins == 0);
  CHECK(cut.acceleration[200] == f.acceleration[middle]);
  const GroundHistory whole = integrate(f.acceleration, 0.01);
  CHECK(cut.velocity == whole.velocity[middle - 200]);
  CHECK(cut.displacement == whole.displacement[middle - 200]);
  CHECK(cut.velocity != 0);
  CHECK(measure(f.acceleration, 0.01).final_displacement ==
        doctest::Approx(0).epsilon(1e-4));  // no content at zero frequency
  for (const BandPass& wrong : {BandPass{0, 0, 4, false},
                                {1, 0.5, 4, false},
                                {0, 60, 4, false},
                                {0.1, 0, 0, false},
                                {0.1, 0, 11, false},
                                {-1, 0, 4, false}})
    CHECK_THROWS_AS(band_passed(pulse, 0.01, wrong), std::invalid_argument);
}

TEST_CASE(
    "a baseline of its degree takes a polynomial out of a record, and the one found has the least squares of "
    "velocity") {
  const double dt = 0.01;
  std::vector<double> a = sine(2, 1.7, dt, 20);
  const std::vector<double> clean = baseline_corrected(a, dt, 2);
  std::vector<double> drifting = a;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const double t = dt * static_cast<double>(i);
    drifting[i] += 0.05 - 0.01 * t + 0.0004 * t * t;
  }
  const std::vector<double> found = baseline_corrected(drifting, dt, 2);
  double worst = 0;
  for (std::size_t i = 0; i < a.size(); ++i) worst = std::max(worst, std::abs(found[i] - clean[i]));
  CHECK(worst < 1e-6);  // velocities by trapezia: curvature 0.0008 times dt^2 / 12
  const auto squares = [&](const std::vector<double>& record) {
    double sum = 0;
    for (const double v : integrate(record, dt).velocity) sum += v * v;
    return sum;
  };
  for (const int power : {0, 1, 2}) {
    for (const double change : {-1e-3, 1e-3}) {
      std::vector<double> other = found;
      for (std::size_t i = 0; i < a.size(); ++i)
        other[i] += change * std::pow(static_cast<double>(i) / static_cast<double>(a.size() - 1), power);
      CHECK(squares(other) > squares(found));
    }
  }
  CHECK_THROWS_AS(baseline_corrected(a, dt, 7), std::invalid_argument);
}

TEST_CASE("a record brought to rest ends without velocity and displacement, and begins and ends as before") {
  std::vector<double> a = sine(1, 0.37, 0.01, 11);
  const std::vector<double> rest = brought_to_rest(a, 0.01);
  const MotionMeasures m = measure(rest, 0.01);
  CHECK(std::abs(m.final_velocity) < 1e-12);
  CHECK(std::abs(m.final_displacement) < 1e-11);
  CHECK(rest.front() == a.front());
  CHECK(rest.back() == a.back());
}

TEST_CASE("a rotated pair is the component along the direction") {
  const std::vector<double> x{1, 2, 3}, y{10, 20};
  const auto close = [](const std::vector<double>& found, const std::vector<double>& wanted) {
    REQUIRE(found.size() == wanted.size());
    for (std::size_t i = 0; i < found.size(); ++i) CHECK(std::abs(found[i] - wanted[i]) < 1e-14 * 30);
  };
  close(rotated(x, y, 0), {1, 2, 3});
  close(rotated(x, y, pi / 2), {10, 20, 0});
  close(rotated(x, y, pi), {-1, -2, -3});
  close(rotated(x, y, std::atan2(3, 4)), {0.8 + 6, 1.6 + 12, 2.4});
}

TEST_CASE("a written AT2 record is read again to its eight digits") {
  Record record;
  record.dt = 1.0 / 128;
  record.description = "NPTS= of\na station";
  for (int i = 0; i < 123; ++i) record.acceleration.push_back(1e-3 * std::pow(-1.2, i) / (1 + i));
  const test::TemporaryFolder folder;
  const Record again = read_record(folder.write("a.at2", at2_text(record, "title with NPTS")));
  CHECK(again.dt == record.dt);
  REQUIRE(again.acceleration.size() == 123);
  for (std::size_t i = 0; i < 123; ++i) CHECK(off(again.acceleration[i], record.acceleration[i]) < 1e-7);
}

TEST_CASE("equations are solved where a pivot vanishes, and singular ones are refused") {
  const std::vector<double> x = solve_equations({0, 2, 1, 1, 0, 3, 2, 1, 0}, {7, 10, 4});
  CHECK(std::abs(x[0] - 1) + std::abs(x[1] - 2) + std::abs(x[2] - 3) < 1e-14);
  CHECK_THROWS_AS(solve_equations({0, 0, 0, 1}, {1, 1}), std::invalid_argument);
  CHECK_THROWS_AS(solve_equations({1}, {1, 1}), std::invalid_argument);
}
