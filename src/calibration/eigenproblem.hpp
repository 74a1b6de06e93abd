// Stiffness and mass of every structure at values of the parameters, how they change, and what that does to frequencies.
#pragma once

#include "assembly/damping.hpp"
#include "calibration/problem.hpp"

namespace nsframe {

struct StructureMatrices {
  SparseMatrix stiffness, mass;  // symmetric, free DOFs of the structure [N/m], [kg]
};

// A model with its matrices at rest under gravity and pretension.
struct RestingModel {
  Model model;
  std::vector<StructureMatrices> structures;
};

// Throws InputError, or ConvergenceError where no rest is found.
RestingModel resting_model(const ModelDescription& description);

// dK/dp and dM/dp of every structure for each parameter, by central differences of the assembled matrices: exact but for rounding where
// they depend on p linearly, of second order elsewhere. [parameter][structure].
using MatrixDerivatives = std::vector<std::vector<StructureMatrices>>;
MatrixDerivatives matrix_derivatives(const CalibrationProblem& problem, const VectorX& values);

// d(w^2)/dp = phi' (dK/dp - w^2 dM/dp) phi of a mode with phi' M phi = 1 (theory.md, 325); exact also for DOFs without mass.
double eigenvalue_derivative(const StructureMatrices& derivative, double circular_frequency, const VectorX& shape);

}  // namespace nsframe
