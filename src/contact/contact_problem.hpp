// The local contact problem (theory.md, eq. 18-20): 0 <= p, W p + rhs >= 0, p'(W p + rhs) = 0, with rhs = b + e g'(before),
// W = H J^-1 H' symmetric positive semidefinite (singular when contacts are redundant: then p is not unique, W p is).
#pragma once

#include "base/types.hpp"

namespace nsframe {

struct ContactProblem {
  MatrixX delassus;  // W [1/kg]
  VectorX rhs;       // [m/s]
};

struct ContactOptions {
  double tolerance = 1e-12;     // of complementarity_error(); the active set also accepts what rounding of p leaves
  int max_iterations = 100000;  // Gauss-Seidel sweeps, or changes of Lawson and Hanson's set
};

struct ContactSolution {
  VectorX impulse;  // p [N s]
  int iterations = 0;
  double error = 0;
  bool converged = false;
};

// Largest violation of p >= 0, W p + rhs >= 0 and of their complementarity, as the velocity
// |min(p_a W_aa, (W p + rhs)_a)| over the largest |rhs| [-]; belongs to no solver. Same zero as residual (21).
double complementarity_error(const ContactProblem& problem, const VectorX& impulse);

// Error that rounding of the impulses alone makes: large where impulses are, as below a heavy mass on a light one.
double rounding_error(const ContactProblem& problem, const VectorX& impulse);

// Projected Gauss-Seidel as in the paper. Needs of the order of the mass ratio in sweeps.
ContactSolution solve_gauss_seidel(const ContactProblem& problem, const ContactOptions& options, VectorX guess);

// Exact to rounding for symmetric W, singular or not; finite (theory.md, 210-211). Dual active-set method of Goldfarb and
// Idnani (1983), Cholesky factors updated; large sets first by changing all wrong pairs at once from the pairs that
// carry in `guess` (may be empty), which needs few factorizations. Unsymmetric W: Lawson and Hanson's method.
ContactSolution solve_active_set(const ContactProblem& problem, const ContactOptions& options, const VectorX& guess = {});

// The method of Lawson and Hanson (1974, chapter 23), with a decomposition for every change of the set; accepts an
// unsymmetric W. Cycles on one redundant problem of some ten thousand.
ContactSolution solve_lawson_hanson(const ContactProblem& problem, const ContactOptions& options);

}  // namespace nsframe
