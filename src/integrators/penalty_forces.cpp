#include "integrators/penalty_forces.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/decompositions.hpp"
#include "base/errors.hpp"
#include "integrators/contact_bodies.hpp"

namespace nsframe {

namespace {

constexpr double reach = 2;               // steps of its approach within which an open pair takes part
constexpr int most_alternations = 50;     // between forces and impulses

constexpr Eigen::Index episode_size = sizeof(ContactEpisode) / sizeof(double);

ContactEpisode episode(const State& state, std::size_t place) {
  const double* const v = state.contact_episodes.data() + episode_size * static_cast<Eigen::Index>(place);
  return {v[0], v[1], v[2], v[3]};
}

void put(State& state, std::size_t place, const ContactEpisode& e) {
  const auto at = episode_size * static_cast<Eigen::Index>(place);
  state.contact_episodes.segment<episode_size>(at) << e.touches, e.start, e.rate_before, e.impulse;
}

Impact ended_contact(const ContactEpisode& e, int pair, double time, double rate_after) {
  return {time, pair, -e.rate_before, e.impulse, e.rate_before, rate_after, time - e.start};
}

const std::string& name(const Contacts& contacts, int pair) { return contacts.pairs[static_cast<std::size_t>(pair)].name; }

ForcePair force_pair(const System& system, int pair) {
  const Contacts& contacts = system.contacts();
  const ContactLawChoice& choice = contacts.pairs[static_cast<std::size_t>(pair)].law;
  ForcePair out;
  out.pair = pair;
  out.law = contact_force_law(choice.name);
  if (choice.stiffness) out.stiffness = *choice.stiffness;
  if (choice.hertz_stiffness) out.stiffness = *choice.hertz_stiffness;
  if (choice.stiffness_ratio) {
    const double body = stiffer_body(system, pair);
    if (!(body > 0)) {
      throw InputError(fmt::format("error: contact pair '{}': stiffness_ratio is over the stiffness of the stiffer body, and both may move "
                                   "freely or are fixed; give stiffness",
                                   name(contacts, pair)));
    }
    out.stiffness = *choice.stiffness_ratio * body;
  }
  const double xi = choice.damping_ratio.value_or(contacts.restitution[pair] < 1 ? 1 : 0);
  double mass = choice.effective_mass.value_or(0);
  if (out.law->has_damping_ratio && xi > 0 && mass == 0) {
    mass = effective_mass(system, pair);
    if (!(mass > 0)) {
      throw InputError(fmt::format("error: contact pair '{}' meets DOFs without mass: its damping needs effective_mass",
                                   name(contacts, pair)));
    }
  }
  out.damping = damping_constant(*out.law, out.stiffness, mass, contacts.restitution[pair], choice.damping_ratio);
  return out;
}

}  // namespace

VectorX no_contact_episodes(const Contacts& contacts) {
  const auto& pairs = contacts.pairs;
  const auto forces = std::count_if(pairs.begin(), pairs.end(), [](const ContactPair& pair) { return pair.law.is_force(); });
  return VectorX::Zero(episode_size * forces);
}

PenaltyForces::PenaltyForces(const System& system) {
  const Contacts& contacts = system.contacts();
  for (int pair = 0; pair < contacts.size(); ++pair) {
    const bool force = contacts.pairs[static_cast<std::size_t>(pair)].law.is_force();
    place_of_.push_back(force ? static_cast<int>(laws_.size()) : -1);
    if (force) laws_.push_back(force_pair(system, pair));
  }
}

void PenaltyForces::start_step(const Contacts& contacts, const State& committed, const VectorX& gap, const VectorX& rate, double h,
                               double theta) {
  problem_.pairs.clear();
  begins_.clear();
  for (std::size_t k = 0; k < laws_.size(); ++k) {
    ForcePair pair = laws_[k];
    pair.gap = gap[pair.pair];
    pair.rate = rate[pair.pair];
    pair.h = h;
    pair.theta = theta;
    const ContactEpisode now = episode(committed, k);
    if (pair.gap + reach * h * std::min(pair.rate, 0.0) > 0 && now.touches == 0) continue;
    ContactEpisode begins = now;
    if (now.touches == 0) {  // where the gap is zero, in this step or after the last theta point; the last acceleration gives the rate
      double flight = pair.rate < 0 ? pair.gap / -pair.rate : 0;
      if (std::abs(flight) > h) flight = 0;
      begins = {1, committed.time + flight, pair.rate + flight * contacts.jacobian.row(pair.pair).dot(committed.acceleration), 0};
    }
    pair.approach = -begins.rate_before;
    problem_.pairs.push_back(pair);
    begins_.push_back(begins);
  }
  restart();
}

void PenaltyForces::add_velocity(const Contacts& contacts, IterationMatrix& matrix, double factor, VectorX& velocity) const {
  for (std::size_t a = 0; a < problem_.pairs.size(); ++a) {
    const double p = impulse_[static_cast<Eigen::Index>(a)];
    if (p != 0) matrix.response(contacts, problem_.pairs[a].pair).add_to(factor * p, velocity);
  }
}

void PenaltyForces::subtract_impulses(const Contacts& contacts, VectorX& residual) const {
  for (std::size_t a = 0; a < problem_.pairs.size(); ++a) {
    residual -= impulse_[static_cast<Eigen::Index>(a)] * contacts.jacobian.row(problem_.pairs[a].pair).transpose();
  }
}

void PenaltyForces::solve_own(const ContactOptions& options, const Contacts& contacts, VectorX& slope) {
  ForceSolution solution = solve_forces(problem_, options, impulse_);
  if (!solution.converged) {
    throw ConvergenceError(fmt::format("the contact forces did not converge (error {:.1e} after {} iterations), first pair {}",
                                       solution.error, solution.iterations, name(contacts, problem_.pairs.front().pair)));
  }
  impulse_ = std::move(solution.impulse);
  slope = std::move(solution.slope);
}

ContactSolution PenaltyForces::solve(const Contacts& contacts, IterationMatrix& matrix, const VectorX& velocity,
                                     const std::vector<int>& others, const ContactProblem& problem, VectorX guess,
                                     const ContactOptions& options, const ImpulseSolver& solve_others) {
  const auto own = static_cast<Eigen::Index>(problem_.pairs.size()), count = static_cast<Eigen::Index>(others.size());
  MatrixX of_others(own, count), on_others(count, own);  // rates of one kind by impulses of the other
  problem_.delassus.resize(own, own);
  VectorX free(own);
  for (Eigen::Index a = 0; a < own; ++a) {
    const int pair = problem_.pairs[static_cast<std::size_t>(a)].pair;
    free[a] = contacts.jacobian.row(pair).dot(velocity);
    for (Eigen::Index b = 0; b < own; ++b) {
      problem_.delassus(a, b) = matrix.rates_by(contacts, problem_.pairs[static_cast<std::size_t>(b)].pair)[pair];
    }
    for (Eigen::Index b = 0; b < count; ++b) {
      const int other = others[static_cast<std::size_t>(b)];
      of_others(a, b) = matrix.rates_by(contacts, other)[pair];
      on_others(b, a) = matrix.rates_by(contacts, pair)[other];
    }
  }
  problem_.free = free;
  VectorX slope;
  if (count == 0) {
    solve_own(options, contacts, slope);
    return {VectorX(0), 0, 0, true};
  }
  ContactSolution solution;
  solution.impulse = std::move(guess);
  for (int i = 0; i < most_alternations; ++i) {
    problem_.free = free + of_others * solution.impulse;
    solve_own(options, contacts, slope);
    // dp = -yielding of_others dp_others of the forces: (I + S W) yielding = S with their slopes S
    const MatrixX system = MatrixX::Identity(own, own) + slope.asDiagonal() * problem_.delassus;
    const MatrixX yielding = Eigen::PartialPivLU<MatrixX>(system).solve(MatrixX(slope.asDiagonal()));
    const MatrixX back = on_others * yielding * of_others;
    const ContactProblem condensed{problem.delassus - back, problem.rhs + on_others * impulse_ + back * solution.impulse};
    const VectorX before = solution.impulse;
    solution = solve_others(condensed, before);
    if (!solution.converged) return solution;
    const VectorX change = problem.delassus * (solution.impulse - before);
    const double scale = std::max(problem.rhs.cwiseAbs().maxCoeff(), (problem.delassus.cwiseAbs() * solution.impulse).maxCoeff());
    if (change.cwiseAbs().maxCoeff() <= 1e-12 * scale) return solution;
  }
  throw ConvergenceError(fmt::format("contact forces and impulses did not come to terms within {} alternations, first pair {}",
                                     most_alternations, name(contacts, others.front())));
}

void PenaltyForces::report(const Contacts& contacts, const State& committed, const VectorX& rate, State& trial,
                           StepResult& result) const {
  trial.contact_episodes = committed.contact_episodes;
  std::vector<bool> touching(laws_.size(), false);
  std::vector<Impact> ended;
  for (std::size_t a = 0; a < problem_.pairs.size(); ++a) {
    const ForcePair& pair = problem_.pairs[a];
    const auto place = static_cast<std::size_t>(place_of_[static_cast<std::size_t>(pair.pair)]);
    const double p = impulse_[static_cast<Eigen::Index>(a)];
    const double w = contacts.jacobian.row(pair.pair).dot(trial.velocity), u = pair.mid_rate(w), d = pair.mid_penetration(w);
    const auto stored = [&](double gap) { return stored_energy(*pair.law, pair.stiffness, std::max(0.0, -gap)); };
    const double elastic = d > 0 ? pair.h * pair.law->force(pair.stiffness, 0, d, -u, pair.approach).value : 0;
    const double gained = stored(pair.gap + pair.h * u) - stored(pair.gap);
    result.contact += gained - (p - elastic) * u;
    result.numerical -= elastic * u + gained;
    trial.impulse[pair.pair] = p;
    if (!(d > 0) && p == 0) continue;
    touching[place] = true;
    ContactEpisode now = begins_[a];
    now.impulse += p;
    put(trial, place, now);
  }
  for (std::size_t k = 0; k < laws_.size(); ++k) {
    const ContactEpisode before = episode(committed, k);
    if (touching[k] || before.touches == 0) continue;
    ended.push_back(ended_contact(before, laws_[k].pair, committed.time, rate[laws_[k].pair]));
    put(trial, k, {});
  }
  result.impacts.insert(result.impacts.begin(), ended.begin(), ended.end());  // before the step's own impacts
}

std::vector<Impact> PenaltyForces::open_contacts(const Contacts& contacts, const State& state) const {
  std::vector<Impact> open;
  for (std::size_t k = 0; k < laws_.size(); ++k) {
    const ContactEpisode now = episode(state, k);
    if (now.touches == 0) continue;
    open.push_back(ended_contact(now, laws_[k].pair, state.time, contacts.jacobian.row(laws_[k].pair).dot(state.velocity)));
  }
  return open;
}

std::vector<std::string> PenaltyForces::describe(const Contacts& contacts) const {
  std::vector<std::string> lines;
  for (const ForcePair& pair : laws_) {
    lines.push_back(fmt::format("contact '{}': {}, k = {:.4g} {}, {} {:.4g}", name(contacts, pair.pair), pair.law->name, pair.stiffness,
                                pair.law->stiffness == ContactStiffness::hertz ? "N/m^1.5" : "N/m",
                                pair.law->has_damping_ratio ? "c =" : "damping", pair.damping));
  }
  return lines;
}

std::string force_law_of(const Contacts& contacts) {
  for (const ContactPair& pair : contacts.pairs) {
    if (pair.law.is_force()) return fmt::format("contact pair '{}' has the law of force '{}'", pair.name, pair.law.name);
  }
  return {};
}

}  // namespace nsframe
