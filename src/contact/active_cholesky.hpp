// Cholesky factor of W on a set of pairs that grows and shrinks by one: each change costs the square of its size.
#pragma once

#include <vector>

#include "base/types.hpp"

namespace nsframe {

class ActiveCholesky {
 public:
  ActiveCholesky(const MatrixX& W) : W_(W), L_(W.rows(), W.rows()) {}

  const std::vector<Eigen::Index>& pairs() const { return pairs_; }
  Eigen::Index size() const { return static_cast<Eigen::Index>(pairs_.size()); }

  // d = W_AA^-1 W_Ac; returns what is left of W_cc, W_cc - W_cA d.
  double coefficients(Eigen::Index c, VectorX& d);
  // Adds the pair of the last coefficients().
  void add(Eigen::Index c, double left);
  void remove(Eigen::Index place);
  // x = W_AA^-1 x
  void solve(VectorX& x) const;

 private:
  const MatrixX& W_;
  MatrixX L_;                       // lower, its leading block in use
  std::vector<Eigen::Index> pairs_;
  VectorX row_;                     // L^-1 W_Ac
};

}  // namespace nsframe
