// Sparse matrices in chunks of four rows that share their columns, and solutions with sparse factors in that form, by SIMD. The DOFs of a
// node meet the same neighbours, so that few zeros are stored, and one index serves four entries.
#pragma once

#include <vector>

#include "base/types.hpp"

namespace nsframe {

inline constexpr int chunk_rows = 4;

// Chunks of a matrix, one after the other; columns and values of chunk i stand from begin[i] on, four values a column.
struct Chunks {
  std::vector<int> begin{0}, columns;
  AlignedVector values;

  int count() const { return static_cast<int>(begin.size()) - 1; }
  int padded_rows() const { return chunk_rows * count(); }
  void add_column(int column, const Eigen::Vector4d& entries);
  void close() { begin.push_back(static_cast<int>(columns.size())); }
};

class ChunkedRows {
 public:
  ChunkedRows() = default;
  explicit ChunkedRows(const SparseMatrix& matrix);
  // y = A x. y: rows, padded to whole chunks; may not overlap x.
  void multiply(const double* x, double* y) const;
  int padded_rows() const { return chunks_.padded_rows(); }

 private:
  Chunks chunks_;
};

// Factors L D L' = P A P' of a sparse matrix, for many solutions.
class ChunkedFactor {
 public:
  explicit ChunkedFactor(const Eigen::SimplicialLDLT<SparseMatrix>& factor);
  // x = A^-1 rhs; may be the same.
  void solve(const double* rhs, double* x) const;

 private:
  // Every chunk gives its rows from those solved before and its own right-hand sides: the triangle within it is inverted.
  Chunks forward_, backward_;
  std::vector<int> place_;  // of unknown i among the permuted ones
  mutable AlignedVector work_;
};

}  // namespace nsframe
