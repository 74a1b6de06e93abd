// Time of a response spectrum: 200 periods from 0.02 to 10 s of a record of 50 s at 1 ms, by the SIMD kernel and by its
// scalar definition, and of RotD50 and RotD100 of two such records.
#include <benchmark/benchmark.h>

#include <cmath>

#include "spectra/oscillators.hpp"
#include "spectra/spectrum.hpp"

namespace {

using namespace nsframe;

std::vector<double> record(double phase) {
  std::vector<double> a;
  for (int i = 0; i <= 50000; ++i) {
    const double t = 1e-3 * i;
    a.push_back(t * std::exp(-0.15 * t) *
                (std::sin(7 * t + phase) + std::sin(19 * t + 2 * phase) + 0.5 * std::sin(61 * t)));
  }
  return a;
}

using Spectrum = std::vector<double> (*)(std::span<const double>, double, const std::vector<double>&,
                                         const SpectrumOptions&);

void one_component(benchmark::State& state, Spectrum spectrum) {
  const std::vector<double> a = record(0), periods = logarithmic_periods(0.02, 10, 200);
  for (auto _ : state) benchmark::DoNotOptimize(spectrum(a, 1e-3, periods, {}));
}

void two_components(benchmark::State& state) {
  const std::vector<double> a = record(0), b = record(1), periods = logarithmic_periods(0.02, 10, 200);
  for (auto _ : state) benchmark::DoNotOptimize(rotated_spectrum(a, b, 1e-3, periods));
}

BENCHMARK_CAPTURE(one_component, kernel, spectral_displacement)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(one_component, scalar, spectral_displacement_scalar)->Unit(benchmark::kMillisecond);
BENCHMARK(two_components)->Unit(benchmark::kMillisecond);

}  // namespace
