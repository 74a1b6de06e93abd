// Block-diagonal form V^-1 A V = B of a real matrix (theory.md, 338-340): a block for every real eigenvalue and for every pair of complex
// ones, and dense blocks for eigenvalues whose eigenvectors are (nearly) parallel, so that V stays well conditioned where A is (nearly)
// defective (Bavely and Stewart 1979).
#pragma once

#include <vector>

#include "base/types.hpp"

namespace nsframe {

using LongMatrix = Eigen::Matrix<long double, Eigen::Dynamic, Eigen::Dynamic>;

struct DiagonalBlock {
  int first = 0, size = 1;        // its columns of the basis
  long double real = 0, imag = 0;  // without `matrix`: eigenvalue (size 1), or B = [real, imag; -imag, real] (size 2) [1/s]
  MatrixX matrix;                 // B of a dense block
  double magnitude = 0;           // |B| [1/s]
  double growth = 1;              // bound on |exp(B t)|, t >= 0, when no eigenvalue lies right of the imaginary axis

  bool dense() const { return matrix.size() > 0; }
  MatrixX full() const;           // B
};

struct BlockDiagonal {
  MatrixX basis, inverse;         // V and V^-1
  std::vector<DiagonalBlock> blocks;
  double condition = 1;           // largest |V_b| |V^-1_b| of a block: what it makes of rounding
  double residual = 0;            // |V^-1 A V - B| / |A|, largest entries
};

inline constexpr double worst_condition = 1e5;
inline constexpr int largest_dense_block = 16;

// Of a matrix whose eigenvalues do not lie right of the imaginary axis but for rounding. In long double up to 400 rows. Throws
// std::runtime_error with a phrase when an eigenvalue does, when eigenvectors stay too nearly parallel (`worst_condition`) although up to
// `largest_dense_block` of them have one block, or when the residual shows that the form was not found.
BlockDiagonal block_diagonal_form(const LongMatrix& A);

}  // namespace nsframe
