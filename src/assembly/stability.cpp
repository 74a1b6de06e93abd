#include "assembly/stability.hpp"

#include <fmt/format.h>

#include <cmath>

#include "models/dof_names.hpp"

namespace nsframe {

namespace {

// Least eigenvalue of the matrix scaled to unit diagonal: rounding leaves some 1e-15 of a zero, a column of n elements in
// bending has n^-4 / 2.
constexpr double singular = 1e-13;

// An approximate null vector of a symmetric matrix with unit diagonal, by inverse iteration on a shifted copy; empty
// when the matrix is regular.
VectorX null_vector(const SparseMatrix& matrix) {
  VectorX scale(matrix.rows());
  for (Eigen::Index i = 0; i < scale.size(); ++i) {
    const double diagonal = std::abs(matrix.coeff(static_cast<int>(i), static_cast<int>(i)));
    if (diagonal == 0) return VectorX::Unit(scale.size(), i);
    scale[i] = 1 / std::sqrt(diagonal);
  }
  SparseMatrix scaled = scale.asDiagonal() * matrix * scale.asDiagonal();
  SparseMatrix shifted = scaled;
  for (int i = 0; i < shifted.rows(); ++i) shifted.coeffRef(i, i) += singular;
  Eigen::SimplicialLDLT<SparseMatrix> factor(shifted);
  if (factor.info() != Eigen::Success) return {};
  VectorX x = VectorX::Random(scale.size());
  for (int k = 0; k < 6; ++k) x = factor.solve(x).normalized().eval();
  if ((scaled * x).norm() > singular) return {};
  return scale.cwiseProduct(x);
}

}  // namespace

void check_stability(const Model& model, const SparseMatrix& stiffness, Diagnostics& diagnostics) {
  for (const Structure& structure : model.structures) {
    const BlockRange range{structure.first_dof, structure.last_dof};
    if (range.size() == 0) continue;
    SparseMatrix K = extract_block(stiffness, range);
    if (structure.may_move_freely) {
      const SparseMatrix M = extract_block(model.mass, range);
      const double typical = K.diagonal().sum() / M.diagonal().sum();
      K += (typical > 0 ? typical : 1.0) * M;
    }
    const VectorX motion = null_vector(K);
    if (motion.size() == 0) continue;
    Eigen::Index largest = 0;
    motion.cwiseAbs().maxCoeff(&largest);
    const FreeDof dof = model.dofs.free[static_cast<std::size_t>(range.first + largest)];
    diagnostics.error(structure.at, fmt::format("structure '{}' is unstable: node '{}' moves in {} without resistance "
                                                "(a support, a brace or a connection is missing)",
                                                structure.name, model.nodes.id[static_cast<std::size_t>(dof.node)],
                                                node_dof_names[static_cast<std::size_t>(dof.direction)]));
  }
}

}  // namespace nsframe
