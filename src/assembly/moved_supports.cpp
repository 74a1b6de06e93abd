#include "assembly/moved_supports.hpp"

#include "assembly/assembler.hpp"
#include "base/decompositions.hpp"
#include "base/errors.hpp"

namespace nsframe {

Model without_moved_supports(const Model& model, Reduction& reduction) {
  const int n = model.dofs.size();
  std::vector<bool> driven(static_cast<std::size_t>(n), false);
  for (const VectorX& unit : model.driven) {
    for (Eigen::Index i = 0; i < unit.size(); ++i) {
      if (unit[i] != 0) driven[static_cast<std::size_t>(i)] = true;
    }
  }
  reduction = {};
  std::vector<Eigen::Triplet<double>> entries;
  for (int i = 0; i < n; ++i) {
    if (driven[static_cast<std::size_t>(i)]) continue;
    entries.emplace_back(i, static_cast<int>(reduction.kept.size()), 1.0);
    reduction.kept.push_back(i);
  }
  reduction.map.resize(n, static_cast<Eigen::Index>(reduction.kept.size()));
  reduction.map.setFromTriplets(entries.begin(), entries.end());
  reduction.rest = VectorX::Zero(n);

  Assembler assembler(model);
  const VectorX virgin = assembler.virgin_history();
  VectorX history = virgin, force;
  assembler.start_step(virgin, history);
  assembler.internal_force(VectorX::Zero(n), virgin, history, force);
  const SparseMatrix K = assembler.tangent();
  const SparseRows selection = reduction.map.transpose();
  SparseMatrix free_stiffness = selection * K * SparseMatrix(reduction.map);
  Eigen::SparseLU<SparseMatrix> factor;
  factor.compute(free_stiffness);
  std::vector<VectorX> linear_force;
  for (const VectorX& unit : model.driven) {
    VectorX& shape = reduction.shapes.emplace_back();
    linear_force.emplace_back();
    if (unit.size() == 0) continue;
    const VectorX push = selection * VectorX(K * unit);
    VectorX follow = VectorX::Zero(push.size());
    if (!push.isZero(0)) follow = factor.info() == Eigen::Success ? VectorX(factor.solve(push)) : VectorX();
    // a structure that may move freely has no pseudo-static shape
    if (follow.size() != push.size() || !follow.allFinite() || (free_stiffness * follow - push).norm() > 1e-6 * push.norm()) {
      throw InputError("error: supports are moved of a structure whose other nodes may move freely: it has no shape at rest for them");
    }
    shape = unit - reduction.map * follow;
    assembler.linear_force(shape, linear_force.back());
  }
  return reduced_model(model, reduction, linear_force);
}

Model held_supports(Model model) {
  if (!model.drives_dofs()) return model;
  Reduction reduction;
  return without_moved_supports(model, reduction);
}

}  // namespace nsframe
