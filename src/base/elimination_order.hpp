// The order in which a sparse symmetric matrix is eliminated: minimum degree, or its own order where that repeats.
#pragma once

#include <Eigen/OrderingMethods>

#include "base/types.hpp"

namespace nsframe {

// Entries below the diagonal of the Cholesky factor of a matrix with symmetric pattern, eliminated in the order of `place`: that of every
// row (empty: as it stands). Row by row along the elimination tree (Liu 1990).
long factor_entries(const SparseMatrix& matrix, const std::vector<int>& place);

// True when the factors in the matrix' own order are the cheaper ones to read: rows of equal floors make equal rows of the factors, which
// are stored once (chunked_rows.hpp), but only where floor follows floor, and minimum degree jumps between them.
bool own_order_is_cheaper(const SparseMatrix& matrix, const std::vector<int>& minimum_degree);

// To be the ordering of Eigen's factorizations. `matrix` has both triangles, with their values.
struct EliminationOrder {
  using PermutationType = Eigen::PermutationMatrix<Eigen::Dynamic, Eigen::Dynamic, int>;
  template <class Matrix>
  void operator()(const Matrix& matrix, PermutationType& inverse) const {
    Eigen::AMDOrdering<int>()(matrix, inverse);
    std::vector<int> place(static_cast<std::size_t>(matrix.rows()));
    for (int k = 0; k < inverse.size(); ++k) place[static_cast<std::size_t>(inverse.indices()[k])] = k;
    if (own_order_is_cheaper(matrix, place)) inverse.resize(0);
  }
};

using SparseCholesky = Eigen::SimplicialLDLT<SparseMatrix, Eigen::Lower, EliminationOrder>;

}  // namespace nsframe
