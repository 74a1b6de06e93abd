// Contact pairs with laws of force (penalty laws) in the theta scheme: which of them may carry in a step, their impulses beside
// those of the pairs with Newton's law, their work, and the contacts that they make (theory.md, 259-264).
#pragma once

#include <functional>
#include <vector>

#include "assembly/system.hpp"
#include "integrators/force_problem.hpp"
#include "integrators/iteration_matrix.hpp"
#include "integrators/scheme.hpp"

namespace nsframe {

// A stretch of time in which a pair stays penetrated; State::contact_episodes holds one for each pair with a law of force.
struct ContactEpisode {
  double touches = 0;      // 1: under way; the others count only then
  double start = 0;        // [s]
  double rate_before = 0;  // gap rate at its start [m/s]
  double impulse = 0;      // so far [N s]
};

// Of a state in which no pair touches.
VectorX no_contact_episodes(const Contacts& contacts);

class PenaltyForces {
 public:
  // Finds stiffness and damping of every pair with a law of force. Throws InputError where a mass or a stiffness is missing.
  explicit PenaltyForces(const System& system);

  // Chooses the pairs that may carry in the step from `committed`, which has these gaps and rates.
  void start_step(const Contacts& contacts, const State& committed, const VectorX& gap, const VectorX& rate, double h, double theta);
  bool active() const { return !problem_.pairs.empty(); }
  int count() const { return static_cast<int>(problem_.pairs.size()); }  // of those pairs
  bool is_force(int pair) const { return pair < static_cast<int>(place_of_.size()) && place_of_[static_cast<std::size_t>(pair)] >= 0; }
  // Sets the impulses to zero.
  void restart() { impulse_.setZero(static_cast<Eigen::Index>(problem_.pairs.size())); }

  // velocity += factor J^-1 H' p
  void add_velocity(const Contacts& contacts, IterationMatrix& matrix, double factor, VectorX& velocity) const;
  // residual -= H' p
  void subtract_impulses(const Contacts& contacts, VectorX& residual) const;

  // Finds the impulses of this object and those of `others`, whose problem is `problem`, both without them at `velocity`.
  // `solve_others` solves a contact problem of the others in which the forces yield as linearised. Throws ConvergenceError.
  using ImpulseSolver = std::function<ContactSolution(const ContactProblem&, const VectorX& guess)>;
  ContactSolution solve(const Contacts& contacts, IterationMatrix& matrix, const VectorX& velocity, const std::vector<int>& others,
                        const ContactProblem& problem, VectorX guess, const ContactOptions& options, const ImpulseSolver& solve_others);

  // Of the step that ended in `trial`: fills its impulses and episodes, adds contacts that ended and energies to `result`.
  void report(const Contacts& contacts, const State& committed, const VectorX& rate, State& trial, StepResult& result) const;
  // Contacts that are under way, as if they ended now.
  std::vector<Impact> open_contacts(const Contacts& contacts, const State& state) const;

  // What `nsframe check` says, a line a pair.
  std::vector<std::string> describe(const Contacts& contacts) const;

 private:
  void solve_own(const ContactOptions& options, const Contacts& contacts, VectorX& slope);

  std::vector<ForcePair> laws_;         // of all pairs with laws of force
  std::vector<int> place_of_;           // of every pair in laws_, or -1
  ForceProblem problem_;                // of the step
  std::vector<ContactEpisode> begins_;  // of the pairs of the step: under way, or as it would begin
  VectorX impulse_;
};

// The first pair with a law of force, as "contact pair 'a|b' has the law of force 'hertz'"; empty without.
std::string force_law_of(const Contacts& contacts);

}  // namespace nsframe
