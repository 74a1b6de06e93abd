// The motion over any part of a length h with the factored matrix of that length (theory.md, 290-294). The theta-method over a part s = f h
// needs J(s) = M + f a C + f^2 a^2 K, a = theta h; here J(s)^-1 is the beginning of its series in what J(h) lacks of it,
//   J(s)^-1 ~ [1 + (1 - f^2) Y] J^-1,   Y = 1 - J^-1 (M + a C),   J = J(h),
// so that motion, gaps and contact forces are polynomials in s. At s = h this is the theta-method; at any s it does not grow.
#pragma once

#include <array>

#include "integrators/held_solution.hpp"

namespace nsframe {

// What a part leaves of motion that its length does not resolve (theory.md, 350): 1 - kappa f^2 in the place of 1 - f^2.
struct PartRule {
  double theta = 0.5;         // [1/2, 1]
  double rho_infinity = 1;    // [0, 1], beside what theta damps
  double kappa() const { return 0.5 * (3 - rho_infinity); }
};

// Loads over a part, linear in time [N], [N/s].
struct PartLoad {
  VectorX start, slope;
};

using GapCoefficients = Eigen::Matrix<double, Eigen::Dynamic, 4>;

class PartFlow {
 public:
  PartFlow(const PartRule& rule, IterationMatrix& matrix) : rule_(rule), held_(matrix) {}

  // Longest part h [s]; the factors are ready for theta h.
  void set_longest(double h) { h_ = h; }
  double longest() const { return h_; }
  const PartRule& rule() const { return rule_; }
  HeldSolution& held() { return held_; }
  // From velocity v and internal force P, with the gaps of the held pairs as they are.
  void begin(const System& system, const VectorX& v, const VectorX& P, const PartLoad& load, const std::vector<bool>& massless);
  // Adds to the motion of begin() a force that grows in proportion to time, such that q(s) moves by `shift` in addition, with `forces` [N]
  // of the held pairs at s. It takes the place of an earlier one.
  void bend(double s, const VectorX& shift, const VectorX& forces);
  // By how much bend() has moved q(s).
  VectorX shift(double s) const { return bend_.size() > 0 ? VectorX(s * s * s * bend_) : VectorX(VectorX::Zero(v_.size())); }

  void velocity(double s, VectorX& v) const;
  VectorX mean_velocity(double s) const;
  // Of all pairs: g(s) - g = s (c_0 + s c_1 + s^2 c_2 + s^3 c_3), a column a coefficient.
  void gap_coefficients(const Contacts& contacts, GapCoefficients& c) const;
  // Impulse of held pair number k up to s.
  double impulse(std::size_t k, double s) const;
  // First time up to s at which that force turns negative; s when it does not.
  double release(std::size_t k, double s) const;
  // Part of s^2 J^-1 and of -s^2 J^-1 (M + a C) J^-1 in the motion q(s) under a constant force.
  std::array<double, 2> response(double s) const;

 private:
  const PartRule rule_;
  double h_ = 0;
  HeldSolution held_;
  VectorX v_, rhs_;
  std::array<VectorX, 4> move_, speed_;      // coefficients of [q(s) - q] / s and of v(s) - v: s^0.., s^1..
  std::array<VectorX, 2> impulse_;           // s^1, s^2 of the held pairs' impulses: their forces are linear
  VectorX bend_, bend_impulse_;              // what bend() has added to move_[2], impulse_[1]
};

}  // namespace nsframe
