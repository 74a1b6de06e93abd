// Contact with Coulomb friction (theory.md, 275-279): pair i has the rows 3i (normal), 3i + 1 and 3i + 2 (tangents); with u = W p + rhs,
//   0 <= p_n _|_ u_n >= 0,   |p_t| <= mu p_n,   p_t = -mu p_n u_t/|u_t| where u_t != 0.
// W is symmetric positive semidefinite, singular where contacts are redundant: then u is what counts. Rows and columns of tangents
// along which nothing moves, or of pairs without friction, are zero.
#pragma once

#include "contact/contact_problem.hpp"

namespace nsframe {

struct FrictionProblem {
  MatrixX delassus;  // W (3 pairs x 3 pairs) [1/kg]
  VectorX rhs;       // [m/s]
  VectorX friction;  // mu (pairs) [-]

  Eigen::Index pairs() const { return friction.size(); }
};

// Largest |p - projection of p - (u_n + mu |u_t|, u_t)/w onto the cone |p_t| <= mu p_n| (De Saxce and Feng 1998), as a velocity with the
// largest diagonal entry w of the pair, over the largest |rhs| [-]. Without friction it is complementarity_error().
double friction_error(const FrictionProblem& problem, const VectorX& impulse);

// One pair alone, exactly: opens, sticks, or slips with u_t = -alpha p_t, alpha > 0 from one scalar equation.
Vector3 solve_one_contact(const Matrix3& W, const Vector3& rhs, double friction);

// Alart and Curnier's Newton method (1991) from `guess` (may be empty), with sweeps of solve_one_contact() in between where it does not
// get on; `iterations` counts both. Not converged: also where there is no solution, as with large friction and coupled directions.
ContactSolution solve_friction(const FrictionProblem& problem, const ContactOptions& options, VectorX guess = {});

}  // namespace nsframe
