#include "base/block_operator.hpp"

#include <algorithm>

#include "base/parallel.hpp"

namespace nsframe {

SparseMatrix extract_block(const SparseMatrix& matrix, const BlockRange& range) {
  return matrix.block(range.first, range.first, range.size(), range.size());
}

BlockOperator::BlockOperator(const SparseMatrix& matrix, const std::vector<BlockRange>& blocks, int dense_limit) {
  for (const BlockRange& range : blocks) {
    const SparseMatrix part = extract_block(matrix, range);
    const bool crowded = 16 * part.nonZeros() > static_cast<Eigen::Index>(range.size()) * range.size();
    if (range.size() <= dense_limit && crowded) {
      add({range, range, PaddedMatrix(MatrixX(part)), {}, {}, {}});
    } else {
      add({range, range, {}, ChunkedRows(part), {}, {}});
    }
  }
}

BlockOperator::BlockOperator(const std::vector<MatrixX>& matrices, const std::vector<BlockRange>& rows, const std::vector<BlockRange>& columns) {
  for (std::size_t i = 0; i < rows.size(); ++i) {
    MatrixX whole = MatrixX::Zero(rows[i].size(), matrices[i].cols());
    whole.topRows(matrices[i].rows()) = matrices[i];
    add({rows[i], columns[i], PaddedMatrix(whole), {}, {}, {}});
  }
}

void BlockOperator::add(Block block) {
  if (block.dense.empty()) {
    block.padded.resize(static_cast<std::size_t>(block.sparse.padded_rows()));
    block.padded2.resize(block.padded.size());
  }
  rows_ = std::max(rows_, block.rows.last);
  blocks_.push_back(std::move(block));
}

StoredEntries BlockOperator::entries() const {
  StoredEntries sum;
  for (const Block& block : blocks_) {
    const long all = static_cast<long>(block.rows.size()) * block.columns.size();
    sum += block.dense.empty() ? block.sparse.entries() : StoredEntries{all, all};
  }
  return sum;
}

void BlockOperator::multiply(const VectorX& x, VectorX& y) const {
  if (y.size() < rows_) y.resize(rows_);
  parallel_for(static_cast<int>(blocks_.size()), threads_, [&](int i) {
    const Block& block = blocks_[static_cast<std::size_t>(i)];
    const double* const from = x.data() + block.columns.first;
    double* const to = y.data() + block.rows.first;
    if (!block.dense.empty()) return block.dense.multiply(from, to);
    block.sparse.multiply(from, block.padded.data());
    std::copy_n(block.padded.data(), block.rows.size(), to);
  });
}

void BlockOperator::multiply(const VectorX& start, const VectorX& x, const VectorX& x2, VectorX& y, VectorX& y2) const {
  if (y.size() < rows_) y.resize(rows_);
  if (y2.size() < rows_) y2.resize(rows_);
  for (const Block& block : blocks_) {
    const int row = block.rows.first, size = block.rows.size();
    const double *const from = x.data() + block.columns.first, *const from2 = x2.data() + block.columns.first;
    if (!block.dense.empty()) {
      block.dense.multiply(start.data() + row, from, from2, y.data() + row, y2.data() + row);
      continue;
    }
    block.sparse.multiply(from, block.padded.data());
    block.sparse.multiply(from2, block.padded2.data());
    for (int i = 0; i < size; ++i) y[row + i] = start[row + i] + block.padded[static_cast<std::size_t>(i)];
    std::copy_n(block.padded2.data(), size, y2.data() + row);
  }
}

}  // namespace nsframe
