#include "base/rotation.hpp"

#include <array>
#include <cmath>

namespace nsframe {

namespace {

// Taylor coefficients of (1 - (x/2) cot(x/2)) / x^2 in x^2: |B_2n| / (2n)!
constexpr std::array<double, 8> inverse_series{1.0 / 12,
                                               1.0 / 720,
                                               1.0 / 30240,
                                               1.0 / 1209600,
                                               1.0 / 47900160,
                                               691.0 / 1307674368000,
                                               1.0 / 74724249600,
                                               3617.0 / 10670622842880000};
constexpr double series_limit = 0.5;  // [rad]; the first term left out is below 1e-17 of the first

// eta(x) of Ts^-1 = 1 - skew/2 + eta skew^2, and eta'(x) / x.
struct InverseFactors {
  double eta = 0, slope = 0;
  explicit InverseFactors(double x) {
    if (x < series_limit) {
      double power = 1;
      for (std::size_t n = 0; n < inverse_series.size(); ++n, power *= x * x) {
        eta += inverse_series[n] * power;
        if (n + 1 < inverse_series.size()) slope += 2 * static_cast<double>(n + 1) * inverse_series[n + 1] * power;
      }
      return;
    }
    const double half_sine = std::sin(x / 2);
    eta = (1 - x / 2 / std::tan(x / 2)) / (x * x);
    slope = (x * (x + std::sin(x)) - 8 * half_sine * half_sine) / (4 * x * x * x * x * half_sine * half_sine);
  }
};

}  // namespace

Matrix3 skew(const Vector3& a) {
  Matrix3 m;
  m << 0, -a.z(), a.y(), a.z(), 0, -a.x(), -a.y(), a.x(), 0;
  return m;
}

Quaternion rotation_exponential(const Vector3& vector) {
  const double angle = vector.norm();
  Quaternion rotation;
  rotation.w() = std::cos(angle / 2);
  // sin(a/2)/a to rounding where a^2 is below the square root of epsilon
  rotation.vec() = (angle < 1e-4 ? 0.5 - angle * angle / 48 : std::sin(angle / 2) / angle) * vector;
  return rotation;
}

Vector3 rotation_logarithm(const Matrix3& rotation) {
  Quaternion q(rotation);
  if (q.w() < 0) q.coeffs() = -q.coeffs();
  const double sine = q.vec().norm();
  if (sine < 1e-4) return 2 * (1 + sine * sine / 6) * q.vec();  // asin(s)/s; the next term is below 1e-17
  return 2 * std::atan2(sine, q.w()) / sine * q.vec();
}

Quaternion shortest_rotation(const Vector3& a, const Vector3& b) {
  const double cosine = a.dot(b);
  Quaternion half_turn(0, 0, 0, 0);
  if (cosine < -1 + 1e-12) {
    half_turn.vec() = a.unitOrthogonal();
    return half_turn;
  }
  const Vector3 axis = a.cross(b);
  return Quaternion(1 + cosine, axis.x(), axis.y(), axis.z()).normalized();
}

Matrix3 spin_by_vector(const Vector3& vector) {
  const double x = vector.norm();
  const Matrix3 S = skew(vector);
  const bool small = x < 1e-2;  // the first terms left out are below 1e-16
  const double x2 = x * x, half_sine = std::sin(x / 2);
  const double first = small ? 0.5 - x2 / 24 + x2 * x2 / 720 - x2 * x2 * x2 / 40320 : 2 * half_sine * half_sine / x2;
  const double second = small ? 1.0 / 6 - x2 / 120 + x2 * x2 / 5040 - x2 * x2 * x2 / 362880 : (x - std::sin(x)) / (x2 * x);
  return Matrix3::Identity() + first * S + second * S * S;
}

Matrix3 vector_by_spin(const Vector3& vector) {
  const Matrix3 S = skew(vector);
  return Matrix3::Identity() - 0.5 * S + InverseFactors(vector.norm()).eta * S * S;
}

Matrix3 moment_derivative(const Vector3& v, const Vector3& m) {
  const InverseFactors factor(v.norm());
  const double along = v.dot(m);
  const Vector3 twice = along * v - v.squaredNorm() * m;  // v x (v x m)
  return -0.5 * skew(m) + factor.eta * (v * m.transpose() + along * Matrix3::Identity() - 2 * m * v.transpose()) +
         factor.slope * twice * v.transpose();
}

}  // namespace nsframe
