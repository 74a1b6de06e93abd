// Products and solutions in chunks of rows against Eigen's, on every SIMD target this machine has.
#include "base/chunked_rows.hpp"

#include <doctest/doctest.h>

#include <random>

#include "base/large_pages.hpp"
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

// Floors of nine unknowns on top of each other, the last one standing, with masses beside their springs; springs of floor `odd` differ.
SparseMatrix tower(int floors, int odd = -1, double difference = 0) {
  constexpr int size = 9;
  std::vector<Eigen::Triplet<double>> entries;
  const auto spring = [&](int i, int j, double stiffness) {
    entries.emplace_back(i, i, stiffness);
    if (j >= size * floors) return;
    entries.emplace_back(j, j, stiffness);
    entries.emplace_back(i, j, -stiffness);
    entries.emplace_back(j, i, -stiffness);
  };
  for (int floor = 0; floor < floors; ++floor) {
    const double factor = floor == odd ? 1 + difference : 1;
    for (int i = 0; i < size; ++i) {
      const int own = size * floor + i;
      entries.emplace_back(own, own, 3.0 + i);
      spring(own, own + size, factor * (1 + 0.3 * i));                                   // a column
      if (i + 1 < size) spring(own, own + 1, factor * (i % 3 == 0 ? 1e6 : 7.0 / (i + 1)));  // the slab
    }
  }
  SparseMatrix matrix(size * floors, size * floors);
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

// The same, its unknowns in another order.
SparseMatrix shuffled(const SparseMatrix& matrix) {
  std::mt19937 random(3);
  Eigen::PermutationMatrix<Eigen::Dynamic, Eigen::Dynamic, int> order(matrix.rows());
  order.setIdentity();
  for (int i = static_cast<int>(matrix.rows()) - 1; i > 0; --i) {
    std::swap(order.indices()[i], order.indices()[static_cast<int>(random() % static_cast<unsigned>(i + 1))]);
  }
  SparseMatrix mixed(matrix.rows(), matrix.cols());
  mixed = matrix.selfadjointView<Eigen::Lower>().twistedBy(order);
  return mixed;
}

void check_product(const SparseMatrix& A, const ChunkedRows& rows) {
  const VectorX x = VectorX::Random(A.cols()), expected = A * x;
  VectorX y(rows.padded_rows());
  rows.multiply(x.data(), y.data());
  const VectorX bound = 16 * epsilon * (MatrixX(A).cwiseAbs() * x.cwiseAbs());
  CHECK(((y.head(A.rows()) - expected).array().abs() <= bound.array()).all());
}

// Within what (396) allows: sqrt(a_ii a_jj) for every entry of a floor and its neighbours.
void check_solution(const SparseMatrix& A, const ChunkedFactor& factor) {
  const VectorX rhs = VectorX::Random(A.rows()), size = VectorX(A.diagonal()).cwiseSqrt();
  VectorX x(A.rows());
  factor.solve(rhs.data(), x.data());
  const VectorX residual = A * x - rhs;
  for (Eigen::Index i = 0; i < A.rows(); ++i) {
    const Eigen::Index first = std::max<Eigen::Index>(0, i - 17), last = std::min(A.rows(), i + 18);
    const double reach = size.segment(first, last - first).dot(x.segment(first, last - first).cwiseAbs());
    CHECK(std::abs(residual[i]) <= 16 * epsilon * (size[i] * reach + std::abs(rhs[i])));
  }
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
      const SparseCholesky factor(A);
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

TEST_CASE("chunked rows: what equal floors have in common is stored once, and gives the same") {
  for (const int floors : {6, 40, 121}) {
    CAPTURE(floors);
    const SparseMatrix A = tower(floors);
    const ChunkedRows rows(A);
    check_product(A, rows);
    const SparseCholesky cholesky(A);
    const ChunkedFactor factor(cholesky);
    check_solution(A, factor);
    if (floors < 40) continue;
    CHECK(rows.entries().stored_share() < 7.0 / floors);     // chunks of four rows repeat every fourth floor of nine
    CHECK(factor.entries().stored_share() < 25.0 / floors);  // the factors of the first floors tend to those of all others
  }
}

TEST_CASE("chunked rows: a floor that differs by more than rounding is not taken for another") {
  for (const double difference : {1e-14, 1e-12, 1e-3}) {
    CAPTURE(difference);
    const SparseMatrix A = tower(60, 30, difference), B = tower(60);
    CHECK(ChunkedRows(A).entries().stored > ChunkedRows(B).entries().stored);
    check_product(A, ChunkedRows(A));
    const SparseCholesky cholesky(A);
    check_solution(A, ChunkedFactor(cholesky));
  }
}

TEST_CASE("elimination order: floor by floor where floors are alike, else by minimum degree") {
  const auto minimum = [](const SparseMatrix& A) { return Eigen::SimplicialLDLT<SparseMatrix>(A).matrixL().nestedExpression().nonZeros(); };
  const auto chosen = [](const SparseMatrix& A) { return SparseCholesky(A).matrixL().nestedExpression().nonZeros(); };
  const SparseMatrix alike = tower(50), mixed = shuffled(alike);
  CHECK(SparseCholesky(alike).permutationP().size() == 0);
  CHECK(SparseCholesky(mixed).permutationP().size() == mixed.rows());
  CHECK(chosen(mixed) == minimum(mixed));
  for (const SparseMatrix& A : {alike, mixed, spring_net(80, 2)}) {
    const Eigen::SimplicialLDLT<SparseMatrix, Eigen::Lower, Eigen::NaturalOrdering<int>> own(A);
    CHECK(factor_entries(A, {}) == own.matrixL().nestedExpression().nonZeros());
    const Eigen::SimplicialLDLT<SparseMatrix> least(A);
    const auto& place = least.permutationP().indices();
    CHECK(factor_entries(A, {place.data(), place.data() + place.size()}) == minimum(A));
  }
}

TEST_CASE("a copy on large pages is the array, below and from the length on from which they are asked for") {
  for (const Eigen::Index size : {Eigen::Index{0}, Eigen::Index{7}, large_page_doubles - 1, large_page_doubles, 2 * large_page_doubles + 12345}) {
    const VectorX array = VectorX::LinSpaced(size, -1, 2);
    const VectorX copy = on_large_pages(array);
    REQUIRE(copy.size() == size);
    CHECK((size == 0 || copy.data() != array.data()));
    CHECK(copy == array);
  }
}
