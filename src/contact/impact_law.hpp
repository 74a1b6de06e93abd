// Restitution where several pairs collide at once (theory.md, 270-274): what Newton's law may create, and Poisson's law, which
// creates nothing. u: gap rates before (-) and after (+), u+ = u- + W p.
#pragma once

#include <functional>

#include "contact/contact_problem.hpp"

namespace nsframe {

// Kinetic energy that impulses p [N s] add, 1/2 p'(u- + u+) [J], over the groups of pairs that W couples, those groups where it is
// positive; 0 up to rounding where restitution dissipates.
double created_energy(const MatrixX& delassus, const VectorX& impulse, const VectorX& before, const VectorX& after);

struct PoissonImpact {
  VectorX compression, impulse;  // P_c, and P_c + P_e [N s]
  VectorX rate;                  // u+ [m/s]
};

// Solves 0 <= p, W p + rhs >= 0, complementary; throws what it likes.
using ComplementaritySolver = std::function<VectorX(const ContactProblem&)>;

// Poisson's law as two problems (Glocker and Pfeiffer 1995): compression until no pair closes, 0 <= P_c _|_ u- + W P_c >= 0; expansion
// with at least the part e of each impulse, 0 <= P_e - e P_c _|_ u- + W (P_c + P_e) >= 0. One pair alone: Newton's law.
PoissonImpact poisson_impact(const MatrixX& delassus, const VectorX& before, const VectorX& restitution,
                             const ComplementaritySolver& solve);

}  // namespace nsframe
