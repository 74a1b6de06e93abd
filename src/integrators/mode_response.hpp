// How a scheme moves one free mode, from its amplification matrix.
#pragma once

#include "base/types.hpp"
#include "integrators/scheme.hpp"

namespace nsframe {

// Of the eigenvalue exp(-(xi + i sqrt(1 - xi^2)) w h) that belongs to the mode: among more than two, the one that turns fastest.
Scheme::ModeResponse response_of(const Eigen::Matrix2d& amplification, double h);
Scheme::ModeResponse response_of(const Eigen::Matrix3d& amplification, double h);
// Largest of an amplification matrix: above 1 motion grows.
double spectral_radius(const Eigen::Matrix3d& amplification);
// Of the theta-method on a mode of circular frequency w [rad/s] and damping ratio xi.
Scheme::ModeResponse theta_method_response(double theta, double w, double xi, double h);

}  // namespace nsframe
