// Impacts and sustained contact of the scheme `event-split` (theory.md, 295-297).
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/errors.hpp"
#include "contact/contact_problem.hpp"
#include "contact/impact_law.hpp"
#include "integrators/event_split.hpp"
#include "integrators/impact_rounds.hpp"

namespace nsframe {

namespace {

constexpr double shortest_tail = 0.1;  // of the longest part: ever faster bounces that end within it are one plastic impact

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

const EventSplit::Contact& EventSplit::contact(const System& system, int pair) {
  if (contacts_factored_ != parts_.matrix.factorizations()) {
    contacts_.assign(static_cast<std::size_t>(system.contacts().size()), {});
    contacts_factored_ = parts_.matrix.factorizations();
    delassus_.setConstant(system.contacts().size(), system.contacts().size(), std::numeric_limits<double>::quiet_NaN());
  }
  Contact& cached = contacts_[static_cast<std::size_t>(pair)];
  if (cached.momentum.size() > 0) return cached;
  const auto momentum = [&](const VectorX& velocity) {
    VectorX result = system.mass() * velocity;
    system.damping.add_force(system.assembler.blocks(), flow_.rule().theta * part_length_, velocity, result);
    return result;
  };
  const VectorX once = momentum(parts_.matrix.response(system.contacts(), pair).vector());
  VectorX again;
  parts_.matrix.solve(once, again);
  cached.second_rates = system.contacts().jacobian * again;
  cached.momentum = 2 * once - momentum(again);
  cached.jump = impact_.velocity_change(cached.momentum);
  return cached;
}

MatrixX EventSplit::delassus(const System& system, const std::vector<int>& pairs) {
  for (const int c : pairs) contact(system, c);
  for (const int b : pairs) {
    for (const int a : pairs) {
      double& value = delassus_(a, b);
      if (std::isnan(value)) value = contact(system, a).momentum.dot(contact(system, b).jump);
    }
  }
  return delassus_(pairs, pairs);
}

MatrixX EventSplit::opening(const System& system, const std::vector<int>& pairs, double s) {
  const auto count = static_cast<Eigen::Index>(pairs.size());
  MatrixX first(count, count), second(count, count);
  for (Eigen::Index b = 0; b < count; ++b) {
    const int pair = pairs[static_cast<std::size_t>(b)];
    first.col(b) = parts_.matrix.rates_by(system.contacts(), pair)(pairs);
    second.col(b) = contact(system, pair).second_rates(pairs);
  }
  const auto [once, again] = flow_.response(s);
  return s * s * (once * first - again * second);
}

void EventSplit::collide(const System& system, double time, double remaining, StepResult& result) {
  for (int c = 0; c < system.contacts().size(); ++c) {
    if (is_closed(c) || touching_[static_cast<std::size_t>(c)]) rate_[c] = contact(system, c).momentum.dot(now_.v);
  }
  collide_in_rounds(rate_, step_impulse_, result.accumulations, [&](bool last) { return collide_once(system, time, remaining, last, result); },
                    [&] { return rate_tolerance(); });
  settle(system, time, remaining, result);
}

std::vector<int> EventSplit::accumulating(const System& system, const std::vector<int>& pairs) const {
  std::vector<int> found;
  for (const int c : pairs) {
    if (is_closed(c) || !(rate_[c] > rate_tolerance())) continue;
    const double e = system.contacts().restitution[c];
    // the flow returns after -c1 / c2, and all further bounces take 1 / (1 - e) times as long
    if (path_(c, 1) < 0 && path_(c, 0) <= -path_(c, 1) * shortest_tail * part_length_ * (1 - e)) found.push_back(c);
  }
  return found;
}

bool EventSplit::collide_once(const System& system, double time, double remaining, bool last, StepResult& result) {
  std::vector<int> pairs;
  bool closing = false;
  const double still = rate_tolerance();
  for (int c = 0; c < system.contacts().size(); ++c) {
    if (impact_.compliant(c)) continue;
    const bool closed = is_closed(c);
    if (!closed && (!touching_[static_cast<std::size_t>(c)] || (rate_[c] > still && !last))) continue;
    pairs.push_back(c);
    closing = closing || rate_[c] < -still;
  }
  if (!closing) return false;
  const auto count = static_cast<Eigen::Index>(pairs.size());
  const MatrixX W = delassus(system, pairs);
  for (const int c : pairs) largest_approach_ = std::max(largest_approach_, -rate_[c]);
  const VectorX before = rate_(pairs), velocity = now_.v;
  std::vector<bool> plastic(pairs.size(), last);
  for (std::size_t k = 0; k < pairs.size(); ++k) plastic[k] = plastic[k] || is_closed(pairs[k]);
  VectorX impulse, change, restitution(count);
  for (;;) {
    for (Eigen::Index k = 0; k < count; ++k) {
      const auto i = static_cast<std::size_t>(k);
      restitution[k] = plastic[i] ? 0 : system.contacts().restitution[pairs[i]];
    }
    impulse = options_.impact_law == ImpactLaw::newton
                  ? solve_forces(system, W, pairs, before + restitution.cwiseProduct(before), result)
                  : poisson_impact(W, before, restitution, [&](const ContactProblem& p) { return solve_forces(system, W, pairs, p.rhs, result); }).impulse;
    change.setZero(now_.v.size());
    for (Eigen::Index k = 0; k < count; ++k) {
      if (impulse[k] > 0) change += impulse[k] * contact(system, pairs[static_cast<std::size_t>(k)]).jump;
    }
    now_.v = velocity + change;
    rate_(pairs) = before + W * impulse;
    begin_flow(system, time, remaining, {});
    const std::vector<int> more = last ? std::vector<int>() : accumulating(system, pairs);
    if (more.empty()) break;
    result.accumulations.ended += static_cast<long>(more.size());
    for (std::size_t k = 0; k < pairs.size(); ++k) plastic[k] = plastic[k] || std::binary_search(more.begin(), more.end(), pairs[k]);
  }
  result.created += created_energy(W, impulse, before, rate_(pairs));
  for (int c = 0; c < system.contacts().size(); ++c) {  // pairs that were leaving may close now
    const bool struck = std::binary_search(pairs.begin(), pairs.end(), c);
    if (touching_[static_cast<std::size_t>(c)] && !struck) rate_[c] = contact(system, c).momentum.dot(now_.v);
  }
  result.contact -= change.dot(system.mass() * (velocity + 0.5 * change));
  for (Eigen::Index k = 0; k < count; ++k) {
    if (!(impulse[k] > 0)) continue;
    const int c = pairs[static_cast<std::size_t>(k)];
    step_impulse_[c] += impulse[k];
    result.impacts.push_back({time, c, -before[k], impulse[k], before[k], rate_[c]});
  }
  result.jumps.push_back({time, std::move(change)});
  return true;
}

void EventSplit::settle(const System& system, double time, double remaining, StepResult& result) {
  std::vector<int> candidates, closed;
  begin_flow(system, time, remaining, {});
  for (int c = 0; c < system.contacts().size(); ++c) {
    const bool slow = impact_.compliant(c) || std::abs(rate_[c]) <= rate_tolerance() || path_(c, 0) <= 0;
    if (is_closed(c) || (touching_[static_cast<std::size_t>(c)] && slow)) candidates.push_back(c);
  }
  if (!candidates.empty()) {
    const auto count = static_cast<Eigen::Index>(candidates.size());
    // constant forces that keep the gaps open from now on
    const double s = look_ahead(remaining);
    VectorX rhs(count);
    for (Eigen::Index b = 0; b < count; ++b) {
      const int c = candidates[static_cast<std::size_t>(b)];
      rhs[b] = s * (path_(c, 0) + s * (path_(c, 1) + s * (path_(c, 2) + s * path_(c, 3))));
    }
    const VectorX force = solve_forces(system, opening(system, candidates, s), candidates, rhs, result);
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
  remove_drift(system);
}

// Rounding in the gaps of sustained contacts.
void EventSplit::remove_drift(const System& system) {
  if (closed_.empty()) return;
  flow_.held().hold(system.contacts(), closed_);
  flow_.held().close_gaps(VectorX(gap_(closed_)), now_.q);
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
