#include "contact/friction.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/decompositions.hpp"

namespace nsframe {

namespace {

using Matrix2 = Eigen::Matrix2d;

constexpr int newton_iterations = 25, first_sweeps = 20;
// Rows up to which a singular Jacobian is solved by least norm; above, with a small diagonal.
constexpr Eigen::Index few_rows = 150;

double largest_diagonal(const FrictionProblem& problem, Eigen::Index pair) {
  return problem.delassus.diagonal().segment<3>(3 * pair).maxCoeff();
}

// Onto |t| <= mu n, where the cone is the half line for mu = 0.
Vector3 onto_cone(const Vector3& p, double mu) {
  const double n = p[0], t = p.tail<2>().norm();
  if (n >= 0 && t <= mu * n) return p;
  if (mu * t <= -n) return Vector3::Zero();
  const double normal = (n + mu * t) / (1 + mu * mu);
  Vector3 out(normal, 0, 0);
  if (t > 0) out.tail<2>() = mu * normal / t * p.tail<2>();
  return out;
}

double rounding_error(const FrictionProblem& problem, const VectorX& impulse) {
  return rounding_error(ContactProblem{problem.delassus, problem.rhs}, impulse);
}

class Newton {
 public:
  explicit Newton(const FrictionProblem& problem) : problem_(problem) {}

  // Steps from p until `enough`; p is then the best met.
  double improve(VectorX& p, double enough, int& iterations) {
    VectorX trial = p;
    double best = friction_error(problem_, p);
    for (int i = 0; i < newton_iterations && best > std::max(enough, rounding_error(problem_, p)); ++i, ++iterations) {
      linearise(trial);
      VectorX change;
      if (trial.size() <= few_rows) {
        change = RankRevealing<double>(jacobian_, 1e-13).solve(residual_);
      } else {
        jacobian_.diagonal().array() += 1e-11;
        Eigen::PartialPivLU<MatrixX> factor(jacobian_);
        change = factor.solve(residual_);
      }
      if (!change.allFinite()) break;
      trial -= change;
      const double error = friction_error(problem_, trial);
      if (error < best) {
        best = error;
        p = trial;
      }
    }
    return best;
  }

 private:
  // F(p) and its derivative: p_n - (xi)+, p_t - projection of tau onto the disk of radius mu (xi)+, with xi = p_n - u_n/w,
  // tau = p_t - u_t/w; theory.md (278).
  void linearise(const VectorX& p) {
    const Eigen::Index rows = p.size();
    const MatrixX& W = problem_.delassus;
    const VectorX u = W * p + problem_.rhs;
    residual_ = p;
    jacobian_.setIdentity(rows, rows);
    for (Eigen::Index i = 0; i < problem_.pairs(); ++i) {
      const Eigen::Index n = 3 * i;
      const double w = largest_diagonal(problem_, i), xi = p[n] - u[n] / w, mu = problem_.friction[i];
      if (xi <= 0) continue;  // open: F = p
      residual_[n] = u[n] / w;
      jacobian_.row(n) = W.row(n) / w;
      if (mu == 0) continue;
      const Vector2 tau = p.segment<2>(n + 1) - u.segment<2>(n + 1) / w;
      const double size = tau.norm(), bound = mu * xi;
      const bool sticks = size <= bound;
      const double shrink = sticks ? 1 : bound / size;
      const Vector2 along = size > 0 ? Vector2(tau / size) : Vector2(Vector2::Zero());
      const Matrix2 across = sticks ? Matrix2(Matrix2::Identity()) : Matrix2(shrink * (Matrix2::Identity() - along * along.transpose()));
      residual_.segment<2>(n + 1) = p.segment<2>(n + 1) - shrink * tau;
      jacobian_.middleRows<2>(n + 1) += across * W.middleRows<2>(n + 1) / w;
      jacobian_.block<2, 2>(n + 1, n + 1) -= across;
      if (sticks) {
        for (Eigen::Index k = n + 1; k <= n + 2; ++k) {  // a tangent along which nothing moves
          if (W(k, k) <= 0) jacobian_(k, k) = 1, residual_[k] = p[k];
        }
        continue;
      }
      jacobian_.middleRows<2>(n + 1) += mu * along * W.row(n) / w;
      jacobian_.col(n).segment<2>(n + 1) -= mu * along;
    }
  }

