#include "integrators/force_problem.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/decompositions.hpp"

namespace nsframe {

namespace {

constexpr double jump_slope = 1e10;  // of a jump that is not used up, over 1 / compliance
constexpr int most_bisections = 200;

}  // namespace

double ForcePair::parting_rate() const { return (-gap / (theta * h) - (1 - theta) * rate) / theta; }

double ForcePair::impulse(double w) const {
  const double penetration = mid_penetration(w);
  return penetration > 0 ? h * law->force(stiffness, damping, penetration, -mid_rate(w), approach).value : 0;
}

double ForcePair::slope(double w) const {
  const double penetration = mid_penetration(w);
  if (!(penetration > 0)) return 0;
  const ContactForce force = law->force(stiffness, damping, penetration, -mid_rate(w), approach);
  return h * theta * (theta * h * force.by_penetration + force.by_rate);
}

ForcePair::Solution ForcePair::solve(double free, double compliance) const {
  const double parting = parting_rate();
  const double at_parting = h * law->force(stiffness, damping, 0, gap / (theta * h), approach).value;
  double low = free + compliance * at_parting, high = parting;
  if (!(low < high)) {
    if (free >= parting) return {};
    return {(parting - free) / compliance, jump_slope / compliance};
  }
  // w - free - compliance p(w) rises from not above 0 at `low` to above 0 at `high`
  double w = low;
  for (int i = 0; i < most_bisections; ++i) {
    const double left = w - free - compliance * impulse(w);
    if (left == 0) break;
    (left < 0 ? low : high) = w;
    double next = w - left / (1 + compliance * slope(w));
    if (!(next > low && next < high) || i > 20) next = 0.5 * (low + high);
    const double least = 2 * machine_epsilon * std::max(std::abs(low), std::abs(high));
    if (std::abs(next - w) <= least || high - low <= least) break;
    w = next;
  }
  return {(w - free) / compliance, slope(w)};
}

namespace {

// What every pair would answer to the impulses of the others, and by how much that changes the rates.
class Answers {
 public:
  explicit Answers(const ForceProblem& problem) : problem_(problem), solutions_(problem.pairs.size()) {}

  // Largest change of a rate by a pair's own answer [m/s].
  double find(const VectorX& p) {
    const VectorX w = problem_.free + problem_.delassus * p;
    double largest = 0;
    for (Eigen::Index a = 0; a < p.size(); ++a) {
      solutions_[static_cast<std::size_t>(a)] = answer(a, w[a], p[a]);
      largest = std::max(largest, std::abs(at(a).impulse - p[a]) * problem_.delassus(a, a));
    }
    return largest;
  }

  void sweep(VectorX& p) {
    for (Eigen::Index a = 0; a < p.size(); ++a) p[a] = answer(a, problem_.free[a] + problem_.delassus.row(a).dot(p), p[a]).impulse;
  }

  // p - answer(p) = 0 linearised at the p of the last find().
  VectorX newton(const VectorX& p) const {
    const Eigen::Index n = p.size();
    MatrixX A = MatrixX::Identity(n, n);
    VectorX rhs(n);
    for (Eigen::Index a = 0; a < n; ++a) {
      const double yielding = at(a).slope / (1 + at(a).slope * problem_.delassus(a, a));
      for (Eigen::Index b = 0; b < n; ++b) {
        if (b != a) A(a, b) = yielding * problem_.delassus(a, b);
      }
      rhs[a] = at(a).impulse - p[a];
    }
    return p + VectorX(Eigen::PartialPivLU<MatrixX>(A).solve(rhs));
  }

  void take(Answers& other) { std::swap(solutions_, other.solutions_); }
  const ForcePair::Solution& at(Eigen::Index a) const { return solutions_[static_cast<std::size_t>(a)]; }

 private:
  ForcePair::Solution answer(Eigen::Index a, double rate, double own) const {
    const double compliance = problem_.delassus(a, a);
    return problem_.pairs[static_cast<std::size_t>(a)].solve(rate - compliance * own, compliance);
  }

  const ForceProblem& problem_;
  std::vector<ForcePair::Solution> solutions_;
};

}  // namespace

ForceSolution solve_forces(const ForceProblem& problem, const ContactOptions& options, VectorX guess) {
  ForceSolution solution;
  VectorX& p = solution.impulse = std::move(guess);
  const Eigen::Index n = p.size();
  Answers answers(problem), trial_answers(problem);
  double scale = std::numeric_limits<double>::min();
  for (Eigen::Index a = 0; a < n; ++a) {
    scale = std::max({scale, std::abs(problem.free[a]), std::abs(problem.pairs[static_cast<std::size_t>(a)].rate)});
  }
  double change = answers.find(p);
  for (solution.iterations = 0; solution.iterations < options.max_iterations; ++solution.iterations) {
    const double rounding = 16 * static_cast<double>(n) * machine_epsilon * (problem.delassus.cwiseAbs() * p.cwiseAbs()).maxCoeff();
    solution.error = change / scale;
    solution.converged = change <= options.tolerance * scale + rounding;
    if (solution.converged) break;
    const VectorX trial = answers.newton(p);
    const double trial_change = trial.allFinite() ? trial_answers.find(trial) : std::numeric_limits<double>::infinity();
    if (trial_change < 0.9 * change) {
      p = trial;
      answers.take(trial_answers);
      change = trial_change;
    } else {
      answers.sweep(p);
      change = answers.find(p);
    }
  }
  solution.slope.resize(n);
  for (Eigen::Index a = 0; a < n; ++a) {
    p[a] = answers.at(a).impulse;
    solution.slope[a] = answers.at(a).slope;
  }
  return solution;
}

}  // namespace nsframe
