// Linear oscillators of many periods and one damping ratio on a moving base, exact for a base acceleration that is
// linear over a step (Nigam, Jennings 1969; theory.md, 120-123):
//   u'' + 2 xi w u' + w^2 u = -a(t),   u relative to the base, a the absolute acceleration of the base.
// A base that jumps by dv in velocity (an impact) leaves the mass its absolute velocity: u' jumps by -dv.
// Arrays are by period.
#pragma once

#include <vector>

namespace nsframe {

// `count` periods from `shortest` to `longest`, evenly spaced in logarithm [s].
std::vector<double> logarithmic_periods(double shortest, double longest, int count);

// What takes the oscillators over a step of one length: u+ = uu u + uv v + ua a0 + ub a1, and v+ likewise.
class OscillatorStep {
 public:
  // Periods must be positive, the damping ratio in [0, 1), the step positive.
  OscillatorStep(const std::vector<double>& periods, double damping_ratio, double step);

  // A step consists of pieces() pieces of the same length piece() [s]: short enough for the shortest period that a cubic
  // finds the peaks between. These take oscillator i over one.
  struct Coefficients {
    double uu, uv, ua, ub, vu, vv, va, vb;
  };
  Coefficients coefficients(std::size_t i) const { return {uu_[i], uv_[i], ua_[i], ub_[i], vu_[i], vv_[i], va_[i], vb_[i]}; }
  int pieces() const { return pieces_; }
  double piece() const { return h_; }

 private:
  friend class Oscillators;
  double h_ = 0;
  int pieces_ = 1;
  std::vector<double> uu_, uv_, ua_, ub_, vu_, vv_, va_, vb_;
};

// Displacements, velocities and the largest displacements so far.
class Oscillators {
 public:
  explicit Oscillators(std::size_t periods) : u_(periods), v_(periods), peak_(periods), before_u_(periods), before_v_(periods) {}

  // Over a step with base accelerations a0 at its start and a1 at its end [m/s2].
  void advance(const OscillatorStep& step, double a0, double a1);
  // The base changes its velocity by dv at once [m/s].
  void jump(double dv) {
    for (double& v : v_) v -= dv;
  }

  const std::vector<double>& displacement() const { return u_; }  // [m] relative to the base
  const std::vector<double>& velocity() const { return v_; }      // [m/s]
  // Largest |u| so far, also between the ends of steps (there within 2e-4 of it) [m].
  const std::vector<double>& peak() const { return peak_; }

  // Goes on from such arrays.
  void restore(std::vector<double> displacement, std::vector<double> velocity, std::vector<double> peak);

 private:
  void advance_piece(const OscillatorStep& step, double a0, double a1);
  std::vector<double> u_, v_, peak_, before_u_, before_v_;
};

// Largest |p| of the cubic p on [0, 1] with p = u0, p' = d0 at 0 and p = u1, p' = d1 at 1, where d0 and d1 differ in sign.
double turning_point(double u0, double d0, double u1, double d1);

// Pseudo-velocity w |u| [m/s] and pseudo-acceleration w^2 |u| [m/s2] of peaks.
std::vector<double> pseudo_velocity(const std::vector<double>& periods, const std::vector<double>& peak);
std::vector<double> pseudo_acceleration(const std::vector<double>& periods, const std::vector<double>& peak);

}  // namespace nsframe
