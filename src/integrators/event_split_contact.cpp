// Impacts and sustained contact of the scheme `event-split` (theory.md, 296-299).
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/errors.hpp"
#include "contact/contact_problem.hpp"
#include "integrators/event_split.hpp"

namespace nsframe {

namespace {

constexpr int most_rounds = 1000;      // impacts at one time one after another; then all touching pairs end them plastically
constexpr double shortest_tail = 0.1;  // of the step: ever faster bounces that end within it are one plastic impact

}  // namespace

VectorX EventSplit::solve_forces(const System& system, const MatrixX& W, const std::vector<int>& pairs, const VectorX& rhs, StepResult& result) const {
  const ContactSolution solution = solve_active_set({W, rhs}, {options_.contact_tolerance, options_.max_contact_sweeps});
  result.complementarity_error = std::max(result.complementarity_error, solution.error);
  if (!solution.converged) {
    throw ConvergenceError(fmt::format("the contact problem did not converge (error {:.1e}), first pair {}", solution.error,
                                       system.contacts().pairs[static_cast<std::size_t>(pairs.front())].name));
  }
  return solution.impulse;
}

void EventSplit::collide(const System& system, double time, double remaining, StepResult& result) {
  for (int round = 0; round <= most_rounds; ++round) {
    const bool last = round == most_rounds;
    if (!collide_once(system, time, remaining, last, result)) break;
    if (last) ++result.accumulations.plastic;
  }
  settle(system, time, remaining, result);
}

std::vector<int> EventSplit::accumulating(const System& system, const std::vector<int>& pairs) const {
  std::vector<int> found;
  for (const int c : pairs) {
    if (is_closed(c) || !(rate_[c] > rate_tolerance(c))) continue;
    const double e = system.contacts().restitution[c];
    // the flow returns after -c1 / c2, and all further bounces take 1 / (1 - e) times as long
    const bool returns = rate2_[c] < 0 && -rate1_[c] >= rate2_[c] * shortest_tail * step_length_ * (1 - e);
    if (rate1_[c] <= 0 || returns) found.push_back(c);
  }
  return found;
}

bool EventSplit::collide_once(const System& system, double time, double remaining, bool last, StepResult& result) {
  const Contacts& contacts = system.contacts();
  std::vector<int> pairs;
  bool closing = false;
  for (int c = 0; c < contacts.size(); ++c) {
    if (impact_.compliant(c)) continue;
    const bool closed = is_closed(c);
    if (!closed && (!touching_[static_cast<std::size_t>(c)] || (rate_[c] > rate_tolerance(c) && !last))) continue;
    pairs.push_back(c);
    closing = closing || rate_[c] < -rate_tolerance(c);
  }
  if (!closing) return false;
  for (const int c : pairs) largest_approach_ = std::max(largest_approach_, -rate_[c]);
  const MatrixX W = impact_.delassus(contacts, pairs);
  const VectorX before = rate_, velocity = v_;
  std::vector<int> plastic;
  VectorX impulse, change;
  for (;;) {
    VectorX rhs(static_cast<Eigen::Index>(pairs.size()));
    for (std::size_t k = 0; k < pairs.size(); ++k) {
      const int c = pairs[k];
      const bool stops = last || is_closed(c) || std::binary_search(plastic.begin(), plastic.end(), c);
      rhs[static_cast<Eigen::Index>(k)] = (1 + (stops ? 0 : contacts.restitution[c])) * before[c];
    }
    impulse = solve_forces(system, W, pairs, rhs, result);
    change.setZero(v_.size());
    for (std::size_t k = 0; k < pairs.size(); ++k) {
      const double p = impulse[static_cast<Eigen::Index>(k)];
      if (p > 0) change += p * impact_.jump(contacts, pairs[k]);
    }
    v_ = velocity + change;
    rate_ = contacts.jacobian * v_;
    begin_flow(system, time, remaining, {});
    const std::vector<int> more = accumulating(system, pairs);
    if (more.empty() || last) break;
    result.accumulations.ended += static_cast<long>(more.size());
    plastic.insert(plastic.end(), more.begin(), more.end());
    std::sort(plastic.begin(), plastic.end());
  }
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    const int c = pairs[k];
    const double p = impulse[static_cast<Eigen::Index>(k)];
    if (p <= 0) continue;
    step_impulse_[c] += p;
    result.contact -= 0.5 * p * (before[c] + rate_[c]);
    result.impacts.push_back({time, c, -before[c], p, before[c], rate_[c]});
  }
  result.jumps.push_back({time, std::move(change)});
  return true;
}

