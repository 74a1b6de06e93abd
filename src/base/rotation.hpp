// Finite rotations in space: R = exp(skew(v)) with the rotation vector v, and its derivatives. Spins are spatial:
// dR = skew(w) R. See Cardona, Geradin (1988) and Ibrahimbegovic (1997).
#pragma once

#include "base/types.hpp"

namespace nsframe {

using Quaternion = Eigen::Quaterniond;

// skew(a) b = a x b
Matrix3 skew(const Vector3& a);

Quaternion rotation_exponential(const Vector3& vector);
// The rotation vector of least length, at most pi.
Vector3 rotation_logarithm(const Matrix3& rotation);

// The rotation of least angle that takes unit vector a to b.
Quaternion shortest_rotation(const Vector3& a, const Vector3& b);

// Ts(v): spin of exp(v) from the rate of v, w = Ts dv.
Matrix3 spin_by_vector(const Vector3& vector);
// Its inverse, dv = Ts^-1 w; exists for |v| < 2 pi.
Matrix3 vector_by_spin(const Vector3& vector);
// d(Ts(v)^-T m)/dv at constant m.
Matrix3 moment_derivative(const Vector3& vector, const Vector3& moment);

}  // namespace nsframe
