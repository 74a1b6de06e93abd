#include "integrators/mode_response.hpp"

#include <complex>

namespace nsframe {

Scheme::ModeResponse response_of(const Eigen::Matrix2d& amplification, double h) {
  const double half_trace = 0.5 * amplification.trace();
  const std::complex<double> root = std::sqrt(std::complex<double>(half_trace * half_trace - amplification.determinant(), 0));
  const std::complex<double> exponent = std::log(half_trace + root) / h;
  return {-exponent.real() / std::abs(exponent), std::abs(exponent)};
}

Scheme::ModeResponse theta_method_response(double theta, double w, double xi, double h) {
  if (w == 0) return {0, 0};
  const double c = 2 * xi * w, k = w * w, J = 1 + h * theta * c + h * h * theta * theta * k;
  // v+ = from_v v + from_q q, q+ = q + h ((1 - theta) v + theta v+)
  const double from_v = (1 - h * (1 - theta) * c - h * h * theta * (1 - theta) * k) / J, from_q = -h * k / J;
  Eigen::Matrix2d step;
  step << 1 + h * theta * from_q, h * (1 - theta) + h * theta * from_v, from_q, from_v;
  return response_of(step, h);
}

}  // namespace nsframe
