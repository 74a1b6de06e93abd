#include "calibration/eigenproblem.hpp"

#include <algorithm>

#include "assembly/moved_supports.hpp"
#include "assembly/stability.hpp"
#include "base/errors.hpp"
#include "integrators/initial_state.hpp"
#include "integrators/static_analysis.hpp"

namespace nsframe {

namespace {

constexpr double relative_step = 1e-4;  // of a parameter: second-order errors of 1e-8 where matrices are curved, rounding of 1e-12

SparseMatrix symmetric_part(const SparseMatrix& matrix) { return 0.5 * (matrix + SparseMatrix(matrix.transpose())); }

}  // namespace

RestingModel resting_model(const ModelDescription& description) {
  Diagnostics diagnostics;
  RestingModel out;
  out.model = held_supports(build_model(description, diagnostics));
  diagnostics.throw_if_any();
  System system(out.model, 1);
  State state = virgin_state(system);
  check_stability(out.model, system.assembler.tangent(), diagnostics);
  diagnostics.throw_if_any();
  find_initial_state(system, state);
  for (const BlockRange& range : system.assembler.blocks()) {
    out.structures.push_back({symmetric_part(extract_block(system.assembler.tangent(), range)), extract_block(out.model.mass, range)});
  }
  return out;
}

MatrixDerivatives matrix_derivatives(const CalibrationProblem& problem, const VectorX& values) {
  MatrixDerivatives out;
  for (std::size_t j = 0; j < problem.parameters.size(); ++j) {
    const CalibrationParameter& parameter = problem.parameters[j];
    const auto at = static_cast<Eigen::Index>(j);
    // both values within the bounds, beyond which there may be no model
    const double step = std::min(relative_step * values[at], (parameter.upper - parameter.lower) / 2);
    const double centre = std::clamp(values[at], parameter.lower + step, parameter.upper - step);
    VectorX moved = values;
    moved[at] = centre + step;
    const std::vector<StructureMatrices> high = resting_model(problem.model(moved)).structures;
    moved[at] = centre - step;
    const std::vector<StructureMatrices> low = resting_model(problem.model(moved)).structures;
    std::vector<StructureMatrices>& derivatives = out.emplace_back();
    for (std::size_t s = 0; s < high.size(); ++s) {
      if (high[s].mass.rows() != low[s].mass.rows())
        throw InputError("error: parameter '" + parameter.name + "' changes which DOFs are free: it cannot be fitted");
      derivatives.push_back({(high[s].stiffness - low[s].stiffness) / (2 * step), (high[s].mass - low[s].mass) / (2 * step)});
    }
  }
  return out;
}

double eigenvalue_derivative(const StructureMatrices& derivative, double circular_frequency, const VectorX& shape) {
  return shape.dot(derivative.stiffness * shape) - circular_frequency * circular_frequency * shape.dot(derivative.mass * shape);
}

}  // namespace nsframe
