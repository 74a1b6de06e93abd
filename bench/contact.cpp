// Solvers of the contact problem on small sets: random well-conditioned ones, the redundant corners of a rigid slab, and
// heavy on light, where Gauss-Seidel needs of the order of the mass ratio in sweeps.
#include <benchmark/benchmark.h>

#include <cmath>
#include <random>

#include "contact/contact_problem.hpp"

namespace {

using namespace nsframe;

// W = A A'/n + I/2 of normal A, about half of the pairs closing.
ContactProblem random_problem(Eigen::Index n) {
  std::mt19937 random(static_cast<unsigned>(n));
  std::normal_distribution<double> normal;
  const MatrixX factor = MatrixX::NullaryExpr(n, n, [&] { return normal(random); });
  return {factor * factor.transpose() / static_cast<double>(n) + 0.5 * MatrixX::Identity(n, n),
          VectorX::NullaryExpr(n, [&] { return normal(random); })};
}

// Four corners (+-1.6, +-1.1) of a rigid plate of 4600 kg falling flat with 1 m/s, e = 1/2: rank 3.
ContactProblem slab_problem() {
  Eigen::Matrix<double, 4, 3> corners;
  corners << 1, -1.1, 1.6, 1, -1.1, -1.6, 1, 1.1, -1.6, 1, 1.1, 1.6;
  const Vector3 inverse_mass(1 / 4600.0, 12 / (4600.0 * 4 * 1.1 * 1.1), 12 / (4600.0 * 4 * 1.6 * 1.6));
  return {corners * inverse_mass.asDiagonal() * corners.transpose(), VectorX::Constant(4, -1.5)};
}

// A mass of 100 on a mass of 1 on the floor, both pressed down.
ContactProblem stack_problem() {
  MatrixX delassus(2, 2);
  delassus << 1.0, -1.0, -1.0, 1.01;
  VectorX rhs(2);
  rhs << -0.01, 0.0;
  return {delassus, rhs};
}

// All of n pairs closing, each felt by its neighbours with a tenth of the weight from one to the next: like the corners of
// two tall buildings at a step of a millisecond.
ContactProblem tower_problem(Eigen::Index n) {
  return {MatrixX::NullaryExpr(n, n, [](Eigen::Index i, Eigen::Index j) { return std::pow(0.1, std::abs(double(i - j))); }),
          VectorX::NullaryExpr(n, [](Eigen::Index i) { return -1 - 0.5 * std::sin(double(i)); })};
}

void active_set(benchmark::State& state, const ContactProblem& problem) {
  ContactSolution solution;
  for (auto _ : state) benchmark::DoNotOptimize(solution = solve_active_set(problem, {}));
  state.counters["iterations"] = solution.iterations;
}

void gauss_seidel(benchmark::State& state, const ContactProblem& problem) {
  ContactSolution solution;
  for (auto _ : state) {
    benchmark::DoNotOptimize(solution = solve_gauss_seidel(problem, {}, VectorX::Zero(problem.rhs.size())));
  }
  state.counters["iterations"] = solution.iterations;
}

void active_set_random(benchmark::State& state) { active_set(state, random_problem(state.range(0))); }
void gauss_seidel_random(benchmark::State& state) { gauss_seidel(state, random_problem(state.range(0))); }

void lawson_hanson(benchmark::State& state, const ContactProblem& problem) {
  ContactSolution solution;
  for (auto _ : state) benchmark::DoNotOptimize(solution = solve_lawson_hanson(problem, {}));
  state.counters["iterations"] = solution.iterations;
}

void active_set_tower(benchmark::State& state) { active_set(state, tower_problem(state.range(0))); }
void lawson_hanson_tower(benchmark::State& state) { lawson_hanson(state, tower_problem(state.range(0))); }
void active_set_dense(benchmark::State& state) { active_set(state, random_problem(state.range(0))); }
void lawson_hanson_dense(benchmark::State& state) { lawson_hanson(state, random_problem(state.range(0))); }

BENCHMARK(active_set_tower)->Arg(8)->Arg(32)->Arg(128)->Arg(256);
BENCHMARK(lawson_hanson_tower)->Arg(8)->Arg(32)->Arg(128)->Unit(benchmark::kMicrosecond);
BENCHMARK(active_set_dense)->Arg(64)->Arg(256);
BENCHMARK(lawson_hanson_dense)->Arg(64);
BENCHMARK(active_set_random)->Arg(1)->Arg(2)->Arg(4)->Arg(8)->Arg(16)->Arg(32);
BENCHMARK(gauss_seidel_random)->Arg(1)->Arg(2)->Arg(4)->Arg(8)->Arg(16)->Arg(32);
BENCHMARK_CAPTURE(active_set, slab, slab_problem());
BENCHMARK_CAPTURE(gauss_seidel, slab, slab_problem());
BENCHMARK_CAPTURE(active_set, stack, stack_problem());
BENCHMARK_CAPTURE(gauss_seidel, stack, stack_problem());

}  // namespace
