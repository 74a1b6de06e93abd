#include "models/reduction.hpp"

namespace nsframe {

void Reduction::expand(const State& state, const std::vector<GroundMotion>& motions, State& larger) const {
  larger.time = state.time;
  larger.displacement = rest;
  larger.displacement.noalias() += map * state.displacement;
  larger.velocity.noalias() = map * state.velocity;
  larger.acceleration.noalias() = map * state.acceleration;
  for (std::size_t k = 0; k < shapes.size(); ++k) {
    if (shapes[k].size() == 0) continue;
    larger.displacement += motions[k].displacement_at(state.time) * shapes[k];
    larger.velocity += motions[k].velocity_at(state.time) * shapes[k];
    larger.acceleration += motions[k].acceleration_at(state.time) * shapes[k];
  }
}

Reduction Reduction::then(const Reduction& inner) const {
  Reduction all;
  for (const int i : inner.kept) all.kept.push_back(kept[static_cast<std::size_t>(i)]);
  all.map = map * inner.map;
  all.rest = rest + map * inner.rest;
  all.shapes = shapes;
  return all;
}

Model reduced_model(const Model& model, const Reduction& reduction, const std::vector<VectorX>& linear_force) {
  const SparseRows& A = reduction.map;
  const SparseRows At = A.transpose();
  Model out = model;
  out.dofs.free.clear();
  for (const int i : reduction.kept) out.dofs.free.push_back(model.dofs.free[static_cast<std::size_t>(i)]);
  out.dofs.transformation = model.dofs.transformation * A;
  out.dofs.transformation_transposed = out.dofs.transformation.transpose();
  int next = 0;
  const auto count = static_cast<int>(reduction.kept.size());
  for (Structure& structure : out.structures) {
    const int last = structure.last_dof;
    structure.first_dof = next;
    while (next < count && reduction.kept[static_cast<std::size_t>(next)] < last) ++next;
    structure.last_dof = next;
  }

  out.mass = SparseMatrix(At * SparseRows(SparseRows(model.mass) * A)).pruned();
  out.viscous_damping = SparseMatrix(At * SparseRows(SparseRows(model.viscous_damping) * A));
  for (std::size_t k = 0; k < 3; ++k) out.inertia[k] = At * model.inertia[k];
  out.gravity_load = At * model.gravity_load;
  out.contacts.jacobian = model.contacts.jacobian * A;
  if (out.contacts.tangents.rows() > 0) out.contacts.tangents = model.contacts.tangents * A;
  for (StaticStage& stage : out.stages) {
    if (stage.pattern.size() > 0) stage.pattern = At * stage.pattern;
    if (stage.control_row.size() > 0) stage.control_row = At * stage.control_row;
  }
  out.initial_displacement = model.initial_displacement(reduction.kept);
  out.initial_velocity = model.initial_velocity(reduction.kept);

  out.motion_load.clear();
  out.support_effects.clear();
  for (std::size_t k = 0; k < model.motions.size(); ++k) {
    SupportEffect effect;
    if (k < model.support_effects.size() && model.support_effects[k].displacement.size() > 0) {  // of DOFs taken out before
      effect = model.support_effects[k];
      effect.force = At * effect.force;
      effect.damping = At * effect.damping;
    }
    VectorX load = model.motion_load[k];
    if (k < reduction.shapes.size() && reduction.shapes[k].size() > 0) {
      const VectorX& shape = reduction.shapes[k];
      load -= model.mass * shape;
      effect = {model.dofs.transformation * shape, At * linear_force[k], model.contacts.jacobian * shape, At * VectorX(model.viscous_damping * shape)};
    }
    out.motion_load.push_back(At * load);
    out.support_effects.push_back(std::move(effect));
  }
  out.driven.assign(model.driven.size(), VectorX());
  if (linear_force.empty()) return out;
  const auto moved = static_cast<Eigen::Index>(model.motions.size());
  out.support_mass = out.support_stiffness = MatrixX::Zero(moved, moved);
  for (Eigen::Index j = 0; j < moved; ++j) {
    for (Eigen::Index k = 0; k < moved; ++k) {
      const VectorX &s = reduction.shapes[static_cast<std::size_t>(j)], &t = reduction.shapes[static_cast<std::size_t>(k)];
      if (s.size() == 0 || t.size() == 0) continue;
      out.support_mass(j, k) = s.dot(model.mass * t);
      out.support_stiffness(j, k) = s.dot(linear_force[static_cast<std::size_t>(k)]);
    }
  }
  return out;
}

}  // namespace nsframe
