#include "integrators/impact_matrix.hpp"

#include "base/decompositions.hpp"
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

VectorX ImpactMatrix::follow(const Contacts& contacts, const std::vector<int>& held, const VectorX& residual, VectorX* forces) const {
  VectorX motion = follow(residual);
  if (forces) forces->setZero(static_cast<Eigen::Index>(held.size()));
  std::vector<Eigen::Index> pressed;
  for (std::size_t k = 0; k < held.size(); ++k) {
    if (compliant(held[k])) pressed.push_back(static_cast<Eigen::Index>(k));
  }
  if (pressed.empty()) return motion;
  const auto count = static_cast<Eigen::Index>(pressed.size());
  const auto row = [&](Eigen::Index k) { return contacts.jacobian.row(held[static_cast<std::size_t>(pressed[static_cast<std::size_t>(k)])]); };
  MatrixX responses(motion.size(), count), flexibility(count, count);
  VectorX gap(count);
  for (Eigen::Index b = 0; b < count; ++b) responses.col(b) = follow(VectorX(row(b).transpose()));
  for (Eigen::Index a = 0; a < count; ++a) {
    gap[a] = row(a).dot(motion);
    for (Eigen::Index b = 0; b < count; ++b) flexibility(a, b) = row(a).dot(VectorX(responses.col(b)));
  }
  const VectorX pull = RankRevealing<double>(flexibility, machine_epsilon * static_cast<double>(count)).solve(gap);
  motion -= responses * pull;
  if (forces) (*forces)(pressed) = -pull;
  return motion;
}

}  // namespace nsframe
