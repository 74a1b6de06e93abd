#include "integrators/impact_matrix.hpp"

#include "base/errors.hpp"

namespace nsframe {

namespace {

constexpr double negligible = 1e-18;  // of eps K beside M

}  // namespace

ImpactMatrix::ImpactMatrix(const System& system) {
  const SparseMatrix& M = system.mass();
  const SparseMatrix& K = system.initial_stiffness;
  const VectorX mass = M.diagonal();
  double lightest = std::numeric_limits<double>::infinity(), stiffest = 0;
  massless_.assign(static_cast<std::size_t>(mass.size()), false);
  for (Eigen::Index i = 0; i < mass.size(); ++i) {
    if (mass[i] > 0) {
      lightest = std::min(lightest, mass[i]);
    } else {
      massless_[static_cast<std::size_t>(i)] = any_massless_ = true;
    }
    stiffest = std::max(stiffest, std::abs(K.coeff(i, i)));
  }
  eps_ = stiffest > 0 && std::isfinite(lightest) ? negligible * lightest / stiffest : 0;
  factor_.compute(SparseMatrix(M + 0.5 * eps_ * (K + SparseMatrix(K.transpose()))));
  if (factor_.info() != Eigen::Success) throw ConvergenceError("the mass matrix is singular where the stiffness is, too");
  const Contacts& contacts = system.contacts();
  for (int c = 0; c < contacts.size(); ++c) {
    bool touched = false;
    for (SparseRows::InnerIterator entry(contacts.jacobian, c); entry; ++entry) touched = touched || massless(entry.col());
    compliant_.push_back(touched);
  }
}

VectorX ImpactMatrix::follow(const VectorX& residual) const {
  VectorX load = VectorX::Zero(residual.size());
  for (Eigen::Index i = 0; i < load.size(); ++i) {
    if (massless(i)) load[i] = eps_ * residual[i];
  }
  VectorX motion = factor_.solve(load);
  for (Eigen::Index i = 0; i < load.size(); ++i) {
    if (!massless(i)) motion[i] = 0;
  }
  return motion;
}

}  // namespace nsframe
