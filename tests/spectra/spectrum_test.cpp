// Spectra of records: the SIMD kernel against its scalar definition, closed forms, published values; RotDnn by rotation
// of the records themselves.
#include "spectra/spectrum.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "base/types.hpp"
#include "motion/record.hpp"
#include "spectra/oscillators.hpp"

using namespace nsframe;

namespace {

std::vector<double> noise(unsigned seed, std::size_t count) {
  std::mt19937 generator(seed);
  std::vector<double> out;
  double value = 0;
  for (std::size_t i = 0; i < count; ++i)
    out.push_back(value = 0.9 * value + (static_cast<double>(generator()) / 4294967295.0 - 0.5));
  return out;
}

std::vector<double> combined(const std::vector<double>& a, const std::vector<double>& b, double cosine, double sine) {
  std::vector<double> out;
  for (std::size_t i = 0; i < a.size(); ++i) out.push_back(cosine * a[i] + sine * b[i]);
  return out;
}

// Relative difference.
double off(double found, double exact) { return std::abs(found / exact - 1); }

const Record& el_centro() {
  static const Record record = read_record(NSFRAME_SOURCE_DIR "/examples/motions/el_centro_1940_ns.at2");
  return record;
}

}  // namespace

TEST_CASE("the SIMD spectrum is the scalar one, for any number and order of periods") {
  const std::vector<double> a = noise(1, 700);
  for (const std::size_t count : {1u, 15u, 16u, 17u, 70u}) {
    for (const bool at_samples : {false, true}) {
      for (const double damping : {0.0, 0.05, 0.3}) {
        CAPTURE(count);
        CAPTURE(at_samples);
        std::vector<double> periods = logarithmic_periods(0.03, 8, 70);
        std::shuffle(periods.begin(), periods.end(), std::mt19937(3));
        periods.resize(count);
        const auto fast = spectral_displacement(a, 0.01, periods, {damping, at_samples});
        const auto scalar = spectral_displacement_scalar(a, 0.01, periods, {damping, at_samples});
        REQUIRE(fast.size() == count);
        for (std::size_t i = 0; i < count; ++i) CHECK(off(fast[i], scalar[i]) < 1e-11);  // rounding over 700 steps
      }
    }
  }
}

TEST_CASE("the peak after the end of a record counts: a short push throws the oscillator") {
  const double h = 1e-4, push = 30, dv = push * h;  // triangle of the area dv [m/s]
  const std::vector<double> a{0, push, 0}, periods = logarithmic_periods(0.5, 5, 7);
  for (const double xi : {0.0, 0.05, 0.4}) {
    const auto found = spectral_displacement(a, h, periods, {xi, false});
    const auto rotated = rotated_spectrum(a, a, h, periods, {xi, false});
    for (std::size_t i = 0; i < periods.size(); ++i) {
      const double w = 2 * pi / periods[i], root = std::sqrt(1 - xi * xi);
      const double exact = dv / w * std::exp(-xi / root * std::atan2(root, xi));
      CHECK(off(found[i], exact) < 2 * w * h);  // the push takes the time 2 h
      CHECK(off(rotated.rotd100[i], std::sqrt(2.0) * exact) < 2 * w * h + 5e-4);
    }
    CHECK(spectral_displacement(a, h, periods, {xi, true})[0] < 0.01 * found[0]);
  }
}

TEST_CASE(
    "El Centro 1940 has the displacements printed by Chopra, section 6.4, and the accelerations of another program") {
  struct Printed {
    double period, damping, displacement;  // [s], [-], [in]
  };
  for (const auto& [period, damping, printed] :
       {Printed{0.5, 0.02, 2.67}, {1, 0.02, 5.97}, {2, 0.02, 7.47}, {2, 0, 9.91}, {2, 0.05, 5.37}}) {
    const double found =
        spectral_displacement(el_centro().acceleration, 0.02, {period}, {damping, true}).front() / 0.0254;
    CHECK(std::abs(found * 386.4 / 386.0886 - printed) <
          0.0101);  // the book's g in in/s2; it cuts the last digit, 2.676 to 2.67
    const double peak =
        spectral_displacement(el_centro().acceleration, 0.02, {period}, {damping, false}).front() / 0.0254;
    CHECK(peak >= found);
    CHECK(peak < 1.008 * found);  // between samples of w h / 2 <= 0.126: (w h / 2)^2 / 2
  }
  const std::vector<double> periods{0.1, 0.15, 0.29, 0.5, 1, 2},
      printed{0.6075, 0.7371, 0.7639, 0.9160, 0.4541, 0.1373};  // [g], 5 %
  const auto psa =
      pseudo_acceleration(periods, spectral_displacement(el_centro().acceleration, 0.02, periods, {0.05, true}));
  for (std::size_t i = 0; i < periods.size(); ++i)
    CHECK(std::abs(psa[i] / 9.80665 - printed[i]) < 0.51e-4);  // last digit
}

TEST_CASE("RotD of one component alone is its spectrum times the median and the largest cosine") {
  const std::vector<double> a = noise(2, 900), zero(900, 0.0), periods = logarithmic_periods(0.05, 3, 9);
  const auto r = rotated_spectrum(a, zero, 0.01, periods);
  for (std::size_t i = 0; i < periods.size(); ++i) {
    CHECK(off(r.rotd100[i], r.first[i]) < 5e-4);
    CHECK(off(r.rotd50[i], r.first[i] * std::cos(pi / 4)) < 5e-4);
    CHECK(r.second[i] == 0);
  }
}

TEST_CASE("RotD is found by rotating the records themselves") {
  const std::vector<double> a = noise(4, 900), b = noise(5, 900), periods{0.07, 0.3, 1.1};
  for (const bool at_samples : {false, true}) {
    const auto r = rotated_spectrum(a, b, 0.01, periods, {0.05, at_samples});
    std::vector<std::vector<double>> along(periods.size());
    for (int degree = 0; degree < 180; ++degree) {
      const auto turned = combined(a, b, std::cos(degree * pi / 180), std::sin(degree * pi / 180));
      const auto d = spectral_displacement(turned, 0.01, periods, {0.05, at_samples});
      for (std::size_t i = 0; i < periods.size(); ++i) along[i].push_back(d[i]);
    }
    for (std::size_t i = 0; i < periods.size(); ++i) {
      std::sort(along[i].begin(), along[i].end());
      const double accuracy = at_samples ? 1e-9 : 5e-4;
      CHECK(off(r.rotd100[i], along[i].back()) < accuracy);
      CHECK(off(r.rotd50[i], 0.5 * (along[i][89] + along[i][90])) < accuracy);
    }
  }
}

TEST_CASE("spectra without values, or of components of different length, are refused") {
  CHECK_THROWS_AS(spectral_displacement({}, 0.01, {1}), std::invalid_argument);
  CHECK_THROWS_AS(spectral_displacement(std::vector<double>{1, 2}, 0.01, {-1}), std::invalid_argument);
  CHECK_THROWS_AS(rotated_spectrum(std::vector<double>{1, 2}, std::vector<double>{1}, 0.01, {1}),
                  std::invalid_argument);
}
