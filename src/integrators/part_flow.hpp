// The motion over any part of a step with the factored matrix of the whole step (theory.md, 291-295): for M q'' + C q' + P = f0 + f1 s + H' l,
//   q(s) = q + s [b1 + theta s b2 + theta s^2 b3 / 2],   v(s) = v - s^2 / (theta h^2) (v - b1) + s b2 + s^2 b3 / 2,
//   J b1 = (M + a C) v + H' l1,   J b2 = f0 - P - C v + H' l2,   J b3 = f1 + H' l3,   J = M + a C + a^2 K,  a = theta h.
// At s = h this is the theta-method; at any s it neither grows nor needs another factorization, and is of second order for theta = 1/2.
#pragma once

#include "integrators/iteration_matrix.hpp"

namespace nsframe {

// Loads over a part, linear in time [N], [N/s].
struct PartLoad {
  VectorX start, slope;
};

class PartFlow {
 public:
  PartFlow(double theta, IterationMatrix& matrix) : theta_(theta), matrix_(matrix) {}

  // Whole step h [s]; `stiffness`: the one that is in the factors, which are ready for theta h.
  void set_step(double h) { h_ = h; }
  // Pairs whose gaps stay as they are; ascending.
  void hold(const Contacts& contacts, const std::vector<int>& closed);
  // From displacement q, velocity v and internal force P.
  void begin(const System& system, const VectorX& q, const VectorX& v, const VectorX& P, const PartLoad& load, const std::vector<bool>& massless);

  void displacement(double s, VectorX& q) const;
  void velocity(double s, VectorX& v) const;
  VectorX mean_velocity(double s) const;
  // Of all pairs: g(s) - g = s (c1 + s c2 + s^2 c3).
  void gap_coefficients(const Contacts& contacts, VectorX& c1, VectorX& c2, VectorX& c3) const;
  // Force and impulse of held pair number k at s.
  double force(std::size_t k, double s) const;
  double impulse(std::size_t k, double s) const;
  // x = J^-1 (rhs + H' forces) with the held gaps unchanged.
  void solve(const VectorX& rhs, VectorX& x, VectorX* forces = nullptr);
  // Moves q along J^-1 H' so that these gaps of the held pairs vanish.
  void close_gaps(const VectorX& gap, VectorX& q);
  const std::vector<int>& held() const { return held_; }

 private:
  VectorX multipliers(const VectorX& gap) const;
  void add_responses(const VectorX& forces, VectorX& x);

  double theta_, h_ = 0;
  IterationMatrix& matrix_;
  const Contacts* contacts_ = nullptr;
  std::vector<int> held_;
  long factored_ = -1;                       // factorization that the held pairs' matrix belongs to
  VectorX scale_;
  Eigen::CompleteOrthogonalDecomposition<MatrixX> set_;  // of the scaled H J^-1 H' of the held pairs
  VectorX q_, v_, b1_, b2_, b3_, l1_, l2_, l3_, rhs_;
};

}  // namespace nsframe
