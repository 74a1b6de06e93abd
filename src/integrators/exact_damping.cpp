#include "integrators/exact_damping.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "base/decompositions.hpp"
#include "base/errors.hpp"

namespace nsframe {

namespace {

constexpr double coupling_tolerance = 1e-8;  // of damping between two modes, relative to their own, that is taken for rounding
constexpr double tied = 1e-13;               // the same, once damping ties some modes together
constexpr double coupling_rounding = 32 * machine_epsilon;  // of the terms that a coupling is the sum of
constexpr double slowest_scale = 1;          // [rad/s]: slower modes are scaled as if they had this frequency
constexpr double no_dashpot = 1e-12;         // of the longest relaxation time, that counts as none

// Turns modes of (nearly) one frequency so that the damping does not couple them.
void separate_equal_modes(BlockModes& modes, const MatrixX& damping) {
  const Eigen::Index count = modes.square.size();
  for (Eigen::Index first = 0; first < count;) {
    Eigen::Index last = first + 1;
    while (last < count && modes.square[last] - modes.square[first] <= 1e-9 * modes.square[last]) ++last;
    if (last - first > 1) {
      const MatrixX shapes = modes.shape.middleCols(first, last - first);
      modes.shape.middleCols(first, last - first) = shapes * SymmetricEigen<double>(shapes.transpose() * damping * shapes).vectors;
    }
    first = last;
  }
}

// A structure's damping in its modes, and beside them in motions without mass.
struct ModalDamping {
  MatrixX D, size;                // Phi' C Phi; |Phi|' |C| |Phi|
  MatrixX follow, coupling;       // v, a column each; d = Phi' C v
  VectorX relaxation, rest;       // tau = v' C v [s]; v' K q of the rest under static loads
};

double floor_of(const BlockModes& modes, Eigen::Index i, Eigen::Index j) { return 1e-13 * std::sqrt(std::max(modes.square[i], modes.square[j])); }

bool modes_coupled(const BlockModes& modes, const MatrixX& D) {
  for (Eigen::Index i = 0; i < D.rows(); ++i) {
    for (Eigen::Index j = 0; j < i; ++j) {
      if (std::abs(D(i, j)) > coupling_tolerance * std::sqrt(std::max(0.0, D(i, i)) * std::max(0.0, D(j, j))) + floor_of(modes, i, j)) return true;
    }
  }
  return false;
}

// Whether dashpots on DOFs without mass matter: coupled with modes, or pulled by loads that act suddenly.
bool massless_coupled(const System& system, const Structure& structure, const BlockModes& modes, const MatrixX& D, const MatrixX& C) {
  const MatrixX& N = modes.massless;
  for (Eigen::Index i = 0; i < N.cols(); ++i) {
    const VectorX force = C * N.col(i);
    const double rate = N.col(i).dot(force);
    if (!(rate > 0)) continue;
    const VectorX coupling = modes.shape.transpose() * force;
    for (Eigen::Index k = 0; k < coupling.size(); ++k) {
      if (std::abs(coupling[k]) > coupling_tolerance * std::sqrt(std::max(0.0, D(k, k)) * rate) + 1e-300) return true;
    }
    if (!system.model.gravity_statically_first && std::abs(N.col(i).dot(system.static_load.segment(structure.first_dof, N.rows()))) > 0) return true;
  }
  return false;
}

// Motions of first order: C_N v = tau K_N v in what has no mass, v' K_N v = 1.
void find_relaxations(const System& system, const Structure& structure, const BlockModes& modes, const MatrixX& K, const MatrixX& C, const MatrixX& H,
                      ModalDamping& damping) {
  const MatrixX& N = modes.massless;
  if (N.cols() == 0) return;
  const MatrixX stiffness = N.transpose() * K * N, dashpots = N.transpose() * C * N;
  if (dashpots.cwiseAbs().maxCoeff() == 0) return;
  const Eigen::GeneralizedSelfAdjointEigenSolver<MatrixX> solver(dashpots, stiffness);
  const VectorX tau = solver.eigenvalues();
  const VectorX pull = N.transpose() * system.static_load.segment(structure.first_dof, N.rows());
  std::vector<Eigen::Index> moving;
  for (Eigen::Index j = 0; j < tau.size(); ++j) {
    if (!(tau[j] > no_dashpot * tau[tau.size() - 1])) continue;
    const VectorX v = N * solver.eigenvectors().col(j), d = modes.shape.transpose() * (C * v);
    if (H.rows() > 0 && (H * v).cwiseAbs().maxCoeff() > 1e-12 * v.cwiseAbs().maxCoeff()) {
      refuse_modes(structure, "contact meets DOFs that have damping and no mass: give them mass, or choose modal damping");
    }
    const bool pulled = !system.model.gravity_statically_first && pull.dot(solver.eigenvectors().col(j)) != 0;
    bool coupled = false;
    for (Eigen::Index k = 0; k < d.size(); ++k) {
      coupled = coupled || std::abs(d[k]) > tied * std::sqrt(std::max(0.0, damping.D(k, k)) * tau[j]) + 1e-300;
    }
    if (pulled || coupled) moving.push_back(j);
  }
  damping.relaxation = tau(moving);
  const MatrixX shapes = solver.eigenvectors()(Eigen::all, moving);
  damping.follow = N * shapes;
  damping.coupling = modes.shape.transpose() * (C * damping.follow);
  damping.rest = shapes.transpose() * pull;
}

// Modes and first-order motions that are tied together, directly or through others; sets of more than one mode, or with first-order motions.
std::vector<std::vector<int>> tied_sets(const BlockModes& modes, const ModalDamping& damping) {
  const auto n = static_cast<int>(modes.square.size()), all = n + static_cast<int>(damping.relaxation.size());
  const auto linked = [&](int i, int j) {
    if (i > j) std::swap(i, j);
    if (i >= n) return false;
    const double own = std::max(0.0, damping.D(i, i));
    if (j >= n) return std::abs(damping.coupling(i, j - n)) > tied * std::sqrt(own * damping.relaxation[j - n]) + 1e-300;
    return std::abs(damping.D(i, j)) > std::max(tied * std::sqrt(own * std::max(0.0, damping.D(j, j))), coupling_rounding * damping.size(i, j));
  };
  std::vector<std::vector<int>> sets;
  std::vector<bool> seen(static_cast<std::size_t>(all), false);
  for (int start = 0; start < all; ++start) {
    if (seen[static_cast<std::size_t>(start)]) continue;
    seen[static_cast<std::size_t>(start)] = true;
    std::vector<int> set{start};
    for (std::size_t at = 0; at < set.size(); ++at) {
      for (int j = 0; j < all; ++j) {
        if (seen[static_cast<std::size_t>(j)] || !linked(set[at], j)) continue;
        seen[static_cast<std::size_t>(j)] = true;
        set.push_back(j);
      }
    }
    std::sort(set.begin(), set.end());
    if (set.size() > 1 || set[0] >= n) sets.push_back(std::move(set));
  }
  return sets;
}

// Of every mode the complex one in which it has the largest share that no other mode's is larger than.
void name_complex_modes(DampingCoupling& coupling) {
  const auto n = coupling.square.size(), m = coupling.rate.size();
  const auto& blocks = coupling.form.blocks;
  MatrixX share = MatrixX::Zero(n, static_cast<Eigen::Index>(blocks.size()));
  for (std::size_t b = 0; b < blocks.size(); ++b) {
    for (Eigen::Index i = 0; i < n; ++i) {
      for (Eigen::Index k = blocks[b].first; k < blocks[b].first + blocks[b].size; ++k) {
        for (const Eigen::Index row : {i, n + m + i}) share(i, static_cast<Eigen::Index>(b)) += coupling.form.basis(row, k) * coupling.form.inverse(k, row);
      }
    }
  }
  share = share.cwiseAbs().eval();
  coupling.complex_frequency = coupling.complex_damping = VectorX::Zero(n);
  std::vector<int> left;  // modes that a block still stands for: a pair or a creeping motion for one
  for (const DiagonalBlock& block : blocks) left.push_back(std::max(1, block.size / 2));
  for (Eigen::Index named = 0; named < n; ++named) {
    Eigen::Index i = 0, b = 0;
    share.maxCoeff(&i, &b);
    const DiagonalBlock& block = blocks[static_cast<std::size_t>(b)];
    double real = static_cast<double>(block.real), size = block.magnitude;
    if (block.dense()) {  // nearly one eigenvalue, or one pair
      real = block.matrix.trace() / block.size;
      size = std::pow(std::abs(block.matrix.determinant()), 1.0 / block.size);
    }
    coupling.complex_frequency[i] = size;
    coupling.complex_damping[i] = size > 0 ? std::min(1.0, -real / size) : 1;
    share.row(i).setConstant(-1);
    if (--left[static_cast<std::size_t>(b)] == 0) share.col(b).array() = share.col(b).array().min(-0.5);
  }
}

DampingCoupling coupling_of(const Structure& structure, const std::vector<int>& set, const BlockModes& modes, const ModalDamping& damping) {
  const auto all_modes = static_cast<int>(modes.square.size());
  DampingCoupling result;
  result.structure = structure.name;
  result.places = set;
  std::vector<int> modal, first_order;
  for (const int i : set) i < all_modes ? modal.push_back(i) : first_order.push_back(i - all_modes);
  const auto n = static_cast<Eigen::Index>(modal.size()), m = static_cast<Eigen::Index>(first_order.size()), size = 2 * n + m;
  result.square = modes.square(modal);
  result.rate = damping.relaxation(first_order).cwiseInverse();
  result.rest = damping.rest(first_order);
  result.damping = damping.D(modal, modal);
  result.coupling.resize(n, m);
  if (m > 0) {
    const MatrixX d = damping.coupling(modal, first_order);
    result.coupling = d * result.rate.asDiagonal();
    result.damping -= d * result.rate.asDiagonal() * d.transpose();
  }
  result.damping = (0.5 * (result.damping + result.damping.transpose())).eval();
  // in (w x, z, y) the matrix is skew but for what dissipates: no mode's energy can grow
  using Vector = Eigen::Matrix<long double, Eigen::Dynamic, 1>;
  Vector scale(size);
  LongMatrix A = LongMatrix::Zero(size, size);
  for (Eigen::Index i = 0; i < n; ++i) {
    const auto square = static_cast<long double>(result.square[i]);
    scale[i] = std::max(static_cast<long double>(slowest_scale), std::sqrt(square));
    scale[n + m + i] = 1;
    A(i, n + m + i) = scale[i];
    A(n + m + i, i) = -square / scale[i];
  }
  for (Eigen::Index j = 0; j < m; ++j) {
    scale[n + j] = 1;
    A(n + j, n + j) = -static_cast<long double>(result.rate[j]);
  }
  A.bottomRightCorner(n, n) = -result.damping.cast<long double>();
  A.block(n + m, n, n, m) = result.coupling.cast<long double>();
  A.block(n, n + m, m, n) = -result.coupling.transpose().cast<long double>();
  try {
    result.form = block_diagonal_form(A);
  } catch (const std::runtime_error& problem) {
    refuse_modes(structure, problem.what());
  }
  const VectorX factor = scale.cast<double>();
  result.form.basis = (factor.cwiseInverse().asDiagonal() * result.form.basis).eval();
  result.form.inverse = (result.form.inverse * factor.asDiagonal()).eval();
  name_complex_modes(result);
  return result;
}

}  // namespace

void refuse_modes(const Structure& structure, const std::string& why) {
  Diagnostics diagnostics;
  diagnostics.error(structure.at, fmt::format("schemes 'exact' and 'exponential' move structure '{}' in its natural modes, but {}; use scheme = "
                                              "\"event-split\" or \"moreau-jean\"",
                                              structure.name, why));
  diagnostics.throw_if_any();
  throw InputError(why);
}

BlockDamping block_damping(const System& system, const Structure& structure, BlockModes& modes, const MatrixX& K, const MatrixX& C, const MatrixX& H) {
  separate_equal_modes(modes, C);
  ModalDamping damping;
  damping.D = modes.shape.transpose() * C * modes.shape;
  BlockDamping result;
  result.decay = damping.D.diagonal().cwiseMax(0.0);
  result.follow.resize(C.rows(), 0);
  result.follow_projection.resize(0, C.rows());
  const MatrixX& N = modes.massless;
  for (Eigen::Index i = 0; i < N.cols(); ++i) {
    const bool touched = H.rows() > 0 && (H * N.col(i)).cwiseAbs().maxCoeff() > 0;
    if (touched && N.col(i).dot(C * N.col(i)) > 0) {
      refuse_modes(structure, "contact meets DOFs that have damping and no mass: give them mass, or choose modal damping");
    }
  }
  const bool with_massless = massless_coupled(system, structure, modes, damping.D, C);
  if (!with_massless && !modes_coupled(modes, damping.D)) return result;
  if (with_massless) find_relaxations(system, structure, modes, K, C, H, damping);
  damping.size = modes.shape.cwiseAbs().transpose() * C.cwiseAbs() * modes.shape.cwiseAbs();
  const auto count = static_cast<int>(modes.square.size());
  for (const std::vector<int>& set : tied_sets(modes, damping)) {
    result.couplings.push_back(coupling_of(structure, set, modes, damping));
    for (const int i : set) {
      if (i < count) result.decay[i] = 0;
    }
  }
  if (damping.follow.cols() > 0) {
    result.follow = damping.follow;
    result.follow_projection = damping.follow.transpose() * K;
  }
  return result;
}

}  // namespace nsframe
