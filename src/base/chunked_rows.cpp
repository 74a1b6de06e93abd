#include "base/chunked_rows.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <unordered_map>

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

// Finds chunks that equal earlier ones: entry (i, j) by |difference| <= tolerance row_scale[i] column_scale[j], and what belongs to a row
// beside its entries, `own`, to the tolerance. Compared is always with the one that is stored, so that differences don't add up.
class Sharing {
 public:
  Sharing(Chunks& chunks, const VectorX& row_scale, const VectorX& column_scale, const VectorX& own)
      : chunks_(chunks), row_scale_(row_scale), column_scale_(column_scale), own_(own) {}

  // Adds the chunk from row `first` on as one that is stored; false where none is like it, and the next one to be added is kept for later ones.
  bool share(Eigen::Index first, const Gatherer& rows) {
    std::vector<Kept>& alike = kept_[pattern(first, rows)];
    for (auto one = alike.rbegin(); one != alike.rend(); ++one) {
      if (!equal(*one, first, rows)) continue;
      chunks_.begin.push_back(chunks_.begin[one->chunk]);
      chunks_.end.push_back(chunks_.end[one->chunk]);
      return true;
    }
    if (alike.size() == most_alike) alike.erase(alike.begin());
    Kept& kept = alike.emplace_back(Kept{chunks_.begin.size(), first, {}, {}});
    for (std::size_t k = 0; k < rows.columns().size(); ++k) {
      kept.columns.push_back(rows.columns()[k] - static_cast<int>(first));
      kept.values.push_back(rows.values(k));
    }
    return false;
  }

 private:
  static constexpr double tolerance = 4 * machine_epsilon;
  static constexpr std::size_t most_alike = 64;  // of one pattern that are compared with, the last ones
  struct Kept {
    std::size_t chunk;
    Eigen::Index first;
    std::vector<int> columns;
    std::vector<Rows> values;
  };

  std::uint64_t pattern(Eigen::Index first, const Gatherer& rows) const {
    auto hash = static_cast<std::uint64_t>(last_row(first) - first);
    for (const int column : rows.columns()) {
      hash = (hash ^ static_cast<std::uint64_t>(column - first)) * 0x9e3779b97f4a7c15u;
      hash ^= hash >> 32;
    }
    return hash;
  }
  Eigen::Index last_row(Eigen::Index first) const { return std::min(first + chunk_rows, row_scale_.size()); }
  bool equal(const Kept& kept, Eigen::Index first, const Gatherer& rows) const {
    if (kept.columns.size() != rows.columns().size() || last_row(kept.first) - kept.first != last_row(first) - first) return false;
    for (Eigen::Index i = 0; first + i < last_row(first); ++i) {
      const double own = own_[first + i];
      if (!(std::abs(own_[kept.first + i] - own) <= tolerance * std::abs(own))) return false;
    }
    for (std::size_t k = 0; k < kept.columns.size(); ++k) {
      const int column = rows.columns()[k];
      if (kept.columns[k] != column - first) return false;
      for (Eigen::Index i = 0; first + i < last_row(first); ++i) {
        const double difference = std::abs(kept.values[k][i] - rows.values(k)[i]);
        if (!(difference <= tolerance * row_scale_[first + i] * column_scale_[column])) return false;
      }
    }
    return true;
  }

  Chunks& chunks_;
  const VectorX &row_scale_, &column_scale_, &own_;
  std::unordered_map<std::uint64_t, std::vector<Kept>> kept_;
};

