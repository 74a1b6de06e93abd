// The block-diagonal form of matrices whose eigenvectors are (nearly) parallel.
#include "modal/block_diagonal.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <stdexcept>

#include "tests/support/numbers.hpp"

using namespace nsframe;

namespace {

MatrixX matrix_of(const BlockDiagonal& form) {
  MatrixX B = MatrixX::Zero(form.basis.rows(), form.basis.cols());
  for (const DiagonalBlock& block : form.blocks) {
    B.block(block.first, block.first, block.size, block.size) = block.full();
  }
  return B;
}

// A = T J T^-1, an orthogonal T that depends on `seed`.
LongMatrix turned(const MatrixX& J, unsigned seed) {
  std::srand(seed);
  const MatrixX Q = Eigen::HouseholderQR<MatrixX>(MatrixX::Random(J.rows(), J.cols())).householderQ();
  return (Q * J * Q.transpose()).cast<long double>();
}

// The form of a matrix similar to J.
void check_form(const MatrixX& J, unsigned seed, std::size_t blocks, double condition) {
  const LongMatrix A = turned(J, seed);
  const BlockDiagonal form = block_diagonal_form(A);
  CHECK(form.blocks.size() == blocks);
  CHECK(form.condition < condition);
  const auto size = static_cast<double>(A.norm());
  const MatrixX rounded = A.cast<double>();
  CHECK((rounded * form.basis - form.basis * matrix_of(form)).norm() <= 1e-14 * size * form.basis.norm());
  CHECK((form.inverse * form.basis - MatrixX::Identity(A.rows(), A.cols())).norm() <= 1e-13 * form.condition);
}

}  // namespace

TEST_CASE("block-diagonal form: simple eigenvalues, real and complex, have blocks of their own") {
  MatrixX J = MatrixX::Zero(5, 5);
  J.topLeftCorner(2, 2) << -1, 5, -5, -1;
  J.block(2, 2, 2, 2) << -0.5, 12, -12, -0.5;
  J(4, 4) = -3;
  J(0, 2) = J(1, 4) = 2;  // not normal
  check_form(J, 3, 3, 3);
}

TEST_CASE("block-diagonal form: Jordan blocks, exact and nearly so, real and complex, are dense blocks with a good basis") {
  for (const double off : {0.0, 1e-14, 1e-9, 1e-5}) {
    CAPTURE(off);
    MatrixX real = MatrixX::Zero(4, 4), complex = MatrixX::Zero(5, 5);
    real.diagonal() << -2, -2 - off, -2 + off, -9;
    real(0, 1) = real(1, 2) = real(2, 3) = 1;
    complex.topLeftCorner(2, 2) << -1, 7, -7, -1;
    complex.block(2, 2, 2, 2) << -1 - off, 7, -7, -1 - off;
    complex(0, 2) = complex(1, 3) = complex(2, 4) = 1;
    complex(4, 4) = -1;
    for (const MatrixX& J : {real, complex}) check_form(J, 5, 2, 100);
  }
}

TEST_CASE("block-diagonal form: the growth of a dense block bounds its exponential") {
  MatrixX J = MatrixX::Zero(2, 2);
  J << -1, 8, 0, -1;
  const BlockDiagonal form = block_diagonal_form(turned(J, 1));
  REQUIRE(form.blocks.size() == 1);
  const double most = std::exp(-1.0) * std::hypot(8, 1);  // about: exp(-t) |1, 8 t; 0, 1| at t = 1
  CHECK(form.blocks[0].growth >= most);
  CHECK(form.blocks[0].growth < 2 * most);
}

TEST_CASE("block-diagonal form: growing modes are refused, and more parallel ones than a block may have") {
  CHECK_THROWS_AS(block_diagonal_form(LongMatrix(LongMatrix::Identity(2, 2))), std::runtime_error);
  MatrixX J = -MatrixX::Identity(24, 24);
  J.diagonal(1).setOnes();
  CHECK_THROWS_AS(block_diagonal_form(turned(J, 2)), std::runtime_error);
}
