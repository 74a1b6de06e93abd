// A matrix of blocks side by side, one block a connected structure, each with rows and columns of its own: small blocks dense, large ones in
// chunks of rows, all by SIMD.
#pragma once

#include <vector>

#include "base/chunked_rows.hpp"
#include "base/padded_matrix.hpp"

namespace nsframe {

// Rows and columns [first, last) of one connected structure.
struct BlockRange {
  int first = 0, last = 0;
  int size() const { return last - first; }
};

inline constexpr int dense_block_limit = 96;  // rows up to which a stiffness matrix is best kept dense

class BlockOperator {
 public:
  BlockOperator() = default;
  // `matrix` must have no entries outside the blocks. Blocks up to `dense_limit` rows are kept dense.
  BlockOperator(const SparseMatrix& matrix, const std::vector<BlockRange>& blocks, int dense_limit);
  // From dense blocks; `columns`: where their columns stand, if not where their rows do. Rows that a matrix lacks of its range are zero.
  BlockOperator(const std::vector<MatrixX>& matrices, const std::vector<BlockRange>& blocks) : BlockOperator(matrices, blocks, blocks) {}
  BlockOperator(const std::vector<MatrixX>& matrices, const std::vector<BlockRange>& rows, const std::vector<BlockRange>& columns);

  // y = A x; entries of y beyond the blocks' rows stay as they are; x and y may not be the same.
  void multiply(const VectorX& x, VectorX& y) const;
  // y = start + A x and y2 = A x2, for less than twice the time of one.
  void multiply(const VectorX& start, const VectorX& x, const VectorX& x2, VectorX& y, VectorX& y2) const;
  int rows() const { return rows_; }
  StoredEntries entries() const;
  // Of multiply(): a thread a block.
  void set_threads(int threads) { threads_ = threads; }

 private:
  struct Block {
    BlockRange rows, columns;
    PaddedMatrix dense;  // empty when sparse
    ChunkedRows sparse;
    mutable AlignedVector padded, padded2;  // results of sparse blocks, with whole chunks
  };
  void add(Block block);
  int rows_ = 0, threads_ = 1;
  std::vector<Block> blocks_;
};

// The part of a block-diagonal matrix that belongs to one block.
SparseMatrix extract_block(const SparseMatrix& matrix, const BlockRange& range);

}  // namespace nsframe
