// The SIMD kernel of fiber sections against the scalar definition, on every instruction set of this machine.
#include <doctest/doctest.h>


#include <random>

#include "elements/fiber_section.hpp"
#include "tests/support/simd_targets.hpp"

using namespace nsframe;

namespace {

std::vector<Fiber> mixed_fibers() {
  const std::vector<UniaxialLaw> laws{Elastic{30e9}, ElasticPP{210e9, 0.00112, -0.0009, 1e-4}, Steel01{235e6, 210e9, 0.01},
                                      Steel02{235e6, 210e9, 0.01}, Steel02{355e6, 205e9, 0.02, 18.5, 0.925, 0.15, 0.04, 1, 0.02, 1, 20e6},
                                      MinMax{inner(Steel02{235e6, 210e9, 0.01}), -0.01, 0.008}, InitStress{inner(Steel02{235e6, 210e9, 0.01}), 5e7},
                                      Fatigue{inner(Parallel{{inner(Steel01{235e6, 210e9, 0.01}), inner(ENT{30e9})}}), 0.02},
                                      Concrete02{-30e6, -0.002, -6e6, -0.006}, Concrete04{-30e6, -0.002, -0.006, 25e9, 2e6, 0.001}};
  std::vector<Fiber> fibers;
  for (int i = 0; i < 53; ++i) {
    fibers.push_back({0.01 * (i % 11 - 5), 0.012 * (i % 7 - 3), 1e-4 * (1 + i % 3), laws[static_cast<std::size_t>(i) % laws.size()]});
  }
  return fibers;
}

// Largest difference between kernel and scalar over a random history, relative to the largest force and stiffness.
double largest_difference(const FiberSection& section) {
  VectorX committed(section.history_size), kernel(section.history_size), scalar(section.history_size);
  initialize_history(section, committed.data());
  std::mt19937 random(7);
  std::uniform_real_distribution<double> uniform(-1, 1);
  Vector3 deformation = Vector3::Zero();
  double difference = 0;
  const Matrix3 virgin = initial_tangent(section);
  for (int step = 0; step < 300; ++step) {
    deformation += Vector3(1e-3 * uniform(random), 0.03 * uniform(random), 0.03 * uniform(random));
    const SectionResponse a = respond(section, deformation, committed.data(), kernel.data());
    const SectionResponse force_only = respond(section, deformation, committed.data(), scalar.data(), false);
    difference = std::max(difference, (a.force - force_only.force).cwiseQuotient(virgin.diagonal().cwiseProduct(Vector3(1e-3, 0.03, 0.03))).cwiseAbs().maxCoeff());
    const SectionResponse b = respond_scalar(section, deformation, committed.data(), scalar.data());
    for (int i = 0; i < 3; ++i) {
      difference = std::max(difference, std::abs(a.force[i] - b.force[i]) / (virgin(i, i) * 1e-3 / (i ? 0.03 : 1)));
      for (int j = 0; j < 3; ++j) difference = std::max(difference, std::abs(a.tangent(i, j) - b.tangent(i, j)) / std::sqrt(virgin(i, i) * virgin(j, j)));
    }
    committed = scalar;  // padding fibers differ in history only
  }
  return difference;
}

}  // namespace

TEST_CASE("the SIMD kernel equals the scalar fibers on every instruction set of this machine") {
  const FiberSection section(mixed_fibers(), 1e4);
  CHECK(section.fibers == 53);
  CHECK(section.blocks.size() == 10);
  test::on_every_simd_target([&](const std::string&) {
    // powers x^R carry the rounding of R log x, about R |log x| epsilons
    CHECK(largest_difference(section) < 1e-12);
  });
}

TEST_CASE("more wrapped fibers than are evaluated at a time equal as many sections") {
  std::vector<Fiber> many, few;
  const UniaxialLaw law = MinMax{inner(Steel01{235e6, 210e9, 0.01}), {}, 0.01};
  for (int i = 0; i < 7 * wrapped_points / 3; ++i) many.push_back({0, 0, 1e-4, law});
  few.push_back({0, 0, 1e-4 * static_cast<double>(many.size()), law});
  const FiberSection large(many, 1), small(few, 1);
  VectorX committed_large(large.history_size), trial_large(large.history_size);
  VectorX committed_small(small.history_size), trial_small(small.history_size);
  initialize_history(large, committed_large.data());
  initialize_history(small, committed_small.data());
  for (const double strain : {1e-4, 5e-3, -2e-3, 8e-3, 1.2e-2, 1e-3}) {
    const Vector3 deformation(strain, 0, 0);
    const SectionResponse a = respond(large, deformation, committed_large.data(), trial_large.data());
    const SectionResponse b = respond(small, deformation, committed_small.data(), trial_small.data());
    // 150 roundings of a sum
    CHECK(a.force[0] == doctest::Approx(b.force[0]).epsilon(1e-13));
    CHECK(a.tangent(0, 0) == doctest::Approx(b.tangent(0, 0)).epsilon(1e-13));
    CHECK(trial_large.allFinite());
    std::swap(committed_large, trial_large);
    std::swap(committed_small, trial_small);
  }
}

TEST_CASE("places and states of single fibers give back the section's forces and names") {
  std::vector<Fiber> fibers = mixed_fibers();
  for (std::size_t i = 0; i < fibers.size(); ++i) fibers[i].material = std::to_string(i);
  const FiberSection section(fibers, 1e4);
  VectorX committed(section.history_size), trial(section.history_size);
  initialize_history(section, committed.data());
  const std::vector<FiberPlace> places = fiber_places(section);
  REQUIRE(places.size() == fibers.size());
  for (const Vector3& deformation : {Vector3(1e-3, 0.03, -0.02), Vector3(-2e-3, -0.05, 0.04), Vector3(5e-4, 0.01, 0.01)}) {
    const SectionResponse response = respond_scalar(section, deformation, committed.data(), trial.data());
    const std::vector<FiberState> states = fiber_states(section, deformation, committed.data());
    REQUIRE(states.size() == places.size());
    Vector3 force = Vector3::Zero();
    for (std::size_t i = 0; i < places.size(); ++i) {
      const FiberPlace& p = places[i];
      force += states[i].stress * p.area * Vector3(1, -p.y, p.z);
      CHECK(states[i].strain == doctest::Approx(deformation[0] - p.y * deformation[1] + p.z * deformation[2]).epsilon(1e-14));
      const Fiber& fiber = fibers[std::stoul(std::string(p.material))];
      CHECK((fiber.y == p.y && fiber.z == p.z && fiber.area == p.area));
    }
    CHECK((force - response.force).norm() < 1e-13 * response.force.norm());  // rounding of 53 terms
    committed = trial;
  }
}

TEST_CASE("a symmetric fiber rectangle has EA, EI and no coupling") {
  std::vector<Fiber> fibers;
  const int n = 40;
  for (int i = 0; i < n; ++i) fibers.push_back({0.3 * ((i + 0.5) / n - 0.5), 0, 0.3 * 0.2 / n, Elastic{30e9}});
  const Matrix3 k = initial_tangent(FiberSection(fibers, 1));
  CHECK(k(0, 0) == doctest::Approx(30e9 * 0.06).epsilon(1e-12));
  CHECK(k(1, 1) == doctest::Approx(30e9 * 0.2 * 0.027 / 12 * (1 - 1.0 / (n * n))).epsilon(1e-12));
  CHECK(std::abs(k(0, 1)) < 1e-9 * k(0, 0));
}