void EventSplit::settle(const System& system, double time, double remaining, StepResult& result) {
  const Contacts& contacts = system.contacts();
  std::vector<int> candidates, closed;
  for (int c = 0; c < contacts.size(); ++c) {
    const bool was = is_closed(c), touches = touching_[static_cast<std::size_t>(c)];
    if (!was && !touches) continue;
    if (impact_.compliant(c) || std::abs(rate_[c]) <= rate_tolerance(c)) candidates.push_back(c);
  }
  if (!candidates.empty()) {
    begin_flow(system, time, remaining, {});
    const auto count = static_cast<Eigen::Index>(candidates.size());
    // constant forces that keep the gaps open at the end of the step
    MatrixX W(count, count);
    VectorX rhs(count);
    for (Eigen::Index b = 0; b < count; ++b) {
      const int c = candidates[static_cast<std::size_t>(b)];
      rhs[b] = (rate1_[c] + remaining * (rate2_[c] + remaining * rate3_[c])) / (options_.theta * remaining);
      const VectorX& response = matrix_.response(contacts, c);
      for (Eigen::Index a = 0; a < count; ++a) W(a, b) = contacts.jacobian.row(candidates[static_cast<std::size_t>(a)]).dot(response);
    }
    const VectorX force = solve_forces(system, W, candidates, rhs, result);
    const double most = force.maxCoeff();
    for (Eigen::Index k = 0; k < count; ++k) {
      if (force[k] > 1e-12 * most) closed.push_back(candidates[static_cast<std::size_t>(k)]);
    }
  }
  for (const int c : std::vector<int>(closed_)) {
    if (!std::binary_search(closed.begin(), closed.end(), c)) end_contact(c, time, result);
  }
  closed_ = closed;
  for (const int c : closed_) touching_[static_cast<std::size_t>(c)] = false;
  if (!closed_.empty()) remove_drift(system);
}

void EventSplit::remove_drift(const System& system) {
  std::vector<int> rigid;
  for (const int c : closed_) {
    if (!impact_.compliant(c)) rigid.push_back(c);
  }
  if (rigid.empty()) return;
  const Contacts& contacts = system.contacts();
  const MatrixX W = impact_.delassus(contacts, rigid);
  const VectorX scale = W.diagonal().cwiseSqrt().cwiseInverse();
  Eigen::CompleteOrthogonalDecomposition<MatrixX> factor;
  factor.setThreshold(1e-12);
  factor.compute(scale.asDiagonal() * W * scale.asDiagonal());
  find_gaps(system);
  const VectorX gap = scale.cwiseProduct(VectorX(gap_(rigid))), rate = scale.cwiseProduct(VectorX(rate_(rigid)));
  const VectorX x = scale.cwiseProduct(VectorX(factor.solve(gap))), y = scale.cwiseProduct(VectorX(factor.solve(rate)));
  for (std::size_t k = 0; k < rigid.size(); ++k) {
    const VectorX& jump = impact_.jump(contacts, rigid[k]);
    q_ -= x[static_cast<Eigen::Index>(k)] * jump;
    v_ -= y[static_cast<Eigen::Index>(k)] * jump;
  }
  find_gaps(system);
}

void EventSplit::end_contact(int pair, double time, StepResult& result) {
  std::erase(closed_, pair);
  touching_[static_cast<std::size_t>(pair)] = true;
  const double impulse = contact_impulse_[pair];
  contact_impulse_[pair] = 0;
  if (impulse > 0) result.impacts.push_back({time, pair, 0, impulse, 0, 0});
}

}  // namespace nsframe
