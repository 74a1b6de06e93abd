// Time a fiber of a section's response (stress, tangent, history, section sums), by the SIMD kernel and by the scalar
// definition: an HEA140 of 52 fibers swept through strains of two to four times yield.
#include <benchmark/benchmark.h>

#include <cmath>

#include "elements/catalogue.hpp"
#include "elements/fiber_section.hpp"

namespace {

using namespace nsframe;

FiberSection section_of(const UniaxialLaw& law) {
  std::vector<Fiber> fibers;
  for (const FiberDescription& fiber : shape_fibers(*find_shape("HEA140"), ShapeMesh{}, {})) {
    fibers.push_back({fiber.y, fiber.z, fiber.area, law});
  }
  return FiberSection(fibers, 1e4);
}

// A smooth history of (e0, kz, ky) with reversals, neither period a multiple of the other.
std::vector<Vector3> deformations() {
  std::vector<Vector3> path;
  for (int i = 0; i < 1000; ++i) {
    const double a = 2 * pi * i / 250, b = 2 * pi * i / 330;
    path.emplace_back(5e-4 * std::sin(a), 0.06 * std::sin(b), 0.01 * std::sin(a + b));
  }
  return path;
}

using Respond = SectionResponse (*)(const FiberSection&, const Vector3&, const double*, double*);

// By the kernel, with the tangent or without.
SectionResponse kernel(const FiberSection& section, const Vector3& deformation, const double* committed, double* trial) {
  return respond(section, deformation, committed, trial);
}
SectionResponse force_only(const FiberSection& section, const Vector3& deformation, const double* committed, double* trial) {
  return respond(section, deformation, committed, trial, false);
}

void run(benchmark::State& state, Respond evaluate, const UniaxialLaw& law) {
  const FiberSection section = section_of(law);
  const std::vector<Vector3> path = deformations();
  VectorX committed(section.history_size), trial(section.history_size);
  initialize_history(section, committed.data());
  trial = committed;
  std::size_t i = 0;
  for (auto _ : state) {
    const SectionResponse response = evaluate(section, path[i], committed.data(), trial.data());
    benchmark::DoNotOptimize(response);
    committed.swap(trial);
    if (++i == path.size()) i = 0;
  }
  state.counters["s/fiber"] = benchmark::Counter(
      section.fibers, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

const Elastic elastic{210e9};
const ElasticPP perfectly_plastic{210e9, 235e6 / 210e9};
const Steel01 steel01{235e6, 210e9, 0.01};
const Steel02 steel02{235e6, 210e9, 0.01};
const Concrete01 concrete01{-30e6, -0.002, -6e6, -0.006};
const Concrete02 concrete02{-30e6, -0.002, -6e6, -0.006, 0.1, 2.5e6, 2.5e9};
const Concrete04 concrete04{-30e6, -0.002, -0.006, 25e9, 2e6, 0.001};
const Hysteretic hysteretic{235e6,    0.00112,  280e6,  0.004,  200e6,   0.02, -235e6, -0.00112, -280e6,
                            -0.004, -200e6, -0.02, 0.6,   0.3, 0.01, 0.005, 0.3};
const BoucWen bouc_wen{0.02, 210e9, 2, 4e5, 4e5};
const IMKBilin imk_bilin{210e9, 0.005, 0.02, 0.1,   235e6, 1.1, 0.3, 0.005, 0.02, 0.1,
                         235e6, 1.1,   0.3,  1.0, 1.0, 1.0};

BENCHMARK_CAPTURE(run, kernel/Elastic, kernel, elastic);
BENCHMARK_CAPTURE(run, kernel/ElasticPP, kernel, perfectly_plastic);
BENCHMARK_CAPTURE(run, kernel/Steel01, kernel, steel01);
BENCHMARK_CAPTURE(run, kernel/Steel02, kernel, steel02);
BENCHMARK_CAPTURE(run, kernel/Concrete01, kernel, concrete01);
BENCHMARK_CAPTURE(run, kernel/Concrete02, kernel, concrete02);
BENCHMARK_CAPTURE(run, kernel/Concrete04, kernel, concrete04);
BENCHMARK_CAPTURE(run, kernel/Hysteretic, kernel, hysteretic);
BENCHMARK_CAPTURE(run, kernel/BoucWen, kernel, bouc_wen);
BENCHMARK_CAPTURE(run, kernel/IMKBilin, kernel, imk_bilin);
BENCHMARK_CAPTURE(run, force_only/Elastic, force_only, elastic);
BENCHMARK_CAPTURE(run, force_only/ElasticPP, force_only, perfectly_plastic);
BENCHMARK_CAPTURE(run, force_only/Steel01, force_only, steel01);
BENCHMARK_CAPTURE(run, force_only/Steel02, force_only, steel02);
BENCHMARK_CAPTURE(run, force_only/Concrete01, force_only, concrete01);
BENCHMARK_CAPTURE(run, force_only/Concrete02, force_only, concrete02);
BENCHMARK_CAPTURE(run, force_only/Concrete04, force_only, concrete04);
BENCHMARK_CAPTURE(run, force_only/Hysteretic, force_only, hysteretic);
BENCHMARK_CAPTURE(run, force_only/BoucWen, force_only, bouc_wen);
BENCHMARK_CAPTURE(run, force_only/IMKBilin, force_only, imk_bilin);
BENCHMARK_CAPTURE(run, scalar/Elastic, respond_scalar, elastic);
BENCHMARK_CAPTURE(run, scalar/ElasticPP, respond_scalar, perfectly_plastic);
BENCHMARK_CAPTURE(run, scalar/Steel01, respond_scalar, steel01);
BENCHMARK_CAPTURE(run, scalar/Steel02, respond_scalar, steel02);
BENCHMARK_CAPTURE(run, scalar/Concrete01, respond_scalar, concrete01);
BENCHMARK_CAPTURE(run, scalar/Concrete02, respond_scalar, concrete02);
BENCHMARK_CAPTURE(run, scalar/Concrete04, respond_scalar, concrete04);
BENCHMARK_CAPTURE(run, scalar/Hysteretic, respond_scalar, hysteretic);
BENCHMARK_CAPTURE(run, scalar/BoucWen, respond_scalar, bouc_wen);
BENCHMARK_CAPTURE(run, scalar/IMKBilin, respond_scalar, imk_bilin);

}  // namespace
