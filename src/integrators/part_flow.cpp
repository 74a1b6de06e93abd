#include "integrators/part_flow.hpp"

namespace nsframe {

namespace {

constexpr double least_pivot = 1e-5;  // of Cholesky's factor of a matrix with a unit diagonal, above which pairs are not redundant

}  // namespace

void PartFlow::hold(const Contacts& contacts, const std::vector<int>& closed) {
  contacts_ = &contacts;
  if (closed == held_ && factored_ == matrix_.factorizations()) return;
  held_ = closed;
  factored_ = matrix_.factorizations();
  const auto count = static_cast<Eigen::Index>(held_.size());
  if (count == 0) return;
  MatrixX W(count, count);
  for (Eigen::Index b = 0; b < count; ++b) {
    const VectorX& response = matrix_.response(contacts, held_[static_cast<std::size_t>(b)]);
    for (Eigen::Index a = 0; a < count; ++a) W(a, b) = contacts.jacobian.row(held_[static_cast<std::size_t>(a)]).dot(response);
  }
  scale_ = W.diagonal().cwiseSqrt().cwiseInverse();
  const MatrixX scaled = scale_.asDiagonal() * W * scale_.asDiagonal();
  cholesky_.compute(scaled);
  redundant_ = cholesky_.info() != Eigen::Success || cholesky_.matrixLLT().diagonal().minCoeff() < least_pivot;
  if (!redundant_) return;
  set_.setThreshold(1e-12);
  set_.compute(scaled);
}

VectorX PartFlow::multipliers(const VectorX& gap) const {
  const VectorX scaled = scale_.cwiseProduct(gap);
  return -scale_.cwiseProduct(redundant_ ? VectorX(set_.solve(scaled)) : VectorX(cholesky_.solve(scaled)));
}

void PartFlow::close_gaps(const VectorX& gap, VectorX& q) {
  matrix_.respond(*contacts_, held_, multipliers(gap), rhs_);
  q += rhs_;
}

void PartFlow::solve(const VectorX& rhs, VectorX& x, VectorX* forces) {
  matrix_.solve(rhs, x);
  const auto count = static_cast<Eigen::Index>(held_.size());
  if (forces) forces->setZero(count);
  if (count == 0) return;
  VectorX gap(count);
  for (Eigen::Index k = 0; k < count; ++k) gap[k] = contacts_->jacobian.row(held_[static_cast<std::size_t>(k)]).dot(x);
  const VectorX l = multipliers(gap);
  VectorX change;
  matrix_.respond(*contacts_, held_, l, change);
  x += change;
  if (forces) *forces = l;
}

void PartFlow::begin(const System& system, const VectorX& v, const VectorX& P, const PartLoad& load, const std::vector<bool>& massless) {
  const double a = theta_ * h_;
  const auto momentum = [&](const VectorX& velocity, VectorX& result) {  // (M + a C) velocity
    result.noalias() = system.mass() * velocity;
    system.damping.add_force(system.assembler.blocks(), a, velocity, result);
  };
  VectorX u1, u2, w1, w2, b, k1, l1, l3, damping = VectorX::Zero(v.size());
  system.damping.add_force(system.assembler.blocks(), 1, v, damping);
  rhs_.noalias() = system.mass() * v;
  rhs_ += a * damping;
  solve(rhs_, u1, &k1);
  momentum(u1, rhs_);
  solve(rhs_, u2);
  rhs_ = load.start - P - damping;
  solve(rhs_, w1, &l1);
  momentum(w1, rhs_);
  solve(rhs_, w2);
  v_ = v;
  for (Eigen::Index i = 0; i < v_.size(); ++i) {
    if (massless[static_cast<std::size_t>(i)]) v_[i] = u1[i];
  }
  const double h2 = h_ * h_;
  move_ = {2 * u1 - u2, theta_ * (2 * w1 - w2), (u2 - u1) / h2, (theta_ / h2) * (w2 - w1)};
  speed_ = {2 * w1 - w2, (3 * u1 - u2 - 2 * v_) / (theta_ * h2), (w2 - w1) / h2, (v_ - 2 * u1 + u2) / (theta_ * h2 * h2)};
  impulse_ = {l1, k1 / (theta_ * h2)};
  if (load.slope.size() == 0) return;
  solve(load.slope, b, &l3);
  move_[2] += (0.5 * theta_) * b;
  speed_[1] += 0.5 * b;
  impulse_[1] += 0.5 * l3;
}

VectorX PartFlow::mean_velocity(double s) const {
  return move_[0] + s * (move_[1] + s * (move_[2] + s * move_[3]));
}

void PartFlow::velocity(double s, VectorX& v) const {
  v = v_ + s * (speed_[0] + s * (speed_[1] + s * (speed_[2] + s * speed_[3])));
}

void PartFlow::gap_coefficients(const Contacts& contacts, GapCoefficients& c) const {
  c.resize(contacts.size(), 4);
  for (int i = 0; i < 4; ++i) c.col(i) = contacts.jacobian * move_[static_cast<std::size_t>(i)];
}

double PartFlow::impulse(std::size_t k, double s) const {
  const auto i = static_cast<Eigen::Index>(k);
  return s * (impulse_[0][i] + s * impulse_[1][i]);
}

double PartFlow::release(std::size_t k, double s) const {
  const auto i = static_cast<Eigen::Index>(k);
  const double start = impulse_[0][i], end = start + 2 * s * impulse_[1][i];
  if (end >= -1e-12 * std::max(impulse_[0].maxCoeff(), std::abs(start))) return s;
  return start > 0 ? s * start / (start - end) : 0;
}

}  // namespace nsframe
