#include "integrators/part_flow.hpp"

namespace nsframe {

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
  set_.setThreshold(1e-12);
  set_.compute(scale_.asDiagonal() * W * scale_.asDiagonal());
}

VectorX PartFlow::multipliers(const VectorX& gap) const { return -scale_.cwiseProduct(VectorX(set_.solve(VectorX(scale_.cwiseProduct(gap))))); }

void PartFlow::add_responses(const VectorX& forces, VectorX& x) {
  for (std::size_t k = 0; k < held_.size(); ++k) x += forces[static_cast<Eigen::Index>(k)] * matrix_.response(*contacts_, held_[k]);
}

void PartFlow::close_gaps(const VectorX& gap, VectorX& q) { add_responses(multipliers(gap), q); }

void PartFlow::solve(const VectorX& rhs, VectorX& x, VectorX* forces) {
  matrix_.solve(rhs, x);
  const auto count = static_cast<Eigen::Index>(held_.size());
  if (forces) forces->setZero(count);
  if (count == 0) return;
  VectorX gap(count);
  for (Eigen::Index k = 0; k < count; ++k) gap[k] = contacts_->jacobian.row(held_[static_cast<std::size_t>(k)]).dot(x);
  const VectorX l = multipliers(gap);
  add_responses(l, x);
  if (forces) *forces = l;
}

void PartFlow::begin(const System& system, const VectorX& q, const VectorX& v, const VectorX& P, const PartLoad& load,
                     const std::vector<bool>& massless) {
  q_ = q;
  v_ = v;
  VectorX damping = VectorX::Zero(v.size());
  system.damping.add_force(system.assembler.blocks(), 1, v, damping);
  rhs_ = theta_ * h_ * damping;
  rhs_.noalias() += system.mass() * v;
  solve(rhs_, b1_, &l1_);
  rhs_ = load.start - P - damping;
  solve(rhs_, b2_, &l2_);
  if (load.slope.size() > 0) {
    solve(load.slope, b3_, &l3_);
  } else {
    b3_.setZero(v.size());
    l3_.setZero(static_cast<Eigen::Index>(held_.size()));
  }
  for (Eigen::Index i = 0; i < v_.size(); ++i) {
    if (massless[static_cast<std::size_t>(i)]) v_[i] = b1_[i];
  }
}

VectorX PartFlow::mean_velocity(double s) const { return b1_ + (theta_ * s) * b2_ + (0.5 * theta_ * s * s) * b3_; }

void PartFlow::displacement(double s, VectorX& q) const { q = q_ + s * mean_velocity(s); }

void PartFlow::velocity(double s, VectorX& v) const {
  v = v_ - (s * s / (theta_ * h_ * h_)) * (v_ - b1_) + s * b2_ + (0.5 * s * s) * b3_;
}

void PartFlow::gap_coefficients(const Contacts& contacts, VectorX& c1, VectorX& c2, VectorX& c3) const {
  c1 = contacts.jacobian * b1_;
  c2 = theta_ * (contacts.jacobian * b2_);
  c3 = (0.5 * theta_) * (contacts.jacobian * b3_);
}

double PartFlow::force(std::size_t k, double s) const {
  const auto i = static_cast<Eigen::Index>(k);
  return l2_[i] + s * (2 / (theta_ * h_ * h_) * l1_[i] + l3_[i]);
}

double PartFlow::impulse(std::size_t k, double s) const {
  const auto i = static_cast<Eigen::Index>(k);
  return s * (l2_[i] + s * (l1_[i] / (theta_ * h_ * h_) + 0.5 * l3_[i]));
}

}  // namespace nsframe
