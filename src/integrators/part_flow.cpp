#include "integrators/part_flow.hpp"

namespace nsframe {

void PartFlow::begin(const System& system, const VectorX& v, const VectorX& P, const PartLoad& load, const std::vector<bool>& massless) {
  const double theta = rule_.theta, kappa = rule_.kappa(), a = theta * h_;
  const auto momentum = [&](const VectorX& velocity, VectorX& result) {  // (M + a C) velocity
    result.noalias() = system.mass() * velocity;
    system.damping.add_force(system.assembler.blocks(), a, velocity, result);
  };
  VectorX u1, u2, w1, w2, b, k1, l1, l3, damping = VectorX::Zero(v.size());
  system.damping.add_force(system.assembler.blocks(), 1, v, damping);
  rhs_.noalias() = system.mass() * v;
  rhs_ += a * damping;
  held_.solve(rhs_, u1, &k1);
  momentum(u1, rhs_);
  held_.solve(rhs_, u2);
  rhs_ = load.start - P - damping;
  held_.solve(rhs_, w1, &l1);
  momentum(w1, rhs_);
  held_.solve(rhs_, w2);
  v_ = v;
  for (Eigen::Index i = 0; i < v_.size(); ++i) {
    if (massless[static_cast<std::size_t>(i)]) v_[i] = u1[i];
  }
  const double h2 = h_ * h_;
  move_ = {2 * u1 - u2, theta * (2 * w1 - w2), (kappa / h2) * (u2 - u1), (theta * kappa / h2) * (w2 - w1)};
  speed_ = {2 * w1 - w2, (3 * u1 - u2 - 2 * v_) / (theta * h2), (kappa / h2) * (w2 - w1), (kappa / (theta * h2 * h2)) * (v_ - 2 * u1 + u2)};
  impulse_ = {l1, k1 / (theta * h2)};
  bend_.resize(0);
  if (load.slope.size() == 0) return;
  held_.solve(load.slope, b, &l3);
  move_[2] += (0.5 * theta) * b;
  speed_[1] += 0.5 * b;
  impulse_[1] += 0.5 * l3;
}

void PartFlow::bend(double s, const VectorX& shift, const VectorX& forces) {
  VectorX move = shift / (s * s * s), impulse = (rule_.theta / s) * forces;
  if (bend_.size() > 0) {
    move -= bend_;
    impulse -= bend_impulse_;
  } else {
    bend_ = VectorX::Zero(move.size());
    bend_impulse_ = VectorX::Zero(impulse.size());
  }
  move_[2] += move;
  speed_[1] += move / rule_.theta;
  impulse_[1] += impulse;
  bend_ += move;
  bend_impulse_ += impulse;
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

std::array<double, 2> PartFlow::response(double s) const {
  const double f = s / h_, g = 1 - rule_.kappa() * f * f;
  return {rule_.theta * (1 + g), rule_.theta * g};
}

}  // namespace nsframe
