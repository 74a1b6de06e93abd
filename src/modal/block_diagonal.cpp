#include "modal/block_diagonal.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <stdexcept>

#include "base/decompositions.hpp"

namespace nsframe {

namespace {

using Complex = std::complex<double>;

constexpr Eigen::Index long_double_rows = 400;
constexpr double wanted_condition = 1e3;   // above, a block is joined with the nearest one
constexpr double thinnest_pair = 0.03;     // of imaginary to real part of an eigenvector, below which a pair is a dense block
constexpr double largest_residual = 1e-11;

// Eigenvalues (of pairs the upper one) with a basis of their invariant subspace.
struct Cluster {
  std::vector<Complex> values;
  MatrixX basis;
  bool dense = false;
};

// The basis of a pair: real and imaginary part of its eigenvector, turned so that they are orthogonal.
MatrixX basis_of_pair(const Eigen::VectorXcd& vector) {
  const Complex square = (vector.transpose() * vector)(0);
  const Eigen::VectorXcd turned = vector * std::exp(Complex(0, -0.5 * std::arg(square)));
  MatrixX basis(vector.size(), 2);
  basis << turned.real(), turned.imag();
  return basis / basis.norm();
}

// Orthonormal basis of the invariant subspace of the eigenvalues nearest to those of the cluster, by inverse iteration.
MatrixX invariant_subspace(const MatrixX& A, const Cluster& cluster) {
  Complex mean = 0;
  for (const Complex& value : cluster.values) mean += value;
  mean /= static_cast<double>(cluster.values.size());
  const bool real = std::all_of(cluster.values.begin(), cluster.values.end(), [](const Complex& v) { return v.imag() == 0; });
  const double shift = mean.real() + 1e-4 * (std::abs(mean) + 1e-12 * A.norm());
  MatrixX shifted = A;
  shifted.diagonal().array() -= shift;
  if (!real) {
    shifted = (shifted * shifted).eval();
    shifted.diagonal().array() += mean.imag() * mean.imag();
  }
  const Eigen::PartialPivLU<MatrixX> factor(shifted);
  MatrixX Q = cluster.basis;
  for (Eigen::Index j = 0; j < Q.cols(); ++j) {  // parallel columns must not stay so
    for (Eigen::Index i = 0; i < Q.rows(); ++i) Q(i, j) += 1e-3 * std::sin(1.0 + static_cast<double>((i + 1) * (2 * j + 1)));
  }
  for (int iteration = 0; iteration < 10; ++iteration) {
    Q = factor.solve(Q).eval();
    for (Eigen::Index j = 0; j < Q.cols(); ++j) {  // Gram and Schmidt, twice
      for (int again = 0; again < 2; ++again) {
        for (Eigen::Index i = 0; i < j; ++i) Q.col(j) -= Q.col(i).dot(Q.col(j)) * Q.col(i);
        Q.col(j).normalize();
      }
    }
  }
  return Q;
}

std::vector<Cluster> eigenvector_clusters(const MatrixX& A) {
  const Eigen::EigenSolver<MatrixX> solver(A);
  if (solver.info() != Eigen::Success) throw std::runtime_error("its damped modes were not found");
  const Eigen::VectorXcd values = solver.eigenvalues();
  const Eigen::MatrixXcd vectors = solver.eigenvectors();
  std::vector<Cluster> clusters;
  for (Eigen::Index i = 0; i < values.size(); ++i) {
    if (values[i].imag() < 0) continue;
    Cluster cluster{{values[i]}, {}, false};
    if (values[i].imag() > 0) {
      cluster.basis = basis_of_pair(vectors.col(i));
      cluster.dense = cluster.basis.col(1).norm() < thinnest_pair;
      if (cluster.dense) cluster.basis = invariant_subspace(A, cluster);
    } else {
      cluster.basis = vectors.col(i).real().normalized();
    }
    clusters.push_back(std::move(cluster));
  }
  return clusters;
}

double distance(const Cluster& a, const Cluster& b) {
  double least = std::numeric_limits<double>::infinity();
  for (const Complex& v : a.values) {
    for (const Complex& w : b.values) least = std::min(least, std::abs(v - w));
  }
  return least;
}

// Rows of V^-1 and columns of V of a block: what it makes of rounding.
double condition_of(const MatrixX& basis, const MatrixX& inverse, Eigen::Index first, Eigen::Index size) {
  const double condition = basis.middleCols(first, size).norm() * inverse.middleRows(first, size).norm() / std::sqrt(static_cast<double>(size));
  return std::isfinite(condition) ? condition : std::numeric_limits<double>::infinity();
}

MatrixX joined(const std::vector<Cluster>& clusters, Eigen::Index n) {
  MatrixX basis(n, n);
  Eigen::Index at = 0;
  for (const Cluster& cluster : clusters) {
    basis.middleCols(at, cluster.basis.cols()) = cluster.basis;
    at += cluster.basis.cols();
  }
  return basis;
}

// Joins clusters until none is too badly conditioned.
void join_parallel(const MatrixX& A, std::vector<Cluster>& clusters) {
  for (;;) {
    const MatrixX basis = joined(clusters, A.rows()), inverse = Eigen::PartialPivLU<MatrixX>(basis).inverse();
    double worst = 0;
    std::size_t at = 0, nearest = 0;
    Eigen::Index first = 0;
    for (std::size_t b = 0; b < clusters.size(); ++b) {
      const double condition = condition_of(basis, inverse, first, clusters[b].basis.cols());
      if (condition > worst) worst = condition, at = b;
      first += clusters[b].basis.cols();
    }
    if (worst <= wanted_condition || clusters.size() < 2) return;
    if (std::isinf(worst)) {  // exactly parallel: which ones, only their distance tells
      double least = worst;
      for (std::size_t b = 0; b < clusters.size(); ++b) {
        for (std::size_t c = 0; c < b; ++c) {
          if (const double d = distance(clusters[b], clusters[c]); d < least) least = d, at = c, nearest = b;
        }
      }
    } else {
      double least = std::numeric_limits<double>::infinity();
      for (std::size_t b = 0; b < clusters.size(); ++b) {
        if (const double d = distance(clusters[at], clusters[b]); b != at && d < least) least = d, nearest = b;
      }
    }
    Cluster& one = clusters[std::min(at, nearest)];
    Cluster& other = clusters[std::max(at, nearest)];
    if (one.basis.cols() + other.basis.cols() > largest_dense_block) {
      if (worst <= worst_condition) return;
      throw std::runtime_error(fmt::format("more than {} of its damped modes are nearly parallel", largest_dense_block));
    }
    MatrixX both(A.rows(), one.basis.cols() + other.basis.cols());
    both << one.basis, other.basis;
    one.basis = both;
    one.values.insert(one.values.end(), other.values.begin(), other.values.end());
    one.dense = true;
    one.basis = invariant_subspace(A, one);
    clusters.erase(clusters.begin() + static_cast<std::ptrdiff_t>(std::max(at, nearest)));
  }
}

// E with B_i E - E B_j = -R.
MatrixX sylvester(const MatrixX& Bi, const MatrixX& Bj, const MatrixX& R) {
  const Eigen::Index p = Bi.rows(), q = Bj.rows();
  if (p == 1 && q == 1) return MatrixX::Constant(1, 1, -R(0, 0) / (Bi(0, 0) - Bj(0, 0)));
  MatrixX system = MatrixX::Zero(p * q, p * q);
  for (Eigen::Index j = 0; j < q; ++j) {
    system.block(j * p, j * p, p, p) += Bi;
    for (Eigen::Index l = 0; l < q; ++l) system.block(j * p, l * p, p, p).diagonal().array() -= Bj(l, j);
  }
  const VectorX right = -R.reshaped();
  return MatrixX(Eigen::PartialPivLU<MatrixX>(system).solve(right).reshaped(p, q));
}

template <class Real>
struct Form {
  using Matrix = Eigen::Matrix<Real, Eigen::Dynamic, Eigen::Dynamic>;
  Matrix A, V, W, B;

