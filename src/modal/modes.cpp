#include "modal/modes.hpp"

#include <Spectra/MatOp/SparseSymMatProd.h>
#include <Spectra/MatOp/SymShiftInvert.h>
#include <Spectra/SymGEigsShiftSolver.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace nsframe {

namespace {

constexpr int dense_limit = 300;

// A shift s that makes K + s M positive definite without hiding the lowest modes: 0 when K is definite by itself.
double definite_shift(const SparseMatrix& stiffness, const SparseMatrix& mass) {
  const Eigen::SimplicialLDLT<SparseMatrix> factor(stiffness);
  if (factor.info() == Eigen::Success) {
    const VectorX pivots = factor.vectorD();
    if (pivots.minCoeff() > 1e-13 * pivots.maxCoeff()) return 0;
  }
  const double typical = stiffness.diagonal().sum() / mass.diagonal().sum();
  return typical > 0 ? 1e-3 * typical : 1.0;
}

// Mass-normalises and sorts; drops modes whose frequency is infinite (massless).
Modes arrange(const VectorX& frequency_squared, const MatrixX& shape, const SparseMatrix& mass, double zero) {
  Modes modes;
  modes.circular_frequency.resize(frequency_squared.size());
  modes.shape = shape;
  for (Eigen::Index i = 0; i < frequency_squared.size(); ++i) {
    const double squared = frequency_squared[i];
    modes.circular_frequency[i] = squared > zero ? std::sqrt(squared) : 0;
    modes.shape.col(i) /= std::sqrt(modes.shape.col(i).dot(mass * modes.shape.col(i)));
    Eigen::Index largest = 0;
    modes.shape.col(i).cwiseAbs().maxCoeff(&largest);
    if (modes.shape(largest, i) < 0) modes.shape.col(i) *= -1;
  }
  return modes;
}

}  // namespace

Modes solve_modes_dense(const SparseMatrix& stiffness, const SparseMatrix& mass, int count) {
  const double shift = definite_shift(stiffness, mass);
  const MatrixX M(mass), K = MatrixX(stiffness) + shift * M;
  // M phi = mu (K + s M) phi with mu = 1/(w^2 + s): massless DOFs give mu = 0, the lowest modes the largest mu
  const Eigen::GeneralizedSelfAdjointEigenSolver<MatrixX> solver(M, K);
  if (solver.info() != Eigen::Success) throw std::runtime_error("the dense eigenvalue solver failed");
  const VectorX& mu = solver.eigenvalues();
  const double largest = mu[mu.size() - 1];
  std::vector<Eigen::Index> finite;
  for (Eigen::Index i = mu.size() - 1; i >= 0 && static_cast<int>(finite.size()) < count; --i) {
    if (mu[i] > 1e-13 * largest) finite.push_back(i);
  }
  VectorX squared(static_cast<Eigen::Index>(finite.size()));
  MatrixX shape(K.rows(), squared.size());
  for (Eigen::Index i = 0; i < squared.size(); ++i) {
    squared[i] = 1 / mu[finite[static_cast<std::size_t>(i)]] - shift;
    shape.col(i) = solver.eigenvectors().col(finite[static_cast<std::size_t>(i)]);
  }
  return arrange(squared, shape, mass, 1e-9 * shift);
}

Modes solve_modes_sparse(const SparseMatrix& stiffness, const SparseMatrix& mass, int count) {
  const int size = static_cast<int>(stiffness.rows());
  int rank = 0;
  for (int i = 0; i < size; ++i) rank += mass.coeff(i, i) > 0 ? 1 : 0;
  const int wanted = std::min({count, rank, size - 1});
  const int basis = std::min(size, std::max(2 * wanted + 1, 20));
  const double shift = definite_shift(stiffness, mass);
  using Inverse = Spectra::SymShiftInvert<double, Eigen::Sparse, Eigen::Sparse>;
  using Product = Spectra::SparseSymMatProd<double>;
  Inverse inverse(stiffness, mass);
  Product product(mass);
  Spectra::SymGEigsShiftSolver<Inverse, Product, Spectra::GEigsMode::ShiftInvert> solver(inverse, product, wanted, basis, -shift);
  // start in the range of K^-1 M, so that massless DOFs follow statically
  solver.init();
  solver.compute(Spectra::SortRule::LargestMagn, 1000, 1e-12, Spectra::SortRule::SmallestAlge);
  if (solver.info() != Spectra::CompInfo::Successful) throw std::runtime_error("the sparse eigenvalue solver did not converge");
  return arrange(solver.eigenvalues(), solver.eigenvectors(), mass, 1e-9 * shift);
}

Modes solve_modes(const SparseMatrix& stiffness, const SparseMatrix& mass, int count) {
  const bool small = stiffness.rows() <= dense_limit || 3 * count > stiffness.rows();
  return small ? solve_modes_dense(stiffness, mass, count) : solve_modes_sparse(stiffness, mass, count);
}

MatrixX modal_damping_factor(const Modes& modes, const SparseMatrix& mass, const VectorX& ratios) {
  MatrixX factor(mass.rows(), ratios.size());
  for (Eigen::Index n = 0; n < ratios.size(); ++n) {
    factor.col(n) = std::sqrt(2 * ratios[n] * modes.circular_frequency[n]) * (mass * modes.shape.col(n));
  }
  return factor;
}

}  // namespace nsframe
