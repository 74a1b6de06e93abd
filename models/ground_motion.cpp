#include "models/ground_motion.hpp"

#include <algorithm>
#include <cmath>

namespace nsframe {

void GroundMotion::prepare() {
  velocity.assign(acceleration.size(), 0.0);
  displacement.assign(acceleration.size(), 0.0);
  for (std::size_t i = 1; i < acceleration.size(); ++i) {
    velocity[i] = velocity[i - 1] + 0.5 * dt * (acceleration[i - 1] + acceleration[i]);
    displacement[i] = displacement[i - 1] + dt * (velocity[i - 1] + dt * (2 * acceleration[i - 1] + acceleration[i]) / 6);
  }
}

double GroundMotion::duration() const {
  return acceleration.empty() ? 0 : start + dt * static_cast<double>(acceleration.size() - 1);
}

double GroundMotion::acceleration_at(double time) const {
  if (acceleration.empty() || time < start || time > duration()) return 0;
  const double at = (time - start) / dt;
  const std::size_t i = std::min(static_cast<std::size_t>(at), acceleration.size() - 1);
  const std::size_t next = std::min(i + 1, acceleration.size() - 1);
  return acceleration[i] + (at - static_cast<double>(i)) * (acceleration[next] - acceleration[i]);
}

GroundMotion::Piece GroundMotion::piece_at(double time) const {
  const double at = (time - start) / dt;
  const std::size_t i = std::min(static_cast<std::size_t>(at), acceleration.size() - 2);
  return {i, (at - static_cast<double>(i)) * dt, (acceleration[i + 1] - acceleration[i]) / dt};
}

double GroundMotion::velocity_at(double time) const {
  if (acceleration.empty() || time <= start) return 0;
  if (time >= duration()) return velocity.back();
  const auto [i, s, slope] = piece_at(time);
  return velocity[i] + s * (acceleration[i] + 0.5 * s * slope);
}

double GroundMotion::displacement_at(double time) const {
  if (acceleration.empty() || time <= start) return 0;
  if (time >= duration()) return displacement.back() + (time - duration()) * velocity.back();
  const auto [i, s, slope] = piece_at(time);
  return displacement[i] + s * (velocity[i] + s * (0.5 * acceleration[i] + s * slope / 6));
}

}  // namespace nsframe
