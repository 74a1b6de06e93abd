// Newton's and Poisson's laws where several pairs collide at once.
#include <doctest/doctest.h>

#include <cmath>
#include <random>

#include "contact/impact_law.hpp"
#include "tests/support/numbers.hpp"

using namespace nsframe;

namespace {

VectorX solve(const ContactProblem& problem) {
  const ContactSolution solution = solve_active_set(problem, {});
  REQUIRE(solution.converged);
  return solution.impulse;
}

// Not always solvable: a body between two walls with different e can be asked to leave both.
VectorX newton_impulse(const MatrixX& W, const VectorX& before, const VectorX& e) { return solve({W, before + e.cwiseProduct(before)}); }

// No solution, or only one with impulses so large that rounding rules it.
bool newton_fails(const MatrixX& W, const VectorX& before, const VectorX& e) {
  const ContactProblem problem{W, before + e.cwiseProduct(before)};
  const ContactSolution solution = solve_active_set(problem, {});
  return !solution.converged || rounding_error(problem, solution.impulse) > 1e-11;
}

}  // namespace

TEST_CASE("Newton's law with two coefficients creates a sixth of a joule, which is found; Poisson's takes some away") {
  const MatrixX W{{1, -0.5}, {-0.5, 1}};
  const VectorX before{{-1, 0.5}}, e{{1, 0}};
  const VectorX p = newton_impulse(W, before, e), after = before + W * p;
  CHECK((p - VectorX{{7.0 / 3, 2.0 / 3}}).norm() < 16 * epsilon);
  const double by_kinetic_energy = 0.5 * (after.dot(W.inverse() * after) - before.dot(W.inverse() * before));
  CHECK(std::abs(by_kinetic_energy - 1.0 / 6) < 16 * epsilon);
  CHECK(std::abs(created_energy(W, p, before, after) - 1.0 / 6) < 16 * epsilon);
  double by_pairs = 0;  // (270)
  for (Eigen::Index i = 0; i < 2; ++i) by_pairs += 0.5 * p[i] * (1 - e[i]) * before[i];
  CHECK(std::abs(by_pairs - 1.0 / 6) < 16 * epsilon);

  // compression (1, 0) leaves the rates (0, 0); expansion (1, 0.5), (0.75, 0)
  const PoissonImpact poisson = poisson_impact(W, before, e, solve);
  CHECK((poisson.compression - VectorX{{1, 0}}).norm() < 16 * epsilon);
  CHECK((poisson.impulse - VectorX{{2, 0.5}}).norm() < 16 * epsilon);
  CHECK((poisson.rate - VectorX{{0.75, 0}}).norm() < 16 * epsilon);
  CHECK(created_energy(W, poisson.impulse, before, poisson.rate) == 0);
}

TEST_CASE("energy created at one place is not hidden by an impact elsewhere that dissipates") {
  MatrixX W = MatrixX::Identity(3, 3);
  W(0, 1) = W(1, 0) = -0.5;
  const VectorX before{{-1, 0.5, -10}}, e{{1, 0, 0}};
  const VectorX p = newton_impulse(W, before, e);
  CHECK(p.dot(before + 0.5 * W * p) < -40);
  CHECK(std::abs(created_energy(W, p, before, before + W * p) - 1.0 / 6) < 64 * epsilon);
}

TEST_CASE("Poisson's law never creates energy, lets no pair close, and is Newton's for one pair") {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> number(-1, 1), ratio(0, 1);
  int newton_creates = 0, newton_has_none = 0;
  double largest_by_newton = 0, largest_by_poisson = 0;
  for (int trial = 0; trial < 100000; ++trial) {
    const Eigen::Index n = 1 + trial % 5, dofs = 1 + (trial / 5) % 6;  // redundant where there are more pairs than DOFs
    MatrixX H(n, dofs);
    VectorX v(dofs), m(dofs), e(n);
    for (Eigen::Index j = 0; j < dofs; ++j) {
      v[j] = number(random);
      m[j] = std::pow(10, number(random));
      for (Eigen::Index i = 0; i < n; ++i) H(i, j) = number(random);
    }
    for (Eigen::Index i = 0; i < n; ++i) e[i] = trial % 3 == 0 ? std::round(ratio(random)) : ratio(random);
    const MatrixX W = H * m.cwiseInverse().asDiagonal() * H.transpose();
    const VectorX before = H * v;
    const PoissonImpact poisson = poisson_impact(W, before, e, solve);
    const auto energy = [&](const VectorX& p) {
      const VectorX after = v + m.cwiseInverse().asDiagonal() * H.transpose() * p;
      return (after.cwiseAbs2() - v.cwiseAbs2()).dot(m) / v.cwiseAbs2().dot(m);
    };
    const double by_poisson = energy(poisson.impulse);
    largest_by_poisson = std::max(largest_by_poisson, by_poisson);
    if (poisson.rate.minCoeff() < -1e-9 || poisson.impulse.minCoeff() < 0) FAIL_CHECK("closing or pulling in trial ", trial);
    if (newton_fails(W, before, e)) {
      ++newton_has_none;
      continue;
    }
    const VectorX p = newton_impulse(W, before, e);
    const double by_newton = energy(p);
    largest_by_newton = std::max(largest_by_newton, by_newton);
    const bool found = created_energy(W, p, before, before + W * p) > 1e-9 * v.cwiseAbs2().dot(m);
    if (by_newton > 1e-8) {
      ++newton_creates;
      if (!found) FAIL_CHECK("missed in trial ", trial);
    }
    if (n == 1 && before[0] < 0 && std::abs(poisson.impulse[0] - p[0]) > 16 * epsilon * p[0]) FAIL_CHECK("not Newton's in trial ", trial);
  }
  CHECK(newton_creates > 1000);  // else the trials would show nothing
  CHECK(newton_has_none > 1000);
  CHECK(largest_by_newton > 0.1);
  CHECK(largest_by_poisson < 1e-12);
}

TEST_CASE("a body between two walls it touches: Newton's law with two coefficients has no solution, Poisson's stops it") {
  const MatrixX W{{1, -1}, {-1, 1}};
  const VectorX before{{-1, 1}}, e{{1, 0}};
  CHECK(newton_fails(W, before, e));
  CHECK(poisson_impact(W, before, e, solve).rate.norm() < 16 * epsilon);
}

TEST_CASE("Newton's cradle: three equal balls that touch") {
  // gap rates v2 - v1, v3 - v2; the first ball hits at 1 m/s
  const MatrixX W{{2, -1}, {-1, 2}};
  const VectorX before{{-1, 0}};
  const auto velocities = [](const VectorX& p) { return Vector3(1 - p[0], p[0] - p[1], p[1]); };
  const VectorX elastic = VectorX::Ones(2), plastic = VectorX::Zero(2);
  const double by_newton = (velocities(newton_impulse(W, before, elastic)) - Vector3(-1, 2, 2) / 3).norm();
  CHECK(by_newton < 16 * epsilon);
  // compression (2, 1)/3 brings all to a third, expansion is as much again: where e is one, the laws agree
  const double by_poisson = (velocities(poisson_impact(W, before, elastic, solve).impulse) - Vector3(-1, 2, 2) / 3).norm();
  CHECK(by_poisson < 16 * epsilon);
  CHECK((velocities(poisson_impact(W, before, plastic, solve).impulse) - Vector3(1, 1, 1) / 3).norm() < 16 * epsilon);
}
