#include "calibration/mode_tracking.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "base/decompositions.hpp"
#include "base/errors.hpp"
#include "models/mode_names.hpp"

namespace nsframe {

namespace {

constexpr double same_eigenvalue = 1e-7;  // relative difference of w^2 below which shapes can be turned into each other

Modes lowest_modes(const RestingModel& resting, std::size_t structure, int count) {
  const StructureMatrices& matrices = resting.structures[structure];
  return solve_modes(matrices.stiffness, matrices.mass, std::min(count, static_cast<int>(matrices.mass.rows())));
}

// Calls turn(first, size) for every run of more than one mode of equal frequency.
template <class Turn>
void for_equal_frequencies(const Modes& modes, const Turn& turn) {
  const VectorX squared = modes.circular_frequency.cwiseAbs2();
  for (int first = 0, next = 1; first < modes.size(); first = next++) {
    while (next < modes.size() && squared[next] - squared[next - 1] <= same_eigenvalue * squared[next]) ++next;
    if (next - first > 1) turn(first, next - first);
  }
}

// Quadratic form of the directional energies, weighted differently by direction: its eigenvectors move in one direction each.
MatrixX direction_form(const Model& model, const Structure& structure, const MatrixX& shapes) {
  const auto energy = [&](const VectorX& shape) {
    return directional_energy(model, structure, shape).dot(Eigen::Vector4d(1, 2, 3, 4));
  };
  MatrixX form(shapes.cols(), shapes.cols());
  for (Eigen::Index i = 0; i < shapes.cols(); ++i) {
    for (Eigen::Index j = 0; j <= i; ++j) {
      form(i, j) = form(j, i) = 0.25 * (energy(shapes.col(i) + shapes.col(j)) - energy(shapes.col(i) - shapes.col(j)));
    }
  }
  return form;
}

VectorX measured_values(const CalibrationTarget& target) {
  VectorX out(static_cast<Eigen::Index>(target.shape.size()));
  for (std::size_t i = 0; i < target.shape.size(); ++i) out[static_cast<Eigen::Index>(i)] = target.shape[i].value;
  return out;
}

// A mode's displacements where the shape was measured.
VectorX at_sensors(const Model& model, std::size_t structure, const CalibrationTarget& target, const VectorX& shape) {
  const Structure& block = model.structures[structure];
  VectorX q = VectorX::Zero(model.dofs.size());
  q.segment(block.first_dof, shape.size()) = shape;
  const VectorX full = model.dofs.expand(q);
  VectorX out(static_cast<Eigen::Index>(target.shape.size()));
  for (std::size_t i = 0; i < target.shape.size(); ++i) {
    const auto node = std::find(model.nodes.id.begin(), model.nodes.id.end(), target.structure + "." + target.shape[i].node);
    if (node == model.nodes.id.end())
      throw InputError(fmt::format("error: there is no node '{}.{}'", target.structure, target.shape[i].node));
    out[static_cast<Eigen::Index>(i)] = full[6 * (node - model.nodes.id.begin()) + target.shape[i].dof];
  }
  return out;
}

std::size_t structure_of(const Model& model, const CalibrationTarget& target) {
  for (std::size_t s = 0; s < model.structures.size(); ++s)
    if (model.structures[s].name == target.structure) return s;
  throw InputError(fmt::format("error: there is no structure '{}'", target.structure));
}

bool has_all(const std::vector<std::string>& names, const CalibrationProblem& problem, const std::string& structure) {
  return std::all_of(problem.targets.begin(), problem.targets.end(), [&](const CalibrationTarget& target) {
    return target.structure != structure || target.mode.empty() || std::find(names.begin(), names.end(), target.mode) != names.end();
  });
}

// The mode most like the measured shape, of those that are free and of the target's direction.
void find_by_shape(const RestingModel& resting, const CalibrationTarget& target, const Identification& all, const std::set<int>& taken,
                   IdentifiedMode& found) {
  const std::vector<std::string>& names = all.names[found.structure];
  int best = -1;
  double most = -1;
  for (int i = 0; i < all.modes[found.structure].size(); ++i) {
    const std::string& name = names[static_cast<std::size_t>(i)];
    if (taken.contains(i) || (!target.mode.empty() && name[0] != target.mode[0])) continue;
    const double likeness = likeness_to_measured(resting, found.structure, target, all.modes[found.structure].shape.col(i));
    if (likeness > most) {
      most = likeness;
      best = i;
    }
  }
  if (best < 0) return;
  found.likeness = most;
  found.name = names[static_cast<std::size_t>(best)];
  if (most >= alike) found.mode = best;
}

}  // namespace

double modal_assurance(const VectorX& a, const VectorX& b) {
  const double product = a.dot(b), norms = a.squaredNorm() * b.squaredNorm();
  return norms > 0 ? product * product / norms : 0;
}

double modal_assurance(const VectorX& a, const VectorX& b, const SparseMatrix& weight) {
  const double product = a.dot(weight * b), norms = a.dot(weight * a) * b.dot(weight * b);
  return norms > 0 ? product * product / norms : 0;
}

double likeness_to_measured(const RestingModel& resting, std::size_t structure, const CalibrationTarget& target, const VectorX& shape) {
  return modal_assurance(measured_values(target), at_sensors(resting.model, structure, target, shape));
}

Modes separated_modes(const RestingModel& resting, std::size_t structure, int count) {
  Modes modes = lowest_modes(resting, structure, count);
  for_equal_frequencies(modes, [&](int first, int size) {
    const MatrixX shapes = modes.shape.middleCols(first, size);
    const MatrixX form = direction_form(resting.model, resting.model.structures[structure], shapes);
    const Eigen::GeneralizedSelfAdjointEigenSolver<MatrixX> solver(form, MatrixX::Identity(size, size));
    modes.shape.middleCols(first, size) = shapes * solver.eigenvectors();
  });
  return modes;
}

Modes aligned_modes(const RestingModel& resting, std::size_t structure, int count, const MatrixX& reference) {
  Modes modes = separated_modes(resting, structure, count);
  for_equal_frequencies(modes, [&](int first, int size) {
    const MatrixX shapes = modes.shape.middleCols(first, size);
    const MatrixX products = shapes.transpose() * (resting.structures[structure].mass * reference);
    // Gram-Schmidt: what of the references lies among these shapes, then the shapes themselves
    MatrixX turned(size, 0);
    const auto add = [&](VectorX direction) {
      direction -= turned * (turned.transpose() * direction);
      if (turned.cols() == size || direction.squaredNorm() < 0.1) return;
      turned.conservativeResize(Eigen::NoChange, turned.cols() + 1);
      turned.rightCols(1) = direction.normalized();
    };
    for (Eigen::Index j = 0; j < products.cols(); ++j)
      if (products.col(j).squaredNorm() > alike) add(products.col(j));
    while (turned.cols() < size) {
      const MatrixX rest = MatrixX::Identity(size, size) - turned * turned.transpose();
      Eigen::Index largest = 0;
      rest.diagonal().maxCoeff(&largest);
      turned.conservativeResize(Eigen::NoChange, turned.cols() + 1);
      turned.rightCols(1) = rest.col(largest).normalized();
    }
    modes.shape.middleCols(first, size) = shapes * turned;
  });
  return modes;
}

Identification identify(const CalibrationProblem& problem, const RestingModel& resting) {
  Identification out;
  const std::size_t structures = resting.structures.size();
  out.modes.resize(structures);
  out.names.resize(structures);
  std::vector<std::set<int>> taken(structures);
  Diagnostics diagnostics;
  for (const CalibrationTarget& target : problem.targets) {
    IdentifiedMode& found = out.targets.emplace_back();
    const std::size_t s = found.structure = structure_of(resting.model, target);
    if (out.modes[s].size() > 0) continue;
    const int all = static_cast<int>(resting.structures[s].mass.rows());
    for (int count = 12;; count *= 2) {
      out.modes[s] = separated_modes(resting, s, count);
      out.names[s] = name_modes(resting.model, resting.model.structures[s], out.modes[s].shape);
      if (has_all(out.names[s], problem, target.structure) || count >= all || out.modes[s].size() < count) break;
    }
  }
  // names alone are certain; shapes choose among what is left
  for (const bool by_shape : {false, true}) {
    for (std::size_t i = 0; i < problem.targets.size(); ++i) {
      const CalibrationTarget& target = problem.targets[i];
      IdentifiedMode& found = out.targets[i];
      if (target.shape.empty() == by_shape) continue;
      const std::vector<std::string>& names = out.names[found.structure];
      if (by_shape) {
        find_by_shape(resting, target, out, taken[found.structure], found);
      } else if (const auto name = std::find(names.begin(), names.end(), target.mode); name != names.end()) {
        found.mode = static_cast<int>(name - names.begin());
        found.name = target.mode;
      } else {
        diagnostics.error(target.at, fmt::format("structure '{}' has no mode '{}' among its {} modes{}", target.structure, target.mode,
                                                 names.size(), did_you_mean(target.mode, names)));
      }
      if (found.mode >= 0) taken[found.structure].insert(found.mode);
    }
  }
  diagnostics.throw_if_any();
  return out;
}

std::vector<int> match_shapes(const MatrixX& before, const MatrixX& after, const SparseMatrix& mass, double least) {
  const MatrixX weighted = mass * after;
  MatrixX likeness(before.cols(), after.cols());
  for (Eigen::Index i = 0; i < before.cols(); ++i) {
    const double norm = before.col(i).dot(mass * before.col(i));
    for (Eigen::Index j = 0; j < after.cols(); ++j) {
      const double product = before.col(i).dot(weighted.col(j));
      likeness(i, j) = norm > 0 ? product * product / (norm * after.col(j).dot(weighted.col(j))) : 0;
    }
  }
  std::vector<int> match(static_cast<std::size_t>(before.cols()), -1);
  for (Eigen::Index round = 0; round < before.cols(); ++round) {
    Eigen::Index i = 0, j = 0;
    if (likeness.size() == 0 || likeness.maxCoeff(&i, &j) < least) break;
    match[static_cast<std::size_t>(i)] = static_cast<int>(j);
    likeness.row(i).setConstant(-1);
    likeness.col(j).setConstant(-1);
  }
  return match;
}

}  // namespace nsframe
