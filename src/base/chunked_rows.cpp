#include "base/chunked_rows.hpp"

#include <algorithm>

#include "base/dense_kernel.hpp"

namespace nsframe {

namespace {

using Rows = Eigen::Matrix<double, chunk_rows, 1>;
using Square = Eigen::Matrix<double, chunk_rows, chunk_rows>;

// Gathers the entries of four rows of a matrix by rows, column by column in ascending order.
class Gatherer {
 public:
  explicit Gatherer(Eigen::Index columns) : at_(static_cast<std::size_t>(columns), -1) {}

  void gather(const SparseRows& matrix, Eigen::Index first) {
    for (const int column : columns_) at_[static_cast<std::size_t>(column)] = -1;
    columns_.clear();
    const Eigen::Index last = std::min(first + chunk_rows, matrix.rows());
    for (Eigen::Index row = first; row < last; ++row) {
      for (SparseRows::InnerIterator entry(matrix, row); entry; ++entry) {
        int& at = at_[static_cast<std::size_t>(entry.col())];
        if (at < 0) {
          at = 0;
          columns_.push_back(static_cast<int>(entry.col()));
        }
      }
    }
    std::sort(columns_.begin(), columns_.end());
    values_.assign(columns_.size(), Rows::Zero());
    for (std::size_t k = 0; k < columns_.size(); ++k) at_[static_cast<std::size_t>(columns_[k])] = static_cast<int>(k);
    for (Eigen::Index row = first; row < last; ++row) {
      for (SparseRows::InnerIterator entry(matrix, row); entry; ++entry) {
        values_[static_cast<std::size_t>(at_[static_cast<std::size_t>(entry.col())])][row - first] = entry.value();
      }
    }
  }
  const std::vector<int>& columns() const { return columns_; }
  const Rows& values(std::size_t k) const { return values_[k]; }

 private:
  std::vector<int> at_, columns_;
  std::vector<Rows> values_;
};

// w = (1 + T)^-1 (S w - T w outside the chunk), chunk by chunk, for a matrix T without diagonal that is strictly triangular and a diagonal S.
// Chunks stand in the order of the solution: memory is read in one direction.
Chunks triangular_chunks(const SparseRows& triangle, const VectorX& scale, bool backward) {
  Chunks chunks;
  Gatherer rows(triangle.cols());
  const Eigen::Index last = (triangle.rows() - 1) / chunk_rows;
  for (Eigen::Index i = 0; i <= last; ++i) {
    const Eigen::Index first = chunk_rows * (backward ? last - i : i);
    rows.gather(triangle, first);
    const auto inside = [&](int column) { return column >= first && column < first + chunk_rows; };
    Square own = Square::Identity();
    for (std::size_t k = 0; k < rows.columns().size(); ++k) {
      if (inside(rows.columns()[k])) own.col(rows.columns()[k] - first) += rows.values(k);
    }
    const Square inverse = own.inverse();
    for (Eigen::Index k = first; k < std::min(first + chunk_rows, triangle.rows()); ++k) {
      chunks.add_column(static_cast<int>(k), scale[k] * inverse.col(k - first));
    }
    for (std::size_t k = 0; k < rows.columns().size(); ++k) {
      if (!inside(rows.columns()[k])) chunks.add_column(rows.columns()[k], -(inverse * rows.values(k)));
    }
    chunks.close();
  }
  return chunks;
}

}  // namespace

void Chunks::add_column(int column, const Eigen::Vector4d& entries) {
  columns.push_back(column);
  values.insert(values.end(), entries.data(), entries.data() + chunk_rows);
}

ChunkedRows::ChunkedRows(const SparseMatrix& matrix) {
  const SparseRows by_rows = matrix;
  Gatherer rows(matrix.cols());
  for (Eigen::Index first = 0; first < by_rows.rows(); first += chunk_rows) {
    rows.gather(by_rows, first);
    for (std::size_t k = 0; k < rows.columns().size(); ++k) chunks_.add_column(rows.columns()[k], rows.values(k));
    chunks_.close();
  }
}

void ChunkedRows::multiply(const double* x, double* y) const {
  apply_chunks(chunks_.count(), false, chunks_.begin.data(), chunks_.columns.data(), chunks_.values.data(), x, y);
}

ChunkedFactor::ChunkedFactor(const Eigen::SimplicialLDLT<SparseMatrix>& factor) {
  const auto n = factor.rows();
  SparseMatrix lower = factor.matrixL();
  lower.prune([](Eigen::Index row, Eigen::Index column, double) { return row > column; });
  const SparseRows by_rows = lower, transposed = lower.transpose();
  forward_ = triangular_chunks(by_rows, VectorX::Ones(n), false);
  backward_ = triangular_chunks(transposed, factor.vectorD().cwiseInverse(), true);
  const auto& permutation = factor.permutationP().indices();  // empty: none
  place_.resize(static_cast<std::size_t>(n));
  for (int i = 0; i < n; ++i) place_[static_cast<std::size_t>(i)] = permutation.size() > 0 ? permutation[i] : i;
  work_.assign(static_cast<std::size_t>(forward_.padded_rows()), 0.0);
}

void ChunkedFactor::solve(const double* rhs, double* x) const {
  for (std::size_t i = 0; i < place_.size(); ++i) work_[static_cast<std::size_t>(place_[i])] = rhs[i];
  double* const w = work_.data();
  apply_chunks(forward_.count(), false, forward_.begin.data(), forward_.columns.data(), forward_.values.data(), w, w);
  apply_chunks(backward_.count(), true, backward_.begin.data(), backward_.columns.data(), backward_.values.data(), w, w);
  for (std::size_t i = 0; i < place_.size(); ++i) x[i] = w[place_[i]];
}

}  // namespace nsframe
