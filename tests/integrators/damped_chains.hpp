// Rows of masses tied by springs and dashpots, and their motion by another route than modes: powers of the matrix exponential of the whole
// system in long double (Taylor series of a short step, squared).
#pragma once

#include <fmt/format.h>

#include "tests/integrators/oscillators.hpp"

namespace nsframe::test {

struct Tie {
  int from = 0, to = -1;          // masses; -1: the ground
  double stiffness = 0, dashpot = 0;  // [N/m], [N s/m]
};

// Masses that move along x in one structure "s", nodes "0", "1", ...; a mass of 0 is none.
inline ModelDescription chain(const std::vector<double>& masses, const std::vector<Tie>& ties, const std::vector<double>& displacement = {},
                              const std::vector<double>& velocity = {}, bool free = false) {
  ModelDescription d;
  StructureDescription s;
  s.name = "s";
  s.at = at(1);
  s.may_move_freely = free;
  for (std::size_t i = 0; i < masses.size(); ++i) {
    const std::string id = std::to_string(i);
    s.nodes.push_back(node(id, 0, 0, 0));
    s.supports.push_back(fixed(id, {false, true, true, true, true, true}));
    if (masses[i] > 0) s.masses.push_back(mass(id, masses[i]));
    if (i < displacement.size() && displacement[i] != 0) s.initial_displacements.push_back({{id, {}}, 0, displacement[i]});
    if (i < velocity.size() && velocity[i] != 0) s.initial_velocities.push_back({{id, {}}, 0, velocity[i]});
  }
  for (std::size_t i = 0; i < ties.size(); ++i) {
    SpringDescription spring = ground_spring(fmt::format("t{}", i), std::to_string(ties[i].from), ties[i].stiffness * Vector6::Unit(0));
    if (ties[i].to >= 0) spring.node_j = Reference{std::to_string(ties[i].to), {}};
    spring.damping[0] = ties[i].dashpot;
    s.springs.push_back(spring);
  }
  d.structures = {s};
  return d;
}

using Long = long double;
using LongMatrixX = Eigen::Matrix<Long, Eigen::Dynamic, Eigen::Dynamic>;
using LongVector = Eigen::Matrix<Long, Eigen::Dynamic, 1>;

inline LongMatrixX exponential(const LongMatrixX& A, Long t) {
  const Long size = A.cwiseAbs().rowwise().sum().maxCoeff() * t;
  const int halvings = std::max(0, static_cast<int>(std::ceil(std::log2(size))) + 4);
  LongMatrixX sum = LongMatrixX::Identity(A.rows(), A.rows()), term = sum;
  for (int n = 1; n <= 16; ++n) {
    term = (term * A * (std::ldexp(t, -halvings) / n)).eval();
    sum += term;
  }
  for (int i = 0; i < halvings; ++i) sum = (sum * sum).eval();
  return sum;
}

// M, C and K of masses and ties, written down here once more.
struct ChainMatrices {
  LongMatrixX M, C, K;
  ChainMatrices(const std::vector<double>& masses, const std::vector<Tie>& ties) {
    const auto n = static_cast<Eigen::Index>(masses.size());
    M = C = K = LongMatrixX::Zero(n, n);
    for (Eigen::Index i = 0; i < n; ++i) M(i, i) = masses[static_cast<std::size_t>(i)];
    for (const Tie& tie : ties) {
      LongVector b = LongVector::Zero(n);
      b[tie.from] = 1;
      if (tie.to >= 0) b[tie.to] = -1;
      C += tie.dashpot * b * b.transpose();
      K += tie.stiffness * b * b.transpose();
    }
  }
  // Of (q, q', 1, t): the load is f0 + f1 t.
  LongMatrixX system(const LongVector& f0, const LongVector& f1) const {
    const Eigen::Index n = M.rows();
    LongMatrixX A = LongMatrixX::Zero(2 * n + 2, 2 * n + 2);
    A.block(0, n, n, n).setIdentity();
    for (Eigen::Index i = 0; i < n; ++i) {
      A.block(n + i, 0, 1, n) = -K.row(i) / M(i, i);
      A.block(n + i, n, 1, n) = -C.row(i) / M(i, i);
      A(n + i, 2 * n) = f0[i] / M(i, i);
      A(n + i, 2 * n + 1) = f1[i] / M(i, i);
    }
    A(2 * n + 1, 2 * n) = 1;
    return A;
  }
  LongMatrixX system() const { return system(LongVector::Zero(M.rows()), LongVector::Zero(M.rows())); }
};

inline LongVector state_of(const std::vector<double>& displacement, const std::vector<double>& velocity) {
  const auto n = static_cast<Eigen::Index>(displacement.size());
  LongVector y = LongVector::Zero(2 * n + 2);
  for (Eigen::Index i = 0; i < n; ++i) {
    y[i] = displacement[static_cast<std::size_t>(i)];
    y[n + i] = velocity[static_cast<std::size_t>(i)];
  }
  y[2 * n] = 1;
  return y;
}

// Largest difference of displacements, and of velocities over `frequency`.
inline double difference(const State& state, const LongVector& y, double frequency) {
  const Eigen::Index n = state.displacement.size();
  const VectorX q = y.head(n).cast<double>(), v = y.segment(n, n).cast<double>();
  return std::max((state.displacement - q).cwiseAbs().maxCoeff(), (state.velocity - v).cwiseAbs().maxCoeff() / frequency);
}

inline AnalysisOptions exact_options(double dt, double duration) {
  AnalysisOptions o;
  o.scheme = "exact";
  o.dt = dt;
  o.duration = duration;
  return o;
}

}  // namespace nsframe::test