  void improve_inverse() {
    Matrix error = -(W * V);
    error.diagonal().array() += Real(1);
    W += (error * W).eval();
  }

  // One step of Newton's method on the off-diagonal blocks of B = W A V; returns their largest entry relative to A's.
  double improve(const std::vector<DiagonalBlock>& blocks) {
    B = W * (A * V);
    MatrixX E = MatrixX::Zero(A.rows(), A.cols());
    double largest = 0;
    for (const DiagonalBlock& i : blocks) {
      for (const DiagonalBlock& j : blocks) {
        if (i.first == j.first) continue;
        const MatrixX R = B.block(i.first, j.first, i.size, j.size).template cast<double>();
        largest = std::max(largest, R.cwiseAbs().maxCoeff());
        E.block(i.first, j.first, i.size, j.size) =
            sylvester(B.block(i.first, i.first, i.size, i.size).template cast<double>(), B.block(j.first, j.first, j.size, j.size).template cast<double>(), R);
      }
    }
    const Matrix change = E.template cast<Real>();
    V += (V * change).eval();
    W -= (change * W).eval();
    improve_inverse();
    return largest / static_cast<double>(A.cwiseAbs().maxCoeff());
  }

  // Brings a block of a complex pair into the form [real, imag; -imag, real].
  void turn(DiagonalBlock& block) {
    const Eigen::Index k = block.first;
    const Real half = (B(k, k) - B(k + 1, k + 1)) / 2, square = -half * half - B(k, k + 1) * B(k + 1, k);
    if (!(square > 0)) throw std::runtime_error("its damped modes were not found");
    const Real imag = std::copysign(std::sqrt(square), B(k, k + 1)), real = (B(k, k) + B(k + 1, k + 1)) / 2;
    const Real u = -half / B(k, k + 1), v = imag / B(k, k + 1);  // eigenvector (1, u + i v)
    const Matrix columns = V.middleCols(k, 2), rows = W.middleRows(k, 2);
    V.col(k) = columns.col(0) + u * columns.col(1);
    V.col(k + 1) = v * columns.col(1);
    W.row(k + 1) = (rows.row(1) - u * rows.row(0)) / v;
    block.real = real;
    block.imag = imag;
  }
};

// |exp(B t)| <= exp(at) sum_k (|N| t)^k / k!, with the strictly triangular part N of B's Schur form (Van Loan 1977); t^k exp(at) is at most
// (k / (e |a|))^k.
double growth_of(const MatrixX& B, double scale) {
  const Eigen::VectorXcd values = Eigen::EigenSolver<MatrixX>(B, false).eigenvalues();
  const double slowest = values.real().maxCoeff(), upper = std::sqrt(std::max(0.0, B.squaredNorm() - values.squaredNorm()));
  if (upper <= 1e-9 * scale) return static_cast<double>(B.rows());
  if (!(slowest < -1e-12 * scale)) throw std::runtime_error("its damped modes are nearly parallel and hardly damped");
  double growth = 1, factorial = 1;
  for (int k = 1; k < B.rows(); ++k) {
    factorial *= k;
    growth += std::pow(upper * k / (std::exp(1.0) * -slowest), k) / factorial;
  }
  return growth;
}

template <class Real>
void fill(const LongMatrix& A, BlockDiagonal& form) {
  Form<Real> f;
  f.A = A.cast<Real>();
  f.V = form.basis.cast<Real>();
  f.W = form.inverse.cast<Real>();
  f.improve_inverse();
  for (int iteration = 0; iteration < 4; ++iteration) {
    const double residual = f.improve(form.blocks);
    if (residual < 16 * std::numeric_limits<double>::epsilon()) break;
  }
  f.B = f.W * (f.A * f.V);
  form.residual = 0;
  const auto scale = static_cast<double>(f.A.cwiseAbs().maxCoeff());
  for (DiagonalBlock& block : form.blocks) {
    const Eigen::Index k = block.first;
    for (const DiagonalBlock& other : form.blocks) {
      if (other.first == k) continue;
      form.residual = std::max(form.residual, static_cast<double>(f.B.block(k, other.first, block.size, other.size).cwiseAbs().maxCoeff()) / scale);
    }
    if (block.dense()) {
      block.matrix = f.B.block(k, k, block.size, block.size).template cast<double>();
      block.magnitude = block.matrix.norm();
      block.growth = growth_of(block.matrix, scale);
      continue;
    }
    if (block.size == 2) {
      f.turn(block);
    } else {
      block.real = f.B(k, k);
    }
    if (block.real > 1e-10L * static_cast<long double>(scale)) throw std::runtime_error("its damping lets a mode grow");
    block.real = std::min(block.real, 0.0L);
    block.magnitude = static_cast<double>(std::hypot(block.real, block.imag));
  }
  form.basis = f.V.template cast<double>();
  form.inverse = f.W.template cast<double>();
}

}  // namespace

MatrixX DiagonalBlock::full() const {
  if (dense()) return matrix;
  const auto re = static_cast<double>(real), im = static_cast<double>(imag);
  return size == 1 ? MatrixX::Constant(1, 1, re) : MatrixX(Eigen::Matrix2d{{re, im}, {-im, re}});
}

BlockDiagonal block_diagonal_form(const LongMatrix& A) {
  const MatrixX rounded = A.cast<double>();
  std::vector<Cluster> clusters = eigenvector_clusters(rounded);
  join_parallel(rounded, clusters);
  BlockDiagonal form;
  form.basis = joined(clusters, A.rows());
  form.inverse = Eigen::PartialPivLU<MatrixX>(form.basis).inverse();
  int first = 0;
  for (const Cluster& cluster : clusters) {
    DiagonalBlock block;
    block.first = first;
    block.size = static_cast<int>(cluster.basis.cols());
    if (cluster.dense) block.matrix = MatrixX::Zero(block.size, block.size);
    first += block.size;
    form.blocks.push_back(std::move(block));
  }
  if (A.rows() <= long_double_rows) {
    fill<long double>(A, form);
  } else {
    fill<double>(A, form);
  }
  for (const DiagonalBlock& block : form.blocks) {
    form.condition = std::max(form.condition, condition_of(form.basis, form.inverse, block.first, block.size));
  }
  if (!(form.condition <= worst_condition)) throw std::runtime_error(fmt::format("its damped modes are nearly parallel (condition {:.1e})", form.condition));
  if (!(form.residual <= largest_residual)) throw std::runtime_error(fmt::format("its damped modes were found to {:.1e} only", form.residual));
  return form;
}

}  // namespace nsframe