// w = (1 + T)^-1 (S w - T w outside the chunk), chunk by chunk, for a matrix T without diagonal that is strictly triangular and a diagonal S.
// Chunks stand in the order of the solution: memory is read in one direction.
Chunks triangular_chunks(const SparseRows& triangle, const VectorX& scale, bool backward, const VectorX& row_scale,
                         const VectorX& column_scale) {
  Chunks chunks;
  Gatherer rows(triangle.cols());
  Sharing sharing(chunks, row_scale, column_scale, scale);
  const Eigen::Index last = (triangle.rows() - 1) / chunk_rows;
  for (Eigen::Index i = 0; i <= last; ++i) {
    const Eigen::Index first = chunk_rows * (backward ? last - i : i);
    const auto begin = static_cast<int>(first);
    rows.gather(triangle, first);
    if (sharing.share(first, rows)) continue;
    const auto inside = [&](int column) { return column >= first && column < first + chunk_rows; };
    Square own = Square::Identity();
    for (std::size_t k = 0; k < rows.columns().size(); ++k) {
      if (inside(rows.columns()[k])) own.col(rows.columns()[k] - first) += rows.values(k);
    }
    const Square inverse = own.inverse();
    chunks.open();
    for (int k = 0; k < std::min<Eigen::Index>(chunk_rows, triangle.rows() - first); ++k) {
      chunks.add_column(k, scale[first + k] * inverse.col(k));
    }
    for (std::size_t k = 0; k < rows.columns().size(); ++k) {
      if (!inside(rows.columns()[k])) chunks.add_column(rows.columns()[k] - begin, -(inverse * rows.values(k)));
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

StoredEntries Chunks::entries() const {
  StoredEntries sum{0, static_cast<long>(values.size())};
  for (std::size_t i = 0; i < begin.size(); ++i) sum.met += chunk_rows * (end[i] - begin[i]);
  return sum;
}

ChunkedRows::ChunkedRows(const SparseMatrix& matrix) {
  const SparseRows by_rows = matrix;
  const VectorX scale = VectorX(matrix.diagonal()).cwiseAbs().cwiseSqrt(), none = VectorX::Zero(matrix.rows());
  Gatherer rows(matrix.cols());
  Sharing sharing(chunks_, scale, scale, none);
  for (Eigen::Index first = 0; first < by_rows.rows(); first += chunk_rows) {
    rows.gather(by_rows, first);
    if (sharing.share(first, rows)) continue;
    chunks_.open();
    for (std::size_t k = 0; k < rows.columns().size(); ++k) chunks_.add_column(rows.columns()[k] - static_cast<int>(first), rows.values(k));
    chunks_.close();
  }
}

void ChunkedRows::multiply(const double* x, double* y) const {
  apply_chunks(chunks_.count(), false, chunks_.begin.data(), chunks_.end.data(), chunks_.columns.data(), chunks_.values.data(), x, y);
}

ChunkedFactor::ChunkedFactor(const SparseCholesky& factor) {
  const auto n = factor.rows();
  SparseMatrix lower = factor.matrixL();
  lower.prune([](Eigen::Index row, Eigen::Index column, double) { return row > column; });
  const SparseRows by_rows = lower, transposed = lower.transpose();
  const VectorX pivots = factor.vectorD(), inverse = pivots.cwiseInverse(), reach = inverse.cwiseAbs().cwiseSqrt();
  // of the diagonal of P A P' = L D L'
  const VectorX size = (pivots.cwiseAbs() + lower.cwiseAbs2() * pivots.cwiseAbs()).cwiseSqrt();
  forward_ = triangular_chunks(by_rows, VectorX::Ones(n), false, size, reach);
  backward_ = triangular_chunks(transposed, inverse, true, reach, size);
  const auto& permutation = factor.permutationP().indices();  // empty: none
  place_.resize(static_cast<std::size_t>(n));
  for (int i = 0; i < n; ++i) place_[static_cast<std::size_t>(i)] = permutation.size() > 0 ? permutation[i] : i;
  work_.assign(static_cast<std::size_t>(forward_.padded_rows()), 0.0);
}

StoredEntries ChunkedFactor::entries() const {
  StoredEntries sum = forward_.entries();
  return sum += backward_.entries();
}

void ChunkedFactor::solve(const double* rhs, double* x) const {
  for (std::size_t i = 0; i < place_.size(); ++i) work_[static_cast<std::size_t>(place_[i])] = rhs[i];
  double* const w = work_.data();
  for (const Chunks* part : {&forward_, &backward_}) {
    apply_chunks(part->count(), part == &backward_, part->begin.data(), part->end.data(), part->columns.data(), part->values.data(), w, w);
  }
  for (std::size_t i = 0; i < place_.size(); ++i) x[i] = w[place_[i]];
}

}  // namespace nsframe
