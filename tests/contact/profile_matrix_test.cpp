// Matrices stored by their profile, and the solver of large sets on them, against dense ones.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "contact/contact_problem.hpp"
#include "contact/profile_matrix.hpp"
#include "tests/support/numbers.hpp"

using namespace nsframe;
using namespace nsframe::test;

namespace {

// Positive definite, with entries that die out by `decay` from one to the next, rows and columns by `order`.
MatrixX dying_out(const std::vector<int>& order, double decay, std::mt19937_64& random) {
  std::uniform_real_distribution<double> number(-1, 1);
  const auto n = static_cast<Eigen::Index>(order.size());
  MatrixX L = MatrixX::Identity(n, n);
  for (Eigen::Index i = 0; i < n; ++i) {
    for (Eigen::Index j = std::max<Eigen::Index>(0, i - 12); j < i; ++j) L(i, j) = number(random) * std::pow(decay, static_cast<double>(i - j));
  }
  MatrixX W(n, n);
  W(order, order) = MatrixX(L * L.transpose());
  return W;
}

std::vector<int> in_order(int n) {
  std::vector<int> order(static_cast<std::size_t>(n));
  for (int i = 0; i < n; ++i) order[static_cast<std::size_t>(i)] = i;
  return order;
}

}  // namespace

TEST_CASE("a matrix by its profile has the products and the solutions of the dense one, on any set of its rows") {
  std::mt19937_64 random(5);
  for (const bool shuffled : {false, true}) {
    for (const double decay : {0.02, 0.5, 0.999}) {
      CAPTURE(shuffled);
      CAPTURE(decay);
      const int n = 90;
      std::vector<int> order = in_order(n);
      if (shuffled) std::shuffle(order.begin(), order.end(), random);
      const MatrixX W = dying_out(order, decay, random);
      const VectorX scale = W.diagonal().cwiseSqrt().cwiseInverse();
      const ProfileMatrix profile(W, scale, 0.1 * machine_epsilon);
      CHECK(profile.share() < 0.35);  // twelve neighbours each way, however the rows stand
      CHECK(profile.symmetric(1e-12));
      const MatrixX dense = (scale.asDiagonal() * W * scale.asDiagonal())(profile.order(), profile.order());
      const VectorX p = VectorX::NullaryExpr(n, [&] { return std::normal_distribution<double>()(random); });
      VectorX product, size;
      profile.multiply(p, product, size);
      CHECK((product - dense * p).cwiseAbs().maxCoeff() < 64 * epsilon * size.maxCoeff());
      CHECK((size - dense.cwiseAbs() * p.cwiseAbs()).cwiseAbs().maxCoeff() < 64 * epsilon * size.maxCoeff());
      std::vector<int> set;
      for (int i = 0; i < n; ++i) {
        if (random() % 3 > 0) set.push_back(i);
      }
      ProfileFactor factor;
      REQUIRE(factor.compute(profile, set, 1e-10));
      VectorX x = p(set);
      factor.solve(x);
      CHECK((dense(set, set) * x - p(set)).cwiseAbs().maxCoeff() < 256 * epsilon * (dense(set, set).cwiseAbs() * x.cwiseAbs()).maxCoeff());
      std::vector<double> row(set.size());
      profile.gather(set[3], set, row.data());
      for (std::size_t k = 0; k < set.size(); ++k) CHECK(row[k] == profile.entry(set[3], set[k]));
    }
  }
}

TEST_CASE("a profile of a singular set has no factor, and one that is not symmetric is told") {
  MatrixX W = MatrixX::Identity(4, 4);
  W(2, 3) = W(3, 2) = 1;
  const ProfileMatrix twins(W, VectorX::Ones(4), 1e-16);
  ProfileFactor factor;
  CHECK_FALSE(factor.compute(twins, {0, 2, 3}, 1e-10));
  CHECK(factor.compute(twins, {0, 1, 3}, 1e-10));
  W(2, 3) = 0.5;
  CHECK_FALSE(ProfileMatrix(W, VectorX::Ones(4), 1e-16).symmetric(1e-12));
  W(2, 3) = 0;
  CHECK_FALSE(ProfileMatrix(W, VectorX::Ones(4), 1e-16).symmetric(1e-12));
}

TEST_CASE("hundreds of pairs in narrow profiles are solved as by the dense method, in any order") {
  std::mt19937_64 random(6);
  std::normal_distribution<double> normal;
  for (const int n : {40, 256}) {
    std::vector<int> order = in_order(n);
    std::shuffle(order.begin(), order.end(), random);
    ContactProblem problem{dying_out(order, 0.3, random), VectorX::NullaryExpr(n, [&] { return normal(random); })};
    const ContactSolution narrow = solve_active_set(problem, {});
    REQUIRE(narrow.converged);
    CHECK(narrow.iterations < 20);
    problem.delassus.array() += 1e-9 * problem.delassus.diagonal().maxCoeff();  // all feel all: dense
    const ContactSolution dense = solve_active_set(problem, {});
    REQUIRE(dense.converged);
    CHECK((narrow.impulse - dense.impulse).cwiseAbs().maxCoeff() < 1e-6 * dense.impulse.maxCoeff());
  }
}
