// The motion over any part of a length h with the factored matrix of that length (theory.md, 290-294). The theta-method over a part s = f h
// needs J(s) = M + f a C + f^2 a^2 K, a = theta h; here J(s)^-1 is the beginning of its series in what J(h) lacks of it,
//   J(s)^-1 ~ [1 + (1 - f^2) Y] J^-1,   Y = 1 - J^-1 (M + a C),   J = J(h),
// so that motion, gaps and contact forces are polynomials in s. At s = h this is the theta-method; at any s it does not grow.
#pragma once

#include <array>

#include "integrators/iteration_matrix.hpp"

namespace nsframe {

// Loads over a part, linear in time [N], [N/s].
struct PartLoad {
  VectorX start, slope;
};

using GapCoefficients = Eigen::Matrix<double, Eigen::Dynamic, 4>;

class PartFlow {
 public:
  PartFlow(double theta, IterationMatrix& matrix) : theta_(theta), matrix_(matrix) {}

  // Longest part h [s]; the factors are ready for theta h.
  void set_longest(double h) { h_ = h; }
  // Pairs whose gaps stay as they are; ascending.
  void hold(const Contacts& contacts, const std::vector<int>& closed);
  // From velocity v and internal force P.
  void begin(const System& system, const VectorX& v, const VectorX& P, const PartLoad& load, const std::vector<bool>& massless);

  void velocity(double s, VectorX& v) const;
  VectorX mean_velocity(double s) const;
  // Of all pairs: g(s) - g = s (c_0 + s c_1 + s^2 c_2 + s^3 c_3), a column a coefficient.
  void gap_coefficients(const Contacts& contacts, GapCoefficients& c) const;
  // Impulse of held pair number k up to s.
  double impulse(std::size_t k, double s) const;
  // First time up to s at which that force turns negative; s when it does not.
  double release(std::size_t k, double s) const;
  // x = J^-1 (rhs + H' forces) with the held gaps unchanged.
  void solve(const VectorX& rhs, VectorX& x, VectorX* forces = nullptr);
  // Moves q along J^-1 H' so that these gaps of the held pairs vanish.
  void close_gaps(const VectorX& gap, VectorX& q);
  const std::vector<int>& held() const { return held_; }

 private:
  VectorX multipliers(const VectorX& gap) const;

  double theta_, h_ = 0;
  IterationMatrix& matrix_;
  const Contacts* contacts_ = nullptr;
  std::vector<int> held_;
  long factored_ = -1;                       // factorization that the held pairs' matrix belongs to
  VectorX scale_;
  bool redundant_ = false;                   // of the held pairs, to rounding: then by `set_`
  Eigen::LLT<MatrixX> cholesky_;             // of the scaled H J^-1 H' of the held pairs
  Eigen::CompleteOrthogonalDecomposition<MatrixX> set_;
  VectorX v_, rhs_;
  std::array<VectorX, 4> move_, speed_;      // coefficients of [q(s) - q] / s and of v(s) - v: s^0.., s^1..
  std::array<VectorX, 2> impulse_;           // s^1, s^2 of the held pairs' impulses: their forces are linear
};

}  // namespace nsframe
