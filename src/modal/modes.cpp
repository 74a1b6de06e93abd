#include "modal/modes.hpp"

#include <Spectra/MatOp/SparseSymMatProd.h>
#include <Spectra/MatOp/SymShiftInvert.h>
#include <Spectra/SymGEigsShiftSolver.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "base/decompositions.hpp"

namespace nsframe {

namespace {


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

namespace {

// All finite modes when few DOFs have mass: condensed statically on those DOFs, F M x = mu x with F = (K + s M)^-1 there.
Modes solve_condensed(const SparseMatrix& stiffness, const SparseMatrix& mass, const std::vector<Eigen::Index>& massive, double shift,
                      int count) {
  const auto rank = static_cast<Eigen::Index>(massive.size());
  MatrixX unit = MatrixX::Zero(stiffness.rows(), rank), M(rank, rank);
  for (Eigen::Index j = 0; j < rank; ++j) {
    unit(massive[static_cast<std::size_t>(j)], j) = 1;
    for (Eigen::Index i = 0; i < rank; ++i) M(i, j) = mass.coeff(static_cast<int>(massive[static_cast<std::size_t>(i)]), static_cast<int>(massive[static_cast<std::size_t>(j)]));
  }
  const Eigen::SimplicialLDLT<SparseMatrix> factor(SparseMatrix(stiffness + shift * mass));
  if (factor.info() != Eigen::Success) throw std::runtime_error("the stiffness is singular on DOFs without mass");
  const MatrixX response = factor.solve(unit);
  const MatrixX F = response(massive, Eigen::all);
  const Eigen::GeneralizedSelfAdjointEigenSolver<MatrixX> solver(M, F, Eigen::ComputeEigenvectors | Eigen::BAx_lx);
  if (solver.info() != Eigen::Success) throw std::runtime_error("the condensed eigenvalue solver failed");
  const VectorX& mu = solver.eigenvalues();
  std::vector<Eigen::Index> finite;
  for (Eigen::Index i = rank - 1; i >= 0 && static_cast<int>(finite.size()) < count; --i) {
    if (mu[i] > 1e-13 * mu[rank - 1]) finite.push_back(i);
  }
  VectorX squared(static_cast<Eigen::Index>(finite.size()));
  for (Eigen::Index i = 0; i < squared.size(); ++i) squared[i] = 1 / mu[finite[static_cast<std::size_t>(i)]] - shift;
  return arrange(squared, response * (M * solver.eigenvectors()(Eigen::all, finite)), mass, 1e-9 * shift);
}

}  // namespace

Modes solve_modes_sparse(const SparseMatrix& stiffness, const SparseMatrix& mass, int count) {
  const int size = static_cast<int>(stiffness.rows());
  std::vector<Eigen::Index> massive;
  for (int i = 0; i < size; ++i) {
    if (mass.coeff(i, i) > 0) massive.push_back(i);
  }
  if (massive.empty() || count < 1) return {VectorX(0), MatrixX(size, 0)};
  const double shift = definite_shift(stiffness, mass);
  // Lanczos vectors live in the range of M: a basis as large as that would be filled up by rounding
  const int wanted = std::min(count, static_cast<int>(massive.size())), basis = std::max(2 * wanted + 1, 20);
  if (basis >= static_cast<int>(massive.size())) return solve_condensed(stiffness, mass, massive, shift, wanted);
  using Inverse = Spectra::SymShiftInvert<double, Eigen::Sparse, Eigen::Sparse>;
  using Product = Spectra::SparseSymMatProd<double>;
  Inverse inverse(stiffness, mass);
  Product product(mass);
  Spectra::SymGEigsShiftSolver<Inverse, Product, Spectra::GEigsMode::ShiftInvert> solver(inverse, product, wanted, basis, -shift);
  solver.init();
  solver.compute(Spectra::SortRule::LargestMagn, 1000, 1e-12, Spectra::SortRule::SmallestAlge);
  if (solver.info() != Spectra::CompInfo::Successful) throw std::runtime_error("the sparse eigenvalue solver did not converge");
  return arrange(solver.eigenvalues(), solver.eigenvectors(), mass, 1e-9 * shift);
}

Modes solve_modes(const SparseMatrix& stiffness, const SparseMatrix& mass, int count) {
  const bool small = stiffness.rows() <= dense_eigen_limit || 3 * count > stiffness.rows();
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
