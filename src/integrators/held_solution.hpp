// Solutions with a factored matrix in which the gaps of some pairs stay as they are: J x = rhs + H' l with H x = 0 (theory.md, 291).
#pragma once

#include "integrators/iteration_matrix.hpp"

namespace nsframe {

class HeldSolution {
 public:
  explicit HeldSolution(IterationMatrix& matrix) : matrix_(matrix) {}

  // Pairs whose gaps stay as they are; ascending.
  void hold(const Contacts& contacts, const std::vector<int>& pairs);
  // `forces`: l of the held pairs.
  void solve(const VectorX& rhs, VectorX& x, VectorX* forces = nullptr);
  // Moves q along J^-1 H' so that these gaps of the held pairs vanish.
  void close_gaps(const VectorX& gap, VectorX& q);
  const std::vector<int>& pairs() const { return pairs_; }

 private:
  VectorX multipliers(const VectorX& gap) const;

  IterationMatrix& matrix_;
  const Contacts* contacts_ = nullptr;
  std::vector<int> pairs_;
  long factored_ = -1;                       // factorization that the pairs' matrix belongs to
  VectorX scale_;
  bool redundant_ = false;                   // to rounding: then by `set_`
  Eigen::LLT<MatrixX> cholesky_;             // of the scaled H J^-1 H'
  RankRevealing<double> set_;
  VectorX response_;
};

}  // namespace nsframe
