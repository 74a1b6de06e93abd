#include "base/elimination_order.hpp"

#include <numeric>

#include "base/chunked_rows.hpp"

namespace nsframe {

long factor_entries(const SparseMatrix& matrix, const std::vector<int>& place) {
  const auto n = static_cast<std::size_t>(matrix.rows());
  std::vector<int> at(place), row_at(n), parent(n, -1), reached(n, -1);
  if (at.empty()) {
    at.resize(n);
    std::iota(at.begin(), at.end(), 0);
  }
  for (std::size_t i = 0; i < n; ++i) row_at[static_cast<std::size_t>(at[i])] = static_cast<int>(i);
  long count = 0;
  for (std::size_t k = 0; k < n; ++k) {
    const auto row = static_cast<int>(k);
    reached[k] = row;
    for (SparseMatrix::InnerIterator entry(matrix, row_at[k]); entry; ++entry) {
      for (int i = at[static_cast<std::size_t>(entry.row())]; i < row && reached[static_cast<std::size_t>(i)] != row;
           i = parent[static_cast<std::size_t>(i)]) {
        const auto node = static_cast<std::size_t>(i);
        if (parent[node] < 0) parent[node] = row;
        reached[node] = row;
        ++count;
      }
    }
  }
  return count;
}

bool own_order_is_cheaper(const SparseMatrix& matrix, const std::vector<int>& minimum_degree) {
  const auto least = static_cast<double>(factor_entries(matrix, minimum_degree)), own = static_cast<double>(factor_entries(matrix, {}));
  if (own <= least) return true;
  constexpr double widest = 3;  // more entries than that aren't worth the arithmetic
  return own < widest * least && own * ChunkedRows(matrix).entries().stored_share() < least;
}

}  // namespace nsframe
