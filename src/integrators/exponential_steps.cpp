// How long the parts of a step of the scheme `exponential` are: by stability, and by the error of the expected residual (theory.md, 234-236).
#include <algorithm>
#include <cmath>

#include "base/decompositions.hpp"
#include "integrators/exponential.hpp"

namespace nsframe {

namespace {

constexpr double fastest_growth = 1;  // [1/s], of any mode while all nonlinear elements yield
constexpr double guard = 0.02;       // part of the peak, without `accuracy`

}  // namespace

double exponential_radius(double angle, double share, double kept) {
  const double square = angle * angle;
  const StepCoefficients c = step_coefficients(square, 0, 1);
  const auto A = static_cast<double>(c.A), B = static_cast<double>(c.B), L = static_cast<double>(c.L), R = static_cast<double>(c.R);
  const double change = (kept - 1) * share * square;  // r = change * x
  Eigen::Matrix4d step;                                // of x, x', r, rate of r, in steps
  for (int i = 0; i < 4; ++i) {
    const Eigen::Vector4d from = Eigen::Vector4d::Unit(i);
    const double x = A * from[0] + B * from[1] - L * from[2], y = -square * B * from[0] + A * from[1] - B * from[2];
    const double r = change * (x - R * from[3]), rate = r - from[2];
    step.col(i) << x - R * rate, y - L * rate, r, rate;
  }
  return Eigen::EigenSolver<MatrixX>(MatrixX(step), false).eigenvalues().cwiseAbs().maxCoeff();
}

void Exponential::find_steps(const System& system) {
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
    const auto grows = [&](double s) {
      for (const double kept : {0.01, 0.25, 0.5, 0.75}) {
        if (std::log(exponential_radius(std::sqrt(modes.square[k]) * s, mode_share_[k], kept)) > fastest_growth * s) return true;
      }
      return false;
    };
    while (least_level_ < exponential_levels && grows(std::ldexp(options_.dt, -least_level_))) {
      ++least_level_;
      unstable_ = std::sqrt(modes.square[k]);
    }
  }
  level_ = least_level_;
}

double Exponential::error_ratio(const VectorX& unexpected, double s) {
  const double size = std::max(peak_, scale_);
  if (size == 0) return 0;
  const auto force = mode_size_.array() * unexpected.array().abs();
  const auto lag = inverse_frequency_.array();
  const double moved = (force * (lag.square() * (2 / s)).min(0.5 * s) * lag).sum();  // by the wrong impulse of this part [m]
  if (options_.accuracy == 0) return moved / (guard * size);
  const double held = (force * lag.square()).sum();                                    // by a wrong force that stays [m]
  const ModalState& start = flow_.modal();
  const auto swing = (start.x - flexibility_.cwiseProduct(start.f0)).array().abs() + start.y.array().abs() * lag;
  const double hidden = ((mode_size_.cwiseProduct(mode_share_)).array() * (s * s / 8 * lag.square().inverse()).min(1.0) * swing).sum();
  return std::max(moved / s, held + hidden) / (options_.accuracy * size);
}

}  // namespace nsframe
