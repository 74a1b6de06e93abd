// How long the parts of a step of the scheme `exponential` are: by the error of the expected residual, and by what modes hide from the elements
// (theory.md, 234-237).
#include <algorithm>
#include <cmath>

#include "integrators/exponential.hpp"

namespace nsframe {

namespace {

constexpr double guard = 0.02;        // part of the peak, without `accuracy`
constexpr double aim = 0.9;           // at which part of the allowed error, of parts over several steps
constexpr double least_share = 1e-12;  // of nonlinear elements in a mode: rounding

}  // namespace

void Exponential::find_modes(const System& system) {
  const ExactModes& modes = flow_.modes();
  mode_size_ = mode_share_ = VectorX::Zero(modes.padded);
  inverse_frequency_ = modes.square.cwiseMax(1.0).cwiseSqrt().cwiseInverse();
  VectorX unit = mode_size_, linear(modes.dofs), shape(modes.dofs);
  for (int k = 0; k < modes.padded; ++k) {
    unit[k] = 1;
    modes.shape.multiply(unit, shape);
    unit[k] = 0;
    mode_size_[k] = shape.cwiseAbs().maxCoeff();
    if (mode_size_[k] == 0 || modes.square[k] == 0) continue;
    system.assembler.linear_force(shape, linear);
    mode_share_[k] = std::clamp(1 - shape.dot(linear) / modes.square[k], 0.0, 1.0);
    if (mode_share_[k] > least_share) fastest_ = std::max(fastest_, std::sqrt(modes.square[k]));
  }
}

double Exponential::error_ratio(const VectorX& unexpected, double s) {
  const double size = std::max(peak_, scale_);
  if (size == 0) return 0;
  const auto force = mode_size_.array() * unexpected.array().abs();
  const auto lag = inverse_frequency_.array();
  const double moved = (force * (lag.square() * (2 / s)).min(0.5 * s) * lag).sum();  // by the wrong impulse of this part [m]
  const ModalState& start = flow_.modal();
  const auto swing = (start.x - flexibility_.cwiseProduct(start.f0)).array().abs() + start.y.array().abs() * lag;
  const auto size_seen = (mode_size_.cwiseProduct(mode_share_)).array();
  const auto square = flow_.modes().square.array();
  if (options_.accuracy == 0) {
    const double unseen = fastest_ * s > farthest_turn ? (square * (s * s) > farthest_turn * farthest_turn).select(size_seen * swing, 0.0).sum() : 0.0;
    return std::max(moved, unseen) / (guard * size);
  }
  const double held = (force * lag.square()).sum();                                    // by a wrong force that stays [m]
  const double hidden = (size_seen * (s * s / 8 * square).min(1.0) * swing).sum();
  return std::max(moved / s, held + hidden) / (options_.accuracy * size);
}

int Exponential::steps_after(int steps, double error) const {
  if (options_.accuracy == 0) return 1;
  const double factor = std::min(2.0, std::sqrt(aim / std::max(error, 1e-3)));  // errors are of second order
  return std::clamp(static_cast<int>(factor * steps), 1, error > 1 ? steps - 1 : exponential_steps);
}

}  // namespace nsframe
