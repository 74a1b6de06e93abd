// Sparse matrices in chunks of four rows that share their columns, and solutions with sparse factors in that form, by SIMD. The DOFs of a
// node meet the same neighbours, so that few zeros are stored, and one index serves four entries. Chunks that are equal to rounding, as
// those of equal floors, are stored once (theory.md, 395-397): large models are slow because their matrices are read from memory.
#pragma once

#include <vector>

#include "base/elimination_order.hpp"

namespace nsframe {

inline constexpr int chunk_rows = 4;

// Entries that a product or a solution meets, and those of them that are stored: the others equal them.
struct StoredEntries {
  long met = 0, stored = 0;
  StoredEntries& operator+=(const StoredEntries& more) {
    met += more.met;
    stored += more.stored;
    return *this;
  }
  double stored_share() const { return met > 0 ? static_cast<double>(stored) / static_cast<double>(met) : 1; }
};

// Chunks of a matrix. Columns and values of chunk i stand from begin[i] to end[i], four values a column; columns count from its first row.
struct Chunks {
  std::vector<int> begin, end, columns;
  AlignedVector values;

  int count() const { return static_cast<int>(begin.size()); }
  int padded_rows() const { return chunk_rows * count(); }
  StoredEntries entries() const;  // zeros between them included
  void open() { begin.push_back(static_cast<int>(columns.size())); }
  void add_column(int column, const Eigen::Vector4d& entries);
  void close() { end.push_back(static_cast<int>(columns.size())); }
};

class ChunkedRows {
 public:
  ChunkedRows() = default;
  explicit ChunkedRows(const SparseMatrix& matrix);
  // y = A x. y: rows, padded to whole chunks; may not overlap x.
  void multiply(const double* x, double* y) const;
  int padded_rows() const { return chunks_.padded_rows(); }
  StoredEntries entries() const { return chunks_.entries(); }

 private:
  Chunks chunks_;
};

// Factors L D L' = P A P' of a sparse matrix, for many solutions.
class ChunkedFactor {
 public:
  explicit ChunkedFactor(const SparseCholesky& factor);
  // x = A^-1 rhs; may be the same.
  void solve(const double* rhs, double* x) const;
  StoredEntries entries() const;  // of both triangles

 private:
  // Every chunk gives its rows from those solved before and its own right-hand sides: the triangle within it is inverted.
  Chunks forward_, backward_;
  std::vector<int> place_;  // of unknown i among the permuted ones
  mutable AlignedVector work_;
};

}  // namespace nsframe
