#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "base/decompositions.hpp"
#include "contact/active_cholesky.hpp"
#include "contact/contact_problem.hpp"
#include "contact/profile_matrix.hpp"

namespace nsframe {

namespace {

// Sets from which on all wrong pairs change at once; below, one by one is as fast.
constexpr Eigen::Index large = 16;
constexpr double symmetry = 1e-12;  // of W with unit diagonal
// Share of W's entries in its profile below which it is factored by that.
constexpr double profile_share = 0.5;

// Of sums over so many pairs, relative to the sum of magnitudes.
double rounding_of(Eigen::Index pairs) { return 4 * static_cast<double>(pairs) * machine_epsilon; }

// W with unit diagonal, so that pairs between heavy and between light bodies weigh the same.
struct Scaled {
  MatrixX W;
  VectorX rhs;

  // What rounding leaves of W p + rhs, row by row.
  VectorX rounding(const VectorX& p) const {
    return rounding_of(rhs.size()) * (W.cwiseAbs().lazyProduct(p) + rhs.cwiseAbs());
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

// x = W_AA^-1 rhs_A by a factor of its profile, or a dense one; nothing when W_AA is close to singular.
class SetSolver {
 public:
  explicit SetSolver(const ProfileMatrix& W) : W_(W), narrow_(W.share() < profile_share) {}

  bool factor(const std::vector<int>& set) {
    const double least = 1e-10;
    if (narrow_) return profile_.compute(W_, set, least);
    const auto k = static_cast<Eigen::Index>(set.size());
    among_.resize(k, k);
    for (Eigen::Index j = 0; j < k; ++j) W_.gather(set[static_cast<std::size_t>(j)], set, among_.col(j).data());
    dense_.compute(among_);
    return dense_.info() == Eigen::Success && dense_.matrixLLT().diagonal().minCoeff() > std::sqrt(least);
  }
  void solve(VectorX& x) const {
    if (narrow_) return profile_.solve(x);
    x = dense_.solve(x);
  }

 private:
  const ProfileMatrix& W_;
  bool narrow_;
  ProfileFactor profile_;
  MatrixX among_;
  Eigen::LLT<MatrixX> dense_;
};

// All pairs whose impulse or rate is negative change sides at once (semismooth Newton on min(p, W p + rhs)). False when that
// runs in circles or meets a set that is close to singular. Vectors in the order of W; `rate` and `size`: W p + rhs and |W| |p| + |rhs|.
bool solve_all_at_once(const ProfileMatrix& W, const VectorX& rhs, const VectorX& guess, VectorX& p, VectorX& rate, VectorX& size, int& iterations) {
  const int n = W.rows();
  SetSolver solver(W);
  std::vector<int> set, next;
  for (int i = 0; i < n; ++i) {
    if (guess.size() == n ? guess[i] > 0 : rhs[i] < 0) set.push_back(i);
  }
  const auto find_rates = [&] {
    W.multiply(p, rate, size);
    rate += rhs;
    size += rhs.cwiseAbs();
  };
  const int limit = 30;
  const double noise = rounding_of(n);
  for (iterations = 1; iterations <= limit; ++iterations) {
    p.setZero(n);
    if (!set.empty()) {
      if (!solver.factor(set)) return false;
      VectorX inside = -rhs(set);
      solver.solve(inside);
      p(set) = inside;
      find_rates();
      inside = rate(set);  // what rounding left
      solver.solve(inside);
      p(set) -= inside;
    }
    find_rates();
    next.clear();
    bool same = true;
    std::size_t at = 0;
    for (int i = 0; i < n; ++i) {
      const bool inside = at < set.size() && set[at] == i;
      if (inside) ++at;
      const bool wanted = inside ? p[i] >= -noise * size[i] : rate[i] < -noise * size[i];
      if (wanted) next.push_back(i);
      same = same && wanted == inside;
    }
    if (same) return true;
    std::swap(set, next);
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

bool symmetric(const MatrixX& W) { return (W - W.transpose()).cwiseAbs().maxCoeff() <= symmetry; }

// Not converged where it is not for this method: an unsymmetric W, one that is close to singular on the set it tries, redundant pairs that
// are to share their impulses.
ContactSolution solve_large(const ContactProblem& problem, const ContactOptions& options, const VectorX& guess) {
  const VectorX scale = problem.delassus.diagonal().cwiseSqrt().cwiseInverse();
  const ProfileMatrix W(problem.delassus, scale, 0.1 * machine_epsilon);
  ContactSolution solution;
  if (!W.symmetric(symmetry)) return solution;
  const std::vector<int>& order = W.order();
  const VectorX rhs = scale.cwiseProduct(problem.rhs)(order);
  VectorX ordered_guess, p, rate, size;
  if (guess.size() == problem.rhs.size()) ordered_guess = guess(order);
  if (!solve_all_at_once(W, rhs, ordered_guess, p, rate, size, solution.iterations)) return solution;
  const double noise = rounding_of(W.rows());
  const VectorX ordered_scale = scale(order);
  double error = 0, rates = 0;
  solution.impulse.resize(problem.rhs.size());
  for (Eigen::Index i = 0; i < p.size(); ++i) {
    const double impulse = std::max(p[i], 0.0);
    if (impulse == 0 && std::abs(rate[i]) <= 16 * noise * size[i]) return solution;  // at rest without impulse
    error = std::max(error, std::abs(std::min(impulse, rate[i])) / ordered_scale[i]);
    rates = std::max(rates, size[i] / ordered_scale[i]);
    solution.impulse[order[static_cast<std::size_t>(i)]] = ordered_scale[i] * impulse;
  }
  const double largest = std::max(problem.rhs.cwiseAbs().maxCoeff(), std::numeric_limits<double>::min());
  solution.error = error / largest;
  solution.converged = solution.error <= std::max(options.tolerance, 16 * static_cast<double>(W.rows()) * machine_epsilon * rates / largest);
  return solution;
}

// One pair alone.
ContactSolution solve_single(const ContactProblem& problem) {
  ContactSolution solution;
  solution.impulse = (-problem.rhs / problem.delassus(0, 0)).cwiseMax(0.0);
  solution.iterations = 1;
  solution.error = complementarity_error(problem, solution.impulse);
  solution.converged = std::isfinite(solution.impulse[0]);
  return solution;
}

}  // namespace

ContactSolution solve_active_set(const ContactProblem& problem, const ContactOptions& options, const VectorX& guess) {
  const Eigen::Index n = problem.rhs.size();
  if (n == 0) return {VectorX(0), 0, 0, true};
  if (n == 1 && problem.delassus(0, 0) > 0) return solve_single(problem);
  if (n >= large) {
    const ContactSolution solution = solve_large(problem, options, guess);
    if (solution.converged) return solution;
  }
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
