// Products and solutions in chunks of rows against Eigen's, on every SIMD target this machine has.
#include "base/chunked_rows.hpp"

#include <doctest/doctest.h>

#include <random>

#include "tests/support/numbers.hpp"
#include "tests/support/simd_targets.hpp"

using namespace nsframe;

namespace {

// Symmetric and positive definite; springs between near unknowns, some stiffer by ten decades, as rigid links are.
SparseMatrix spring_net(int size, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> exponent(-5, 5);
  std::vector<Eigen::Triplet<double>> entries;
  for (int i = 0; i < size; ++i) {
    entries.emplace_back(i, i, 1.0);
    for (int k = 0; k < 4; ++k) {
      const int j = std::min(size - 1, i + 1 + static_cast<int>(random() % 9));
      const double stiffness = std::pow(10, exponent(random));
      if (j == i) continue;
      entries.emplace_back(i, i, stiffness);
      entries.emplace_back(j, j, stiffness);
      entries.emplace_back(i, j, -stiffness);
      entries.emplace_back(j, i, -stiffness);
    }
  }
  SparseMatrix matrix(size, size);
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

template <class Check>
void for_targets_and_sizes(const Check& check) {
  test::on_every_simd_target([&](const std::string&) {
    for (const int size : {1, 2, 3, 4, 5, 8, 23, 64, 301}) {
      CAPTURE(size);
      check(size);
    }
  });
}

}  // namespace

TEST_CASE("chunked rows: products are those of the sparse matrix") {
  for_targets_and_sizes([](int size) {
    const SparseMatrix A = spring_net(size, 1);
    const ChunkedRows rows(A);
    const VectorX x = VectorX::Random(size), expected = A * x;
    VectorX y = VectorX::Constant(rows.padded_rows(), 7);
    rows.multiply(x.data(), y.data());
    const VectorX bound = 8 * epsilon * (MatrixX(A).cwiseAbs() * x.cwiseAbs());
    CHECK(((y.head(size) - expected).array().abs() <= bound.array()).all());
    CHECK(y.tail(y.size() - size).isZero(0));
  });
}

TEST_CASE("chunked rows: solutions with a factor leave no more than Eigen's do, stiff links or not") {
  for_targets_and_sizes([](int size) {
    for (unsigned seed = 1; seed < 6; ++seed) {
      const SparseMatrix A = spring_net(size, seed);
      const Eigen::SimplicialLDLT<SparseMatrix> factor(A);
      REQUIRE(factor.info() == Eigen::Success);
      const ChunkedFactor chunked(factor);
      const VectorX rhs = VectorX::Random(size), reference = factor.solve(rhs);
      VectorX x(size);
      chunked.solve(rhs.data(), x.data());
      const VectorX scale = MatrixX(A).cwiseAbs() * x.cwiseAbs() + rhs.cwiseAbs();
      CHECK(((A * x - rhs).array().abs() <= 64 * epsilon * scale.array()).all());
      VectorX same = rhs;  // in place
      chunked.solve(same.data(), same.data());
      CHECK(same == x);
      CHECK((x - reference).norm() <= 1e-5 * reference.norm());  // the condition is 1e10
    }
  });
}
