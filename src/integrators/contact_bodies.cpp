#include "integrators/contact_bodies.hpp"

#include <algorithm>

#include "base/decompositions.hpp"

namespace nsframe {

namespace {

// DOFs that the mass couples with those of the row.
std::vector<int> coupled_by_mass(const SparseMatrix& mass, const VectorX& row) {
  std::vector<int> dofs;
  std::vector<bool> known(static_cast<std::size_t>(row.size()), false);
  const auto add = [&](Eigen::Index i) {
    if (known[static_cast<std::size_t>(i)]) return;
    known[static_cast<std::size_t>(i)] = true;
    dofs.push_back(static_cast<int>(i));
  };
  for (Eigen::Index i = 0; i < row.size(); ++i) {
    if (row[i] != 0) add(i);
  }
  for (std::size_t k = 0; k < dofs.size(); ++k) {
    for (SparseMatrix::InnerIterator entry(mass, dofs[k]); entry; ++entry) add(entry.row());
  }
  return dofs;
}

// Row of the point's velocity along the normal, free DOFs.
VectorX point_row(const Model& model, const ContactPoint& point, const Vector3& normal) {
  std::vector<Eigen::Triplet<double>> entries;
  Vector6 along = Vector6::Zero();
  along.head<3>() = normal;
  add_row(point, along, 0, entries);
  VectorX full = VectorX::Zero(model.dofs.full);
  for (const auto& entry : entries) full[entry.col()] += entry.value();
  return model.dofs.transformation_transposed * full;
}

double static_stiffness(const System& system, const ContactPoint& point, const Vector3& normal) {
  const VectorX row = point_row(system.model, point, normal);
  double flexibility = 0;
  for (const Structure& structure : system.model.structures) {
    const int size = structure.last_dof - structure.first_dof;
    const VectorX part = row.segment(structure.first_dof, size);
    if (part.isZero(0)) continue;
    if (structure.may_move_freely) return 0;
    Eigen::SparseLU<SparseMatrix> factor;
    const SparseMatrix K = extract_block(system.initial_stiffness, {structure.first_dof, structure.last_dof});
    factor.analyzePattern(K);
    factor.factorize(K);
    if (factor.info() != Eigen::Success) return 0;
    flexibility += part.dot(VectorX(factor.solve(part)));
  }
  return flexibility > 0 ? 1 / flexibility : 0;
}

}  // namespace

double effective_mass(const System& system, int pair) {
  const VectorX row = system.contacts().jacobian.row(pair).transpose();
  const std::vector<int> dofs = coupled_by_mass(system.mass(), row);
  const auto n = static_cast<Eigen::Index>(dofs.size());
  MatrixX M(n, n);
  for (Eigen::Index i = 0; i < n; ++i) {
    for (Eigen::Index j = 0; j < n; ++j) {
      M(i, j) = system.mass().coeff(dofs[static_cast<std::size_t>(i)], dofs[static_cast<std::size_t>(j)]);
    }
  }
  VectorX own(n);
  for (Eigen::Index i = 0; i < n; ++i) own[i] = row[dofs[static_cast<std::size_t>(i)]];
  const Eigen::LLT<MatrixX> factor(M);
  if (factor.info() != Eigen::Success || !(M.diagonal().minCoeff() > 0)) return 0;
  return 1 / own.dot(VectorX(factor.solve(own)));
}

double stiffer_body(const System& system, int pair) {
  const ContactPair& p = system.contacts().pairs[static_cast<std::size_t>(pair)];
  double stiffness = 0;
  for (const ContactPoint* point : {&p.a, &p.b}) {
    if (!point->fixed()) stiffness = std::max(stiffness, static_stiffness(system, *point, p.normal));
  }
  return stiffness;
}

}  // namespace nsframe
