// Functions of finite rotations against finite differences and each other.
#include <doctest/doctest.h>

#include "base/rotation.hpp"

using namespace nsframe;

namespace {

const Vector3 direction = Vector3(0.3, -0.7, 0.5).normalized();
const Vector3 moment(2.0, -1.0, 0.7);

// Angles on both sides of every change between series and closed form.
const std::array<double, 11> angles{0, 1e-9, 1e-5, 0.99e-4, 1.01e-4, 0.99e-2, 1.01e-2, 0.499, 0.501, 2.5, 6.0};

}  // namespace

TEST_CASE("the logarithm of a rotation inverts its exponential up to half a circle, and keeps tiny rotations") {
  for (const double angle : {0.0, 1e-300, 1e-9, 1.99e-4, 2.01e-4, 0.5, 3.14}) {
    CAPTURE(angle);
    const Vector3 v = angle * direction;
    // the entries of a rotation matrix carry rounding of 1e-16
    CHECK((rotation_logarithm(rotation_exponential(v).toRotationMatrix()) - v).norm() < 1e-15 + 2e-13 * angle * (angle > 3));
  }
  CHECK((rotation_logarithm(rotation_exponential(4 * direction).toRotationMatrix()) - (4 - 2 * pi) * direction).norm() < 1e-14);
}

TEST_CASE("a rotation vector's rate makes the spin of its rotation") {
  for (const double angle : angles) {
    CAPTURE(angle);
    const Vector3 v = angle * direction;
    const Matrix3 R = rotation_exponential(v).toRotationMatrix();
    for (int i = 0; i < 3; ++i) {
      const double h = 1e-5;
      const Matrix3 change = (rotation_exponential(v + h * Vector3::Unit(i)).toRotationMatrix() -
                              rotation_exponential(v - h * Vector3::Unit(i)).toRotationMatrix()) / (2 * h);
      // central differences: h^2 and 1e-16 / h
      CHECK((change * R.transpose() - skew(spin_by_vector(v).col(i))).norm() < 1e-9);
    }
    CHECK((spin_by_vector(v) * vector_by_spin(v) - Matrix3::Identity()).norm() < 1e-13 * (angle > 5 ? 100 : 1));
  }
}

TEST_CASE("the derivative of a moment conjugate to a rotation vector equals central differences") {
  for (const double angle : angles) {
    CAPTURE(angle);
    const Vector3 v = angle * direction;
    Matrix3 differences;
    for (int i = 0; i < 3; ++i) {
      const double h = 1e-5;
      differences.col(i) = (vector_by_spin(v + h * Vector3::Unit(i)).transpose() * moment -
                            vector_by_spin(v - h * Vector3::Unit(i)).transpose() * moment) / (2 * h);
    }
    const Matrix3 exact = moment_derivative(v, moment);
    CHECK((exact - differences).norm() < 1e-9 * exact.norm() * (angle > 5 ? 100 : 1));
  }
}
