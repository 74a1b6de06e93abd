// Impacts and sustained contact located in time (theory.md, 159-161).
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/decompositions.hpp"
#include "base/errors.hpp"
#include "contact/impact_law.hpp"
#include "integrators/event_flow.hpp"
#include "integrators/impact_rounds.hpp"

namespace nsframe {

namespace {

// An approach slower than this part of the fastest one so far ends an accumulation of impacts, if the bounce would rise by less than
// that part of what the gap is made of.
constexpr double slowest_approach = 1e-8, least_bounce = 1e-13;

// How far a gap opens that leaves with this rate under this acceleration [m].
double bounce(double rate, double acceleration) {
  return acceleration < 0 ? rate * rate / (-2 * acceleration) : rate == 0 ? 0 : std::numeric_limits<double>::infinity();
}

}  // namespace

double EventFlow::rate_noise(int pair) const { return 32 * machine_epsilon * modes_.gap_size.row(pair).dot(state_.y.cwiseAbs()); }

// 0 <= r, W r + rhs >= 0, complementary, on some pairs. The active ones are solved again with more digits: W of a heavy mass on a light one
// is nearly singular.
VectorX EventFlow::solve_forces(const System& system, const std::vector<int>& pairs, const VectorX& rhs, StepResult& result) const {
  const ContactProblem problem{modes_.delassus(pairs, pairs), rhs};
  ContactSolution solution = solve_active_set(problem, {options_.contact_tolerance, options_.max_contact_sweeps});
  result.complementarity_error = std::max(result.complementarity_error, solution.error);
  if (!solution.converged) {
    throw ConvergenceError(fmt::format("the contact problem did not converge (error {:.1e}), first pair {}", solution.error,
                                       system.contacts().pairs[static_cast<std::size_t>(pairs.front())].name));
  }
  if (solution.impulse.maxCoeff() <= 0) return solution.impulse;
  // of redundant pairs, all that may carry share the load by least squares, if none would have to pull
  std::vector<Eigen::Index> active;
  const VectorX left = problem.delassus * solution.impulse + rhs;
  const double zero = 1e-13 * rhs.cwiseAbs().maxCoeff();
  for (Eigen::Index i = 0; i < rhs.size(); ++i) {
    if (solution.impulse[i] > 0 || left[i] <= zero) active.push_back(i);
  }
  if (active.size() == 1) return solution.impulse;
  DenseMatrix<long double> G(static_cast<Eigen::Index>(active.size()), modes_.padded);
  DenseVector<long double> right(G.rows());
  for (Eigen::Index i = 0; i < G.rows(); ++i) {
    const Eigen::Index a = active[static_cast<std::size_t>(i)];
    const long double scale = 1 / std::sqrt(static_cast<long double>(problem.delassus(a, a)));
    G.row(i) = scale * modes_.gap.row(pairs[static_cast<std::size_t>(a)]).cast<long double>();
    right[i] = -scale * static_cast<long double>(rhs[a]);
  }
  const DenseVector<long double> scaled = RankRevealing<long double>(G * G.transpose(), 1e-14L).solve(right);
  if (scaled.minCoeff() < 0) return solution.impulse;
  for (Eigen::Index i = 0; i < G.rows(); ++i) {
    const Eigen::Index a = active[static_cast<std::size_t>(i)];
    solution.impulse[a] = static_cast<double>(scaled[i] / std::sqrt(static_cast<long double>(problem.delassus(a, a))));
  }
  return solution.impulse;
}

VectorX EventFlow::accelerations() const {
  VectorX modal = propagator_.accelerations(state_);
  if (!closed_pairs(true).empty()) modal += modes_.gap.transpose() * compliant_forces(contact_.constant + modes_.gap * state_.x);
  return modes_.gap * modal;
}

void EventFlow::collide(const System& system, double time, double remaining, StepResult& result) {
  if (contact_.closed.empty() && std::find(contact_.touching.begin(), contact_.touching.end(), true) == contact_.touching.end()) return;
  rate_ = modes_.gap * state_.y;
  collide_in_rounds(rate_, step_impulse_, result.accumulations, [&](bool last) { return collide_once(system, time, remaining, last, result); },
                    [&] { return 64 * machine_epsilon * largest_approach_; });
  settle(system, time, result);
  disturbed_ = true;
}

bool EventFlow::collide_once(const System& system, double time, double remaining, bool last, StepResult& result) {
  std::vector<int> pairs;
  bool closing = false;
  for (int c = 0; c < modes_.pairs(); ++c) {
    const auto i = static_cast<std::size_t>(c);
    if (modes_.compliant[i]) continue;
    const bool closed = std::binary_search(contact_.closed.begin(), contact_.closed.end(), c);
    const double noise = std::max(rate_noise(c), machine_epsilon * largest_approach_);
    if (!closed && (!contact_.touching[i] || (rate_[c] > noise && !last))) continue;
    pairs.push_back(c);
    closing = closing || rate_[c] < -noise;
  }
  if (!closing) return false;
  VectorX rhs(static_cast<Eigen::Index>(pairs.size()));
  double fastest = 0;
  for (const int c : pairs) fastest = std::max(fastest, -rate_[c]);
  largest_approach_ = std::max(largest_approach_, fastest);
  const VectorX pull = accelerations();
  VectorX restitution(rhs.size());
  std::vector<bool> ends(pairs.size(), false);
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    const int c = pairs[k];
    const double e = system.contacts().restitution[c], rise = bounce(e * rate_[c], pull[c]);
    const double size = std::abs(contact_.constant[c]) + modes_.gap_size.row(c).dot(state_.x.cwiseAbs());
    ends[k] = -rate_[c] < slowest_approach * largest_approach_ && rise <= least_bounce * size;
    if (ends[k] && rate_[c] < -rate_noise(c)) {
      ++result.accumulations.ended;
      result.accumulations.largest_bounce = std::max(result.accumulations.largest_bounce, rise);
    }
    restitution[static_cast<Eigen::Index>(k)] = last || ends[k] ? 0 : e;
    rhs[static_cast<Eigen::Index>(k)] = rate_[c];
  }
  const MatrixX W = modes_.delassus(pairs, pairs);
  const VectorX impulse =
      options_.impact_law == ImpactLaw::newton
          ? solve_forces(system, pairs, rhs + restitution.cwiseProduct(rhs), result)
          : poisson_impact(W, rhs, restitution, [&](const ContactProblem& one) {
              return solve_forces(system, pairs, one.rhs, result);
            }).impulse;
  const double least = machine_epsilon * impulse.maxCoeff();  // beside the largest, less is rounding
  VectorX change = VectorX::Zero(modes_.dofs);
  const VectorX before = rate_;
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    const double p = impulse[static_cast<Eigen::Index>(k)];
    if (!(p > least)) continue;
    state_.y += p * modes_.gap.row(pairs[k]).transpose();
    change += p * modes_.velocity_jump.col(pairs[k]);
  }
  rate_ = modes_.gap * state_.y;
  result.created += created_energy(W, impulse, before(pairs), rate_(pairs));
  const VectorX acceleration = accelerations();
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    const int c = pairs[k];
    const double p = impulse[static_cast<Eigen::Index>(k)];
    if (!(p > least)) continue;
    step_impulse_[c] += p;
    result.contact -= 0.5 * p * (before[c] + rate_[c]);
    // the rest of an accumulation: it would have ended after the sum of its ever shorter flights
    const double e = system.contacts().restitution[c];
    double rest = 0;
    if (ends[k] && e < 1 && acceleration[c] < 0) rest = -2 * e * before[c] / (-acceleration[c] * (1 - e));
    result.impacts.push_back({time + std::min(rest, remaining), c, -before[c], p, before[c], rate_[c]});
  }
  result.jumps.push_back({time, std::move(change)});
  return true;
}

