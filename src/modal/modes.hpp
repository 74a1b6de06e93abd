// Natural modes K phi = w^2 M phi of one connected structure; M may be singular (massless DOFs), K too (rigid-body
// modes). Dense when small, Spectra's shift-invert Lanczos when large.
#pragma once

#include "base/types.hpp"

namespace nsframe {

struct Modes {
  VectorX circular_frequency;  // [rad/s], ascending; 0 for rigid-body modes
  MatrixX shape;               // columns, phi' M phi = 1
  int size() const { return static_cast<int>(circular_frequency.size()); }
};

// The `count` lowest modes, fewer when M has a lower rank. Throws std::runtime_error when the solver fails.
Modes solve_modes_dense(const SparseMatrix& stiffness, const SparseMatrix& mass, int count);
Modes solve_modes_sparse(const SparseMatrix& stiffness, const SparseMatrix& mass, int count);
// Dense up to 300 DOFs or when most modes are asked for.
Modes solve_modes(const SparseMatrix& stiffness, const SparseMatrix& mass, int count);

// Low-rank factor U of modal damping (theory.md, eq. 22), C = U U': column n is M phi_n sqrt(2 xi_n w_n / M_n).
// `ratios`: damping ratios of the first modes, at most as many as there are modes.
MatrixX modal_damping_factor(const Modes& modes, const SparseMatrix& mass, const VectorX& ratios);

}  // namespace nsframe
