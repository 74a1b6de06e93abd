#include "integrators/mode_response.hpp"

#include <complex>

#include "base/decompositions.hpp"

namespace nsframe {

namespace {

Scheme::ModeResponse response_of(std::complex<double> eigenvalue, double h) {
  const std::complex<double> exponent = std::log(eigenvalue) / h;
  return {-exponent.real() / std::abs(exponent), std::abs(exponent)};
}

Eigen::VectorXcd eigenvalues(const Eigen::Matrix3d& matrix) { return Eigen::EigenSolver<MatrixX>(MatrixX(matrix), false).eigenvalues(); }

}  // namespace

Scheme::ModeResponse response_of(const Eigen::Matrix2d& amplification, double h) {
  const double half_trace = 0.5 * amplification.trace();
  return response_of(half_trace + std::sqrt(std::complex<double>(half_trace * half_trace - amplification.determinant(), 0)), h);
}

Scheme::ModeResponse response_of(const Eigen::Matrix3d& amplification, double h) {
  const Eigen::VectorXcd roots = eigenvalues(amplification);
  std::complex<double> found = roots[0];
  for (const std::complex<double>& root : roots) {
    const double turns = root.imag() - found.imag();
    if (turns > 0 || (turns == 0 && std::abs(root) > std::abs(found))) found = root;
  }
  return response_of(found, h);
}

double spectral_radius(const Eigen::Matrix3d& amplification) { return eigenvalues(amplification).cwiseAbs().maxCoeff(); }

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
