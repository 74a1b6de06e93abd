#include "base/block_operator.hpp"

#include <algorithm>

#include "base/dense_kernel.hpp"

namespace nsframe {

SparseMatrix extract_block(const SparseMatrix& matrix, const BlockRange& range) {
  return matrix.block(range.first, range.first, range.size(), range.size());
}

BlockOperator::BlockOperator(const SparseMatrix& matrix, const std::vector<BlockRange>& blocks, int dense_limit) {
  for (const BlockRange& range : blocks) {
    const SparseMatrix part = extract_block(matrix, range);
    const bool crowded = 16 * part.nonZeros() > static_cast<Eigen::Index>(range.size()) * range.size();
    if (range.size() <= dense_limit && crowded) {
      add_dense(range, MatrixX(part));
    } else {
      blocks_.push_back({range, 0, {}, SparseRows(part)});
      size_ = std::max(size_, range.last);
    }
  }
}

BlockOperator::BlockOperator(const std::vector<MatrixX>& matrices, const std::vector<BlockRange>& blocks) {
  for (std::size_t i = 0; i < blocks.size(); ++i) add_dense(blocks[i], matrices[i]);
}

void BlockOperator::add_dense(const BlockRange& range, const MatrixX& matrix) {
  Block block{range, (range.size() + dense_row_padding - 1) / dense_row_padding * dense_row_padding, {}, {}};
  block.dense.assign(static_cast<std::size_t>(block.padded_rows) * static_cast<std::size_t>(range.size()), 0.0);
  for (int j = 0; j < range.size(); ++j) {
    std::copy_n(matrix.col(j).data(), range.size(), block.dense.data() + static_cast<std::ptrdiff_t>(j) * block.padded_rows);
  }
  padded_.resize(std::max(padded_.size(), static_cast<std::size_t>(block.padded_rows)));
  size_ = std::max(size_, range.last);
  blocks_.push_back(std::move(block));
}

void BlockOperator::multiply(const VectorX& x, VectorX& y) const {
  y.resize(x.size());
  for (const Block& block : blocks_) {
    const BlockRange& range = block.range;
    if (block.dense.empty()) {
      y.segment(range.first, range.size()).noalias() = block.sparse * x.segment(range.first, range.size());
    } else {
      dense_multiply(block.dense.data(), block.padded_rows, range.size(), x.data() + range.first, padded_.data());
      std::copy_n(padded_.data(), range.size(), y.data() + range.first);
    }
  }
}

}  // namespace nsframe