  const FrictionProblem& problem_;
  MatrixX jacobian_;
  VectorX residual_;
};

void sweep(const FrictionProblem& problem, VectorX& p) {
  for (Eigen::Index i = 0; i < problem.pairs(); ++i) {
    const Matrix3 W = problem.delassus.block<3, 3>(3 * i, 3 * i);
    const Vector3 own = p.segment<3>(3 * i);
    const Vector3 others = problem.delassus.middleRows<3>(3 * i) * p + problem.rhs.segment<3>(3 * i) - W * own;
    p.segment<3>(3 * i) = solve_one_contact(W, others, problem.friction[i]);
  }
}

}  // namespace

double friction_error(const FrictionProblem& problem, const VectorX& impulse) {
  if (problem.rhs.size() == 0) return 0;
  const VectorX rate = problem.delassus * impulse + problem.rhs;
  double error = 0;
  for (Eigen::Index i = 0; i < problem.pairs(); ++i) {
    const double w = largest_diagonal(problem, i), mu = problem.friction[i];
    const Vector3 p = impulse.segment<3>(3 * i);
    Vector3 u = rate.segment<3>(3 * i);
    if (mu == 0) u.tail<2>().setZero();
    u[0] += mu * u.tail<2>().norm();
    error = std::max(error, w * (p - onto_cone(p - u / w, mu)).cwiseAbs().maxCoeff());
  }
  return error / std::max(problem.rhs.cwiseAbs().maxCoeff(), std::numeric_limits<double>::min());
}

Vector3 solve_one_contact(const Matrix3& W, const Vector3& rhs, double friction) {
  if (rhs[0] >= 0) return Vector3::Zero();
  const double least = 16 * machine_epsilon * W.diagonal().maxCoeff();
  // normal impulse eliminated: (S + alpha I) p_t = -b
  const Vector2 coupling = W.block<2, 1>(1, 0);
  const Matrix2 S = W.block<2, 2>(1, 1) - coupling * coupling.transpose() / W(0, 0);
  const Vector2 b = rhs.tail<2>() - coupling * (rhs[0] / W(0, 0));
  Eigen::SelfAdjointEigenSolver<Matrix2> modes;
  modes.computeDirect(S);
  const Vector2 along = modes.eigenvectors().transpose() * b;
  const auto impulse = [&](double alpha) {
    Vector2 t;
    for (int k = 0; k < 2; ++k) {
      const double stiffness = std::max(modes.eigenvalues()[k], 0.0) + alpha;
      t[k] = stiffness > least ? -along[k] / stiffness : 0;
    }
    Vector3 p;
    p.tail<2>() = modes.eigenvectors() * t;
    p[0] = (-rhs[0] - coupling.dot(p.tail<2>())) / W(0, 0);
    return p;
  };
  const auto excess = [&](const Vector3& p) { return p.tail<2>().norm() - friction * p[0]; };
  if (friction == 0) return {-rhs[0] / W(0, 0), 0, 0};
  Vector3 p = impulse(0);
  if (excess(p) <= 0) return p;
  double low = 0, high = W.diagonal().maxCoeff();
  while (excess(impulse(high)) > 0) {
    low = high;
    high *= 4;
  }
  for (int i = 0; i < 120 && high - low > 2 * machine_epsilon * high; ++i) {
    const double middle = 0.5 * (low + high);
    (excess(impulse(middle)) > 0 ? low : high) = middle;
  }
  return impulse(high);
}

ContactSolution solve_friction(const FrictionProblem& problem, const ContactOptions& options, VectorX guess) {
  ContactSolution solution;
  solution.impulse = guess.size() == problem.rhs.size() ? std::move(guess) : VectorX(VectorX::Zero(problem.rhs.size()));
  solution.error = friction_error(problem, solution.impulse);
  Newton newton(problem);
  VectorX p = solution.impulse;
  for (int sweeps = first_sweeps;; sweeps *= 2) {
    VectorX polished = p;
    const double error = newton.improve(polished, options.tolerance, solution.iterations);
    if (error < solution.error) {
      solution.impulse = std::move(polished);
      solution.error = error;
    }
    solution.converged = solution.error <= std::max(options.tolerance, rounding_error(problem, solution.impulse));
    if (solution.converged || solution.iterations >= options.max_iterations) break;
    for (int i = 0; i < sweeps; ++i) sweep(problem, p);
    solution.iterations += sweeps;
  }
  for (Eigen::Index i = 0; i < problem.pairs(); ++i) {  // rounding of what is open
    if (solution.impulse[3 * i] <= 0) solution.impulse.segment<3>(3 * i).setZero();
  }
  return solution;
}

}  // namespace nsframe
