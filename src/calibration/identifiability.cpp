#include "calibration/identifiability.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace nsframe {

Identifiability identifiability(const MatrixX& sensitivity, double accuracy) {
  constexpr double vanished = 1e-7;  // relative to the largest singular value: the sensitivities themselves are known to 1e-8
  constexpr double touched = 1e-6;   // share of a parameter in what no frequency sees
  const Eigen::Index count = sensitivity.cols();
  const VectorX length = sensitivity.colwise().norm().transpose();
  Identifiability out;
  out.singular_values = VectorX::Zero(count);
  VectorX hidden = VectorX::Zero(count);
  std::vector<Eigen::Index> seen;
  for (Eigen::Index j = 0; j < count; ++j) {
    if (length[j] > vanished * length.maxCoeff()) {
      seen.push_back(j);
    } else {
      hidden[j] = 1;
      out.unseen.push_back(VectorX::Unit(count, j));
    }
  }
  MatrixX covariance = MatrixX::Zero(count, count);
  const auto rank = static_cast<Eigen::Index>(seen.size());
  if (rank == 0) seen.push_back(0);  // the decomposition needs a column
  const Eigen::JacobiSVD<MatrixX> svd(sensitivity(Eigen::all, seen), Eigen::ComputeFullV);
  out.singular_values.head(svd.singularValues().size()) = svd.singularValues();
  for (Eigen::Index k = 0; k < rank; ++k) {
    VectorX direction = VectorX::Zero(count);
    direction(seen) = svd.matrixV().col(k);
    if (out.singular_values[k] > vanished * out.singular_values[0]) {
      covariance += direction * direction.transpose() * std::pow(accuracy / out.singular_values[k], 2);
    } else {
      hidden += direction.cwiseAbs2();
      out.unseen.push_back(direction);
    }
  }
  out.error = covariance.diagonal().cwiseSqrt();
  out.correlation = MatrixX::Identity(count, count);
  for (Eigen::Index i = 0; i < count; ++i)
    if (hidden[i] > touched) out.error[i] = std::numeric_limits<double>::infinity();
  for (Eigen::Index i = 0; i < count; ++i) {
    for (Eigen::Index j = 0; j < count; ++j) {
      if (i != j) out.correlation(i, j) = std::isfinite(out.error[i] + out.error[j]) ? covariance(i, j) / (out.error[i] * out.error[j]) : 0;
    }
  }
  return out;
}

}  // namespace nsframe
