// The local problem of contact pairs with laws of force in one theta step: impulses p = h F, with F at the theta point of the
// step, that fit the gap rates they lead to (theory.md, 259-261).
#pragma once

#include <vector>

#include "contact/contact_problem.hpp"
#include "models/contact_law.hpp"

namespace nsframe {

// One pair and its law in one step; w is its gap rate at the end of the step.
struct ForcePair {
  int pair = 0;                         // of Contacts
  const ContactForceLaw* law = nullptr;
  double stiffness = 0, damping = 0;    // k and c of the law
  double gap = 0, rate = 0;             // at the start of the step [m], [m/s]
  double approach = 0;                  // rate at which the contact began, positive when closing [m/s]
  double h = 0, theta = 1;              // of the step [s], [-]

  double mid_rate(double w) const { return (1 - theta) * rate + theta * w; }
  double mid_penetration(double w) const { return -(gap + theta * h * mid_rate(w)); }
  double parting_rate() const;          // w of penetration 0 at the theta point
  double impulse(double w) const;       // h F; 0 beyond the parting rate [N s]
  double slope(double w) const;         // -dp/dw [kg]

  struct Solution {
    double impulse = 0, slope = 0;      // [N s], [kg]
  };
  // The p that is impulse(w) at w = free + compliance p. A force that begins with a jump takes any value up to it at the parting
  // rate; one that ends with a jump, because the law pulls, holds as long as a penetrated w fits it.
  Solution solve(double free, double compliance) const;
};

struct ForceProblem {
  std::vector<ForcePair> pairs;
  MatrixX delassus;                     // [1/kg]
  VectorX free;                         // gap rates without these impulses [m/s]
};

struct ForceSolution : ContactSolution {
  VectorX slope;                        // -dp/dw of every pair [kg]; very large where a jump is not used up
};

// Newton's method on the impulses, with a sweep over the pairs one by one wherever it does not descend: for laws that do not pull
// that is descent by coordinates of a convex function (theory.md, 261). `error` is of the rates, over the largest one.
ForceSolution solve_forces(const ForceProblem& problem, const ContactOptions& options, VectorX guess);

}  // namespace nsframe
