#include "integrators/static_step.hpp"

#include <algorithm>
#include <cmath>

#include "base/errors.hpp"

namespace nsframe {

namespace {

constexpr int dense_border_limit = 160;  // free DOFs up to which the bordered matrix is dense

}  // namespace

StaticStep::StaticStep(System& system, const VectorX& dead, const VectorX& pattern, double factor_scale)
    : system_(system), dead_(dead), pattern_(pattern), factor_scale_(factor_scale), dense_(pattern.size() <= dense_border_limit) {}

void StaticStep::prepare(const StaticPoint& committed, ConstraintFunction constraint, const VectorX& change,
                         double factor_change, const StaticTolerance& tolerance) {
  committed_ = &committed;
  constraint_function_ = std::move(constraint);
  first_change_ = change;
  first_factor_change_ = factor_change;
  tolerance_ = tolerance;
}

void StaticStep::restart() {
  trial_ = *committed_;
  system_.assembler.start_step(committed_->state.history, trial_.state.history);
  if (member_loads_) system_.assembler.set_load_factor(*member_loads_, trial_.state.history);
  trial_.state.displacement += first_change_;
  trial_.factor += first_factor_change_;
  evaluate(determination());
  // where members alone are loaded, their clamping forces are all that there is to compare with
  if (member_loads_) tolerance_.least_force = std::max(tolerance_.least_force, trial_.state.internal_force.norm());
  if (row_scale_ > 0) return;
  row_scale_ = std::max(system_.assembler.tangent().diagonal().cwiseAbs().mean(), 1e-300);
  residual_[pattern_.size()] = row_scale_ * constraint_.value;
}

void StaticStep::settle() {
  if (system_.assembler.unsettled()) evaluate(StateDetermination::remaining);
}

void StaticStep::evaluate(StateDetermination how) {
  State& state = trial_.state;
  const Eigen::Index n = pattern_.size();
  system_.assembler.internal_force(state.displacement, committed_->state.history, state.history, state.internal_force, true, how);
  residual_.resize(n + 1);
  residual_.head(n) = state.internal_force - dead_ - trial_.factor * pattern_;
  constraint_function_(state.displacement, trial_.factor, constraint_);
  residual_[n] = row_scale_ * constraint_.value;
  scale_ = std::max({(dead_ + trial_.factor * pattern_).norm(), state.internal_force.norm(), tolerance_.least_force, 1e-300});
  error_ = std::max(relative_residual() / tolerance_.residual, std::abs(constraint_.value) / constraint_.tolerance);
}

double StaticStep::relative_residual() const { return residual_.head(pattern_.size()).norm() / scale_; }

std::string StaticStep::worst_element() const { return system_.assembler.worst_element(residual_.head(pattern_.size())); }

void StaticStep::factor(Tangent which) {
  ++factorizations_;
  const SparseMatrix& K = which == Tangent::initial ? system_.initial_stiffness : system_.assembler.tangent();
  const int n = static_cast<int>(pattern_.size());
  if (dense_) {
    MatrixX J(n + 1, n + 1);
    J.topLeftCorner(n, n) = K;
    J.topRightCorner(n, 1) = -factor_scale_ * pattern_;
    J.bottomLeftCorner(1, n) = row_scale_ * constraint_.by_displacement.transpose();
    J(n, n) = row_scale_ * factor_scale_ * constraint_.by_factor;
    dense_factor_.compute(J);
    return;
  }
  std::vector<Eigen::Triplet<double>> entries;
  entries.reserve(static_cast<std::size_t>(K.nonZeros() + 2 * n + 1));
  for (int j = 0; j < n; ++j) {
    for (SparseMatrix::InnerIterator entry(K, j); entry; ++entry) entries.emplace_back(static_cast<int>(entry.row()), j, entry.value());
    if (pattern_[j] != 0) entries.emplace_back(j, n, -factor_scale_ * pattern_[j]);
    if (constraint_.by_displacement[j] != 0) entries.emplace_back(n, j, row_scale_ * constraint_.by_displacement[j]);
  }
  entries.emplace_back(n, n, row_scale_ * factor_scale_ * constraint_.by_factor);
  SparseMatrix J(n + 1, n + 1);
  J.setFromTriplets(entries.begin(), entries.end());
  sparse_factor_.compute(J);
  if (sparse_factor_.info() != Eigen::Success) throw ConvergenceError("the stiffness is singular under static loads");
}

void StaticStep::solve(const VectorX& rhs, VectorX& x) {
  if (dense_) {
    x = dense_factor_.solve(rhs);
  } else {
    x = sparse_factor_.solve(rhs);
  }
  if (!x.allFinite()) throw ConvergenceError("the stiffness is singular under static loads");
}

void StaticStep::move(const VectorX& change) {
  trial_.state.displacement += change.head(pattern_.size());
  trial_.factor += factor_scale_ * change[pattern_.size()];
  evaluate(determination());
}

}  // namespace nsframe
