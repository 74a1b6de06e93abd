#include "assembly/damping.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/errors.hpp"
#include "models/mode_names.hpp"

namespace nsframe {

namespace {

bool has_all(const std::vector<std::string>& names, const DampingDescription& damping) {
  return std::all_of(damping.named_ratios.begin(), damping.named_ratios.end(), [&](const auto& named) {
    return std::find(names.begin(), names.end(), named.first.name) != names.end();
  });
}

// C = a0 M + a1 K with the asked ratios at two frequencies: xi = a0/(2 w) + a1 w/2.
std::array<double, 2> rayleigh_factors(const DampingDescription& damping) {
  if (!damping.frequencies) return {damping.mass_factor, damping.stiffness_factor};
  const double w1 = 2 * pi * (*damping.frequencies)[0], w2 = 2 * pi * (*damping.frequencies)[1];
  const double x1 = damping.frequency_ratios[0], x2 = damping.frequency_ratios[1];
  const double determinant = w2 * w2 - w1 * w1;
  return {2 * w1 * w2 * (w2 * x1 - w1 * x2) / determinant, 2 * (w2 * x2 - w1 * x1) / determinant};
}

VectorX asked_ratios(const Structure& structure, const StructureModes& modes, Diagnostics& diagnostics) {
  VectorX ratios = VectorX::Zero(modes.modes.size());
  const DampingDescription& damping = structure.damping;
  for (std::size_t i = 0; i < damping.ratios.size(); ++i) {
    if (static_cast<Eigen::Index>(i) >= ratios.size()) {
      diagnostics.error(damping.at, fmt::format("structure '{}' has {} modes, {} damping ratios are given", structure.name,
                                                ratios.size(), damping.ratios.size()));
      break;
    }
    ratios[static_cast<Eigen::Index>(i)] = damping.ratios[i];
  }
  for (const auto& [name, ratio] : damping.named_ratios) {
    const auto found = std::find(modes.names.begin(), modes.names.end(), name.name);
    if (found == modes.names.end()) {
      diagnostics.error(name.at, fmt::format("structure '{}' has no mode '{}'{}", structure.name, name.name,
                                             did_you_mean(name.name, modes.names)));
      continue;
    }
    ratios[found - modes.names.begin()] = ratio;
  }
  return ratios;
}

}  // namespace

std::vector<StructureModes> structure_modes(const Model& model, const SparseMatrix& stiffness, int count) {
  std::vector<StructureModes> all;
  for (const Structure& structure : model.structures) {
    StructureModes result;
    const BlockRange range{structure.first_dof, structure.last_dof};
    if (range.size() == 0) {
      all.push_back(std::move(result));
      continue;
    }
    // symmetrised: the part of P-Delta's tangent that isn't symmetric doesn't change frequencies to first order
    const SparseMatrix unsymmetric = extract_block(stiffness, range), M = extract_block(model.mass, range);
    const SparseMatrix K = 0.5 * (unsymmetric + SparseMatrix(unsymmetric.transpose()));
    int wanted = std::max(count, static_cast<int>(structure.damping.ratios.size()));
    for (;; wanted *= 2) {
      result.modes = solve_modes(K, M, std::min(wanted, range.size()));
      result.names = name_modes(model, structure, result.modes.shape);
      if (has_all(result.names, structure.damping) || result.modes.size() < wanted) break;
    }
    for (int i = 0; i < result.modes.size(); ++i) {
      result.participation.push_back(participation(model, structure, result.modes.shape.col(i)));
    }
    result.damping_ratio = VectorX::Zero(result.modes.size());
    all.push_back(std::move(result));
  }
  return all;
}

void assemble_damping(System& system, const SparseMatrix& stiffness, std::vector<StructureModes>& modes) {
  Diagnostics diagnostics;
  const auto& structures = system.model.structures;
  std::vector<Eigen::Triplet<double>> viscous;
  const auto add = [&viscous](const SparseMatrix& matrix, double factor, int first) {
    for (int j = 0; j < matrix.outerSize(); ++j) {
      for (SparseMatrix::InnerIterator entry(matrix, j); entry; ++entry) {
        viscous.emplace_back(first + static_cast<int>(entry.row()), first + j, factor * entry.value());
      }
    }
  };
  add(system.model.viscous_damping, 1.0, 0);
  for (std::size_t i = 0; i < structures.size(); ++i) {
    const DampingDescription& damping = structures[i].damping;
    const BlockRange range = system.assembler.blocks()[i];
    if (range.size() == 0) continue;
    if (damping.kind == DampingKind::rayleigh) {
      if (damping.frequencies && (*damping.frequencies)[0] == (*damping.frequencies)[1]) {
        diagnostics.error(damping.at, "Rayleigh damping needs two different frequencies");
        continue;
      }
      const auto [mass_factor, stiffness_factor] = rayleigh_factors(damping);
      add(extract_block(system.model.mass, range), mass_factor, range.first);
      // the tangent of a linear model never changes
      if (damping.stiffness == DampingStiffness::initial || system.linear()) {
        add(extract_block(stiffness, range), stiffness_factor, range.first);
      } else {
        if (!system.damping.follows_tangent()) {
          system.damping.committed_factor = system.damping.current_factor = VectorX::Zero(system.model.dofs.size());
        }
        (damping.stiffness == DampingStiffness::committed ? system.damping.committed_factor : system.damping.current_factor)
            .segment(range.first, range.size()).setConstant(stiffness_factor);
      }
    } else if (damping.kind == DampingKind::modal) {
      const VectorX ratios = asked_ratios(structures[i], modes[i], diagnostics);
      const MatrixX factor = modal_damping_factor(modes[i].modes, extract_block(system.model.mass, range), ratios);
      std::vector<Eigen::Index> damped;
      for (Eigen::Index n = 0; n < ratios.size(); ++n) {
        if (ratios[n] > 0) damped.push_back(n);
      }
      system.damping.modal[i] = factor(Eigen::all, damped);
    }
  }
  diagnostics.throw_if_any();
  system.damping.viscous.resize(system.model.dofs.size(), system.model.dofs.size());
  system.damping.viscous.setFromTriplets(viscous.begin(), viscous.end());
  if (system.damping.follows_tangent()) {
    system.damping.form_tangent(Eigen::Map<const VectorX>(stiffness.valuePtr(), stiffness.nonZeros()), stiffness);
  }
  for (std::size_t i = 0; i < structures.size(); ++i) {
    const BlockRange range = system.assembler.blocks()[i];
    SparseMatrix C = extract_block(system.damping.viscous, range);
    if (system.damping.follows_tangent()) C += extract_block(system.damping.tangent, range);
    for (int n = 0; n < modes[i].modes.size(); ++n) {
      const VectorX shape = modes[i].modes.shape.col(n);
      const double c = shape.dot(C * shape) + (system.damping.modal[i].transpose() * shape).squaredNorm();
      const double w = modes[i].modes.circular_frequency[n];
      modes[i].damping_ratio[n] = w > 0 ? c / (2 * w) : 0;
    }
  }
}

}  // namespace nsframe
