#include "integrators/buckling.hpp"

#include <Spectra/GenEigsSolver.h>

#include <algorithm>
#include <cmath>

#include "base/decompositions.hpp"
#include "base/errors.hpp"

namespace nsframe {

namespace {

constexpr double relative_change = 1e-4;  // of the displacements for the derivative, to the size of the model
constexpr double loading_change = 1e-9;   // likewise, towards the loads, to find the tangents of loading
constexpr double same_tangent = 1e-6;     // relative
constexpr int most_passes = 5;
constexpr double least_share = 1e-7;      // of the largest 1 / load factor, below which one is rounding

// Largest extent of the model [m].
double extent(const Model& model) {
  Vector3 low = Vector3::Constant(1e300), high = -low;
  for (const Vector3& place : model.nodes.position) {
    low = low.cwiseMin(place);
    high = high.cwiseMax(place);
  }
  return std::max((high - low).maxCoeff(), 1e-3);
}

// x = -K^-1 K_g x, for Spectra.
class Operator {
 public:
  using Scalar = double;
  Operator(const SparseMatrix& geometric, const Eigen::SparseLU<SparseMatrix>& factor) : geometric_(geometric), factor_(factor) {}
  Eigen::Index rows() const { return geometric_.rows(); }
  Eigen::Index cols() const { return geometric_.cols(); }
  void perform_op(const double* in, double* out) const {
    const VectorX x = geometric_ * Eigen::Map<const VectorX>(in, rows());
    Eigen::Map<VectorX>(out, rows()) = -factor_.solve(x);
  }

 private:
  const SparseMatrix& geometric_;
  const Eigen::SparseLU<SparseMatrix>& factor_;
};

struct Pairs {
  Eigen::VectorXcd values;   // 1 / load factor
  Eigen::MatrixXcd vectors;
};

Pairs eigenpairs(const SparseMatrix& K, const SparseMatrix& geometric, const Eigen::SparseLU<SparseMatrix>& factor, int count) {
  const int n = static_cast<int>(K.rows());
  if (n <= dense_eigen_limit) {
    const MatrixX A = -factor.solve(MatrixX(geometric));
    const Eigen::EigenSolver<MatrixX> solver(A);
    if (solver.info() != Eigen::Success) throw ConvergenceError("the eigenvalues of buckling did not converge");
    return {solver.eigenvalues(), solver.eigenvectors()};
  }
  Operator A(geometric, factor);
  const int wanted = std::min(2 * count + 4, n - 2);
  Spectra::GenEigsSolver<Operator> solver(A, wanted, std::min(n, 4 * wanted + 20));
  solver.init();
  solver.compute(Spectra::SortRule::LargestReal, 2000, 1e-10);
  if (solver.info() != Spectra::CompInfo::Successful) throw ConvergenceError("the eigenvalues of buckling did not converge");
  return {solver.eigenvalues(), solver.eigenvectors()};
}

// Eigenvalues of a stable tangent have positive real parts.
void require_stability(const SparseMatrix& K, bool symmetric) {
  bool stable = true;
  if (symmetric) {
    const Eigen::SimplicialLDLT<SparseMatrix> factor(K);
    stable = factor.info() == Eigen::Success && factor.vectorD().minCoeff() > 0;
  } else if (K.rows() <= dense_eigen_limit) {
    stable = MatrixX(K).eigenvalues().real().minCoeff() > 0;
  }
  if (!stable) throw ConvergenceError("the structure is not stable under the constant loads: there is no load factor to add");
}

}  // namespace

std::vector<BucklingMode> buckling_modes(System& system, const State& state, const VectorX& at_nodes, int count, double member_loads) {
  VectorX pattern = at_nodes;
  if (member_loads != 0) pattern += member_loads * system.assembler.member_loads(state.displacement, state.history);
  VectorX history = state.history, force, loading = state.displacement, response;
  SparseMatrix K;
  Eigen::SparseLU<SparseMatrix> factor;
  double size = 0, reached = 0, next = 0;  // `reached`: the load factor at `loading` that K has seen
  for (int pass = 0; pass < most_passes; ++pass) {
    system.assembler.start_step(state.history, history);
    system.assembler.internal_force(loading, state.history, history, force);
    const SparseMatrix& tangent = system.assembler.tangent();
    if (pass > 1 && (tangent - K).norm() <= same_tangent * K.norm()) break;
    K = tangent;
    reached = next;
    require_stability(K, system.assembler.symmetric());
    factor.compute(K);
    if (factor.info() != Eigen::Success) throw ConvergenceError("the stiffness is singular under the constant loads");
    response = factor.solve(pattern);
    size = response.lpNorm<Eigen::Infinity>();
    if (!(size > 0)) return {};
    next = loading_change * extent(system.model) / size;
    loading = state.displacement + next * response;
  }
  const double change = relative_change * extent(system.model) / size;
  system.assembler.start_step(state.history, history);
  SparseMatrix geometric = system.assembler.geometric_change(loading, change * response, change * member_loads, state.history, history);
  geometric *= 1 / change;
  const Pairs pairs = eigenpairs(K, geometric, factor, count);
  const double largest = pairs.values.cwiseAbs().maxCoeff();
  std::vector<BucklingMode> modes;
  for (Eigen::Index i = 0; i < pairs.values.size(); ++i) {
    const std::complex<double> value = pairs.values[i];
    if (!(value.real() > least_share * largest) || std::abs(value.imag()) > 1e-8 * std::abs(value)) continue;
    // the vector of a real eigenvalue is real but for a factor
    Eigen::Index largest_entry = 0;
    pairs.vectors.col(i).cwiseAbs().maxCoeff(&largest_entry);
    BucklingMode mode{reached + 1 / value.real(), (pairs.vectors.col(i) / pairs.vectors(largest_entry, i)).real()};
    const VectorX full = system.model.dofs.expand(mode.shape);
    double translation = 0;
    for (int node = 0; node < system.model.nodes.size(); ++node) {
      translation = std::max(translation, full.segment<3>(6 * node).lpNorm<Eigen::Infinity>());
    }
    if (translation > 0) mode.shape /= translation;
    modes.push_back(std::move(mode));
  }
  std::sort(modes.begin(), modes.end(), [](const auto& a, const auto& b) { return a.load_factor < b.load_factor; });
  if (modes.size() > static_cast<std::size_t>(count)) modes.resize(static_cast<std::size_t>(count));
  return modes;
}

}  // namespace nsframe
