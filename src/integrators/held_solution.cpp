#include "integrators/held_solution.hpp"

namespace nsframe {

namespace {

constexpr double least_pivot = 1e-5;  // of Cholesky's factor of a matrix with a unit diagonal, above which pairs are not redundant

}  // namespace

void HeldSolution::hold(const Contacts& contacts, const std::vector<int>& pairs) {
  contacts_ = &contacts;
  if (pairs == pairs_ && factored_ == matrix_.factorizations()) return;
  pairs_ = pairs;
  factored_ = matrix_.factorizations();
  const auto count = static_cast<Eigen::Index>(pairs_.size());
  if (count == 0) return;
  MatrixX W(count, count);
  for (Eigen::Index b = 0; b < count; ++b) W.col(b) = matrix_.rates_by(contacts, pairs_[static_cast<std::size_t>(b)])(pairs_);
  scale_ = W.diagonal().cwiseSqrt().cwiseInverse();
  const MatrixX scaled = scale_.asDiagonal() * W * scale_.asDiagonal();
  cholesky_.compute(scaled);
  redundant_ = cholesky_.info() != Eigen::Success || cholesky_.matrixLLT().diagonal().minCoeff() < least_pivot;
  if (redundant_) set_.compute(scaled, 1e-12);
}

VectorX HeldSolution::multipliers(const VectorX& gap) const {
  const VectorX scaled = scale_.cwiseProduct(gap);
  return -scale_.cwiseProduct(redundant_ ? VectorX(set_.solve(scaled)) : VectorX(cholesky_.solve(scaled)));
}

void HeldSolution::close_gaps(const VectorX& gap, VectorX& q) {
  matrix_.respond(*contacts_, pairs_, multipliers(gap), response_);
  q += response_;
}

void HeldSolution::solve(const VectorX& rhs, VectorX& x, VectorX* forces) {
  matrix_.solve(rhs, x);
  const auto count = static_cast<Eigen::Index>(pairs_.size());
  if (forces) forces->setZero(count);
  if (count == 0) return;
  VectorX gap(count);
  for (Eigen::Index k = 0; k < count; ++k) gap[k] = contacts_->jacobian.row(pairs_[static_cast<std::size_t>(k)]).dot(x);
  const VectorX l = multipliers(gap);
  matrix_.respond(*contacts_, pairs_, l, response_);
  x += response_;
  if (forces) *forces = l;
}

}  // namespace nsframe
