#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "base/decompositions.hpp"
#include "contact/active_cholesky.hpp"
#include "contact/contact_problem.hpp"

namespace nsframe {

namespace {

// Sets from which on all wrong pairs change at once; below, one by one is as fast.
constexpr Eigen::Index large = 16;
// Share of entries of W above rounding below which it is factored as a sparse matrix.
constexpr double sparse_share = 0.3;

// W with unit diagonal, so that pairs between heavy and between light bodies weigh the same.
struct Scaled {
  MatrixX W;
  VectorX rhs;

  // What rounding leaves of W p + rhs, row by row.
  VectorX rounding(const VectorX& p) const {
    return 4 * static_cast<double>(rhs.size()) * machine_epsilon * (W.cwiseAbs() * p + rhs.cwiseAbs());
  }
};

// One pair after the other enters where W p + rhs is negative; its impulse grows, those of the others follow so that their
// rates stay 0, and one that falls to 0 on the way leaves. A pair that depends on those inside never joins them: it takes
// the place of one. False when a pair cannot be satisfied, or rounding keeps the method from ending.
bool solve_one_by_one(const Scaled& problem, double dependence, VectorX& p, int& iterations) {
  const Eigen::Index n = problem.rhs.size();
  ActiveCholesky factor(problem.W);
  std::vector<bool> inside(static_cast<std::size_t>(n), false);
  VectorX d;
  p.setZero(n);
  const int limit = 100 + 20 * static_cast<int>(n);
  for (iterations = 0; iterations < limit; ++iterations) {
    const VectorX rate = problem.W * p + problem.rhs, noise = problem.rounding(p);
    Eigen::Index c = -1;
    double least = 0;
    for (Eigen::Index i = 0; i < n; ++i) {
      if (!inside[static_cast<std::size_t>(i)] && rate[i] < -noise[i] && rate[i] < least) {
        least = rate[i];
        c = i;
      }
    }
    if (c < 0) return true;
    for (bool joined = false; !joined;) {
      const double left = factor.coefficients(c, d), sum = 1 + d.lpNorm<1>();
      const bool depends = left <= std::max(dependence, 32 * machine_epsilon * sum * sum);
      const double full = depends ? std::numeric_limits<double>::infinity() : -least / left;
      double step = full;
      Eigen::Index leaving = -1;
      for (Eigen::Index k = 0; k < d.size(); ++k) {
        const double value = p[factor.pairs()[static_cast<std::size_t>(k)]];
        if (d[k] > 0 && value < step * d[k]) {
          step = value / d[k];
          leaving = k;
        }
      }
      if (!std::isfinite(step)) return false;  // nothing can open this pair
      for (Eigen::Index k = 0; k < d.size(); ++k) p[factor.pairs()[static_cast<std::size_t>(k)]] -= step * d[k];
      p[c] += step;
      if (leaving < 0) {
        factor.add(c, left);
        inside[static_cast<std::size_t>(c)] = joined = true;
      } else {
        const Eigen::Index pair = factor.pairs()[static_cast<std::size_t>(leaving)];
        p[pair] = 0;
        inside[static_cast<std::size_t>(pair)] = false;
        factor.remove(leaving);
        if (!depends) least += step * left;
      }
    }
    // impulses of the set anew, without what the steps have gathered
    VectorX exact(factor.size());
    for (Eigen::Index k = 0; k < exact.size(); ++k) exact[k] = -problem.rhs[factor.pairs()[static_cast<std::size_t>(k)]];
    factor.solve(exact);
    for (Eigen::Index k = 0; k < exact.size(); ++k) {
      if (exact[k] > 0) p[factor.pairs()[static_cast<std::size_t>(k)]] = exact[k];
    }
  }
  return false;
}

// x = W_AA^-1 rhs_A by a sparse or a dense factor; nothing when W_AA is close to singular.
class SetSolver {
 public:
  explicit SetSolver(const MatrixX& W) : W_(W) {
    const double dropped = 0.1 * machine_epsilon;
    const auto entries = (W.array().abs() > dropped).count();
    sparse_ = static_cast<double>(entries) < sparse_share * static_cast<double>(W.size());
    if (sparse_) near_ = (W.array().abs() > dropped).select(W, 0.0).sparseView();
  }

  bool factor(const std::vector<Eigen::Index>& pairs) {
    const auto k = static_cast<Eigen::Index>(pairs.size());
    const double least = 1e-10;
    if (!sparse_) {
      dense_factor_.compute(MatrixX(W_(pairs, pairs)));
      return dense_factor_.info() == Eigen::Success && dense_factor_.matrixLLT().diagonal().minCoeff() > std::sqrt(least);
    }
    std::vector<Eigen::Triplet<double>> entries;
    std::vector<int> place(static_cast<std::size_t>(W_.rows()), -1);
    for (Eigen::Index i = 0; i < k; ++i) place[static_cast<std::size_t>(pairs[static_cast<std::size_t>(i)])] = static_cast<int>(i);
    for (Eigen::Index j = 0; j < k; ++j) {
      for (SparseMatrix::InnerIterator it(near_, pairs[static_cast<std::size_t>(j)]); it; ++it) {
        const int row = place[static_cast<std::size_t>(it.row())];
        if (row >= 0) entries.emplace_back(row, static_cast<int>(j), it.value());
      }
    }
    SparseMatrix A(k, k);
    A.setFromTriplets(entries.begin(), entries.end());
    sparse_factor_.compute(A);
    return sparse_factor_.info() == Eigen::Success && sparse_factor_.vectorD().minCoeff() > least;
  }
  VectorX solve(const VectorX& rhs) const { return sparse_ ? VectorX(sparse_factor_.solve(rhs)) : VectorX(dense_factor_.solve(rhs)); }

