#include "elements/beam_shape_functions.hpp"

namespace nsframe {

Eigen::Matrix<double, 6, 12> beam_shape_functions(double along, double length) {
  const double s = along, L = length;
  const double deflection[4] = {1 - 3 * s * s + 2 * s * s * s, L * s * (1 - s) * (1 - s), s * s * (3 - 2 * s),
                                L * s * s * (s - 1)};
  const double slope[4] = {6 * s * (s - 1) / L, (1 - s) * (1 - 3 * s), 6 * s * (1 - s) / L, s * (3 * s - 2)};
  Eigen::Matrix<double, 6, 12> local = Eigen::Matrix<double, 6, 12>::Zero();
  for (Eigen::Index end = 0; end < 2; ++end) {
    const Eigen::Index first = 6 * end;
    const double share = end == 0 ? 1 - s : s;
    local(0, first) = share;                    // ux
    local(1, first + 1) = deflection[2 * end];  // uy from uy, rz
    local(1, first + 5) = deflection[2 * end + 1];
    local(2, first + 2) = deflection[2 * end];  // uz from uz, ry (uz' = -ry)
    local(2, first + 4) = -deflection[2 * end + 1];
    local(3, first + 3) = share;            // rx
    local(4, first + 2) = -slope[2 * end];  // ry = -uz'
    local(4, first + 4) = slope[2 * end + 1];
    local(5, first + 1) = slope[2 * end];  // rz = uy'
    local(5, first + 5) = slope[2 * end + 1];
  }
  return local;
}

}  // namespace nsframe
