// The small symmetric inverse against Eigen's, with and without pivots that vanish.
#include <doctest/doctest.h>

#include "base/symmetric_inverse.hpp"

using namespace nsframe;

namespace {

using Matrix5 = Eigen::Matrix<double, 5, 5>;

}  // namespace

TEST_CASE("the inverse of positive definite, indefinite and pivotless symmetric matrices is Eigen's") {
  Matrix5 A;
  for (int i = 0; i < 5; ++i) {
    for (int j = 0; j < 5; ++j) A(i, j) = std::cos(1.0 + i * j) + std::cos(1.0 + j * i);
  }
  Matrix5 indefinite = A * A.transpose() + 0.1 * Matrix5::Identity();
  const Matrix5 definite = indefinite;
  indefinite(2, 2) -= 20;
  Matrix5 pivotless = definite;
  pivotless(0, 0) = 0;
  for (const Matrix5& matrix : {definite, indefinite, pivotless}) {
    const Matrix5 expected = matrix.inverse();
    CHECK((symmetric_inverse<5>(matrix) - expected).norm() < 1e-10 * expected.norm());
  }
}