 private:
  const MatrixX& W_;
  bool sparse_ = false;
  SparseMatrix near_;
  Eigen::SimplicialLDLT<SparseMatrix> sparse_factor_;
  Eigen::LLT<MatrixX> dense_factor_;
};

// All pairs whose impulse or rate is negative change sides at once (semismooth Newton on min(p, W p + rhs)). False when that
// runs in circles or meets a set that is close to singular.
bool solve_all_at_once(const Scaled& problem, const VectorX& guess, VectorX& p, int& iterations) {
  const Eigen::Index n = problem.rhs.size();
  SetSolver solver(problem.W);
  std::vector<Eigen::Index> pairs;
  for (Eigen::Index i = 0; i < n; ++i) {
    if (guess.size() == n ? guess[i] > 0 : problem.rhs[i] < 0) pairs.push_back(i);
  }
  const int limit = 30;
  for (iterations = 1; iterations <= limit; ++iterations) {
    p.setZero(n);
    if (!pairs.empty()) {
      if (!solver.factor(pairs)) return false;
      VectorX inside = solver.solve(-problem.rhs(pairs));
      p(pairs) = inside;
      const VectorX left = (problem.W * p + problem.rhs)(pairs);  // also of the entries that were dropped
      p(pairs) -= solver.solve(left);
    }
    const VectorX rate = problem.W * p + problem.rhs, noise = problem.rounding(p.cwiseAbs());
    std::vector<Eigen::Index> next;
    bool same = true;
    std::size_t at = 0;
    for (Eigen::Index i = 0; i < n; ++i) {
      const bool inside = at < pairs.size() && pairs[at] == i;
      if (inside) ++at;
      const bool wanted = inside ? p[i] >= -noise[i] : rate[i] < -noise[i];
      if (wanted) next.push_back(i);
      same = same && wanted == inside;
    }
    if (same) return true;
    pairs = std::move(next);
  }
  return false;
}

// Redundant pairs share: where pairs at rest are left outside, the impulses of least norm on all pairs at rest, if none
// pulls. Corners of a rigid slab that hits flat then carry alike.
void share(const Scaled& problem, VectorX& p) {
  const VectorX rate = problem.W * p + problem.rhs, noise = problem.rounding(p);
  std::vector<Eigen::Index> resting;
  bool idle = false;
  for (Eigen::Index i = 0; i < p.size(); ++i) {
    if (p[i] <= 0 && std::abs(rate[i]) > 16 * noise[i]) continue;
    resting.push_back(i);
    idle = idle || p[i] <= 0;
  }
  if (!idle) return;
  const VectorX shared = RankRevealing<double>(problem.W(resting, resting), 1e-12).solve(-problem.rhs(resting));
  if (shared.minCoeff() >= 0) p(resting) = shared;
}

bool symmetric(const MatrixX& W) { return (W - W.transpose()).cwiseAbs().maxCoeff() <= 1e-12; }

}  // namespace

ContactSolution solve_active_set(const ContactProblem& problem, const ContactOptions& options, const VectorX& guess) {
  const Eigen::Index n = problem.rhs.size();
  if (n == 0) return {VectorX(0), 0, 0, true};
  const VectorX scale = problem.delassus.diagonal().cwiseSqrt().cwiseInverse();
  const Scaled scaled{scale.asDiagonal() * problem.delassus * scale.asDiagonal(), scale.cwiseProduct(problem.rhs)};
  if (!symmetric(scaled.W)) return solve_lawson_hanson(problem, options);
  ContactSolution solution;
  const auto finish = [&](const VectorX& p) {
    solution.impulse = scale.cwiseProduct(p.cwiseMax(0.0));
    solution.error = complementarity_error(problem, solution.impulse);
    solution.converged = solution.error <= std::max(options.tolerance, rounding_error(problem, solution.impulse));
    return solution.converged;
  };
  // redundant pairs share their impulses when that solves the problem as well
  const auto accept = [&](VectorX& p) {
    if (!finish(p)) return false;
    share(scaled, p);
    const ContactSolution found = solution;
    if (!finish(p)) solution = found;
    return true;
  };
  VectorX p;
  if (n >= large && solve_all_at_once(scaled, guess, p, solution.iterations) && accept(p)) return solution;
  // Redundant pairs of badly scaled masses: rounding may hide which pairs depend. The proximal point method needs no such
  // question: each of its problems, W + delta I and rhs - delta p, is definite, and p tends to a solution of the first.
  ContactSolution best;
  const auto attempt = [&](const Scaled& one, double dependence) {
    solve_one_by_one(one, dependence, p, solution.iterations);
    if (accept(p)) return true;
    if (best.impulse.size() == 0 || solution.error < best.error) best = solution;
    return false;
  };
  for (const double dependence : {0.0, 1e-12, 1e-10}) {
    if (attempt(scaled, dependence)) return solution;
  }
  for (const double delta : {1e-12, 1e-10, 1e-8}) {
    Scaled near = scaled;
    near.W.diagonal().array() += delta;
    p = best.impulse.cwiseQuotient(scale);
    for (int i = 0; i < 10; ++i) {
      near.rhs = scaled.rhs - delta * p;
      if (attempt(near, 0)) return solution;
    }
  }
  const ContactSolution other = solve_lawson_hanson(problem, options);
  return other.converged || other.error < best.error ? other : best;
}

}  // namespace nsframe