void EventFlow::settle(const System& system, double time, StepResult& result) {
  std::vector<int> candidates, closed;
  for (int c = 0; c < modes_.pairs(); ++c) {
    const auto i = static_cast<std::size_t>(c);
    const bool was = std::binary_search(contact_.closed.begin(), contact_.closed.end(), c);
    if (modes_.compliant[i]) {
      if (was || (contact_.touching[i] && rate_[c] < 0)) closed.push_back(c);
    } else if ((was || contact_.touching[i]) && std::abs(rate_[c]) <= std::max(rate_noise(c), 1e-12 * largest_approach_)) {
      candidates.push_back(c);
    }
  }
  std::vector<int> springs = closed;
  std::swap(contact_.closed, springs);  // the acceleration is that under the springs alone
  const VectorX acceleration = accelerations();
  std::swap(contact_.closed, springs);
  if (!candidates.empty()) {
    const VectorX force = solve_forces(system, candidates, acceleration(candidates), result);
    const VectorX noise = sustained_.force_noise(state_, candidates);
    const double most = force.maxCoeff();
    for (std::size_t k = 0; k < candidates.size(); ++k) {
      const auto i = static_cast<Eigen::Index>(k);
      if (force[i] > std::max(1e-12 * most, noise[i])) closed.push_back(candidates[k]);
    }
  }
  std::sort(closed.begin(), closed.end());
  for (const int c : std::vector<int>(contact_.closed)) {
    if (!std::binary_search(closed.begin(), closed.end(), c)) end_contact(c, time, result);
  }
  contact_.closed = closed;
  for (const int c : closed) contact_.touching[static_cast<std::size_t>(c)] = false;
  remove_drift();
}

// Rounding, and what the collocation leaves, in the gaps and rates of sustained contacts without compliance.
void EventFlow::remove_drift() {
  const std::vector<int> rigid = closed_pairs(false);
  if (rigid.empty()) return;
  const VectorX scale = modes_.delassus.diagonal()(rigid).cwiseSqrt().cwiseInverse();
  const RankRevealing<double> factor(scale.asDiagonal() * modes_.delassus(rigid, rigid) * scale.asDiagonal(), 1e-12);
  const VectorX gap = modes_.gap * state_.x + contact_.constant, rate = modes_.gap * state_.y;
  const VectorX x = factor.solve(scale.cwiseProduct(VectorX(gap(rigid))).eval()),
                y = factor.solve(scale.cwiseProduct(VectorX(rate(rigid))).eval());
  for (std::size_t k = 0; k < rigid.size(); ++k) {
    const auto i = static_cast<Eigen::Index>(k);
    state_.x -= x[i] * scale[i] * modes_.gap.row(rigid[k]).transpose();
    state_.y -= y[i] * scale[i] * modes_.gap.row(rigid[k]).transpose();
  }
}

void EventFlow::end_contact(int pair, double time, StepResult& result) {
  std::erase(contact_.closed, pair);
  contact_.touching[static_cast<std::size_t>(pair)] = true;
  const double impulse = contact_impulse_[pair];
  contact_impulse_[pair] = 0;
  if (!(impulse > 0)) return;
  result.impacts.push_back({time, pair, 0, impulse, 0, 0});
}

}  // namespace nsframe
