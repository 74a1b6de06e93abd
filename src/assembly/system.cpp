#include "assembly/system.hpp"

namespace nsframe {

void Damping::form_tangent(const VectorX& committed, const SparseMatrix& current) {
  if (tangent.nonZeros() != current.nonZeros()) tangent = current;
  for (int j = 0; j < current.outerSize(); ++j) {
    for (int k = current.outerIndexPtr()[j]; k < current.outerIndexPtr()[j + 1]; ++k) {
      // both ends of an entry belong to one structure, so to one factor
      tangent.valuePtr()[k] = committed_factor[j] * committed[k] + current_factor[j] * current.valuePtr()[k];
    }
  }
}

double Damping::add_force(const std::vector<BlockRange>& blocks, double factor, const VectorX& velocity, VectorX& force) const {
  double power = 0;
  for (const SparseMatrix* matrix : {&viscous, &tangent}) {
    if (matrix->nonZeros() == 0) continue;
    const VectorX own = factor * (*matrix * velocity);
    power += velocity.dot(own);
    force += own;
  }
  for (std::size_t i = 0; i < modal.size(); ++i) {
    if (modal[i].cols() == 0) continue;
    const VectorX rates = modal[i].transpose() * velocity.segment(blocks[i].first, blocks[i].size());
    power += factor * rates.squaredNorm();
    force.segment(blocks[i].first, blocks[i].size()).noalias() += modal[i] * (factor * rates);
  }
  return power;
}

System::System(const Model& the_model, int threads)
    : model(the_model), assembler(the_model, threads), static_load(VectorX::Zero(the_model.dofs.size())) {
  damping.viscous = model.viscous_damping;
  for (const BlockRange& block : assembler.blocks()) damping.modal.emplace_back(block.size(), 0);
  member_load = assembler.member_loads(static_load, assembler.virgin_history()).norm();
  half_mass_ = 0.5 * mass().diagonal();
  for (int j = 0; j < mass().outerSize(); ++j) {
    for (SparseMatrix::InnerIterator it(mass(), j); it; ++it) {
      if (it.row() > j && it.value() != 0) mass_couplings_.push_back({static_cast<int>(it.row()), j, it.value()});
    }
  }
}

double System::kinetic_energy(const VectorX& velocity) const {
  double energy = half_mass_.dot(velocity.cwiseAbs2());
  for (const MassCoupling& m : mass_couplings_) energy += m.value * velocity[m.i] * velocity[m.j];
  return energy;
}

double System::negligible_force() const { return negligible_acceleration * mass().diagonal().norm() + member_load; }

void System::gaps(const VectorX& displacement, double time, VectorX& gap) const {
  gap.noalias() = contacts().jacobian * displacement;
  gap += contacts().initial_gap;
  for (std::size_t k = 0; model.moves_supports() && k < model.motions.size(); ++k) {
    if (model.support_effects[k].moves_gaps()) gap += model.motions[k].displacement_at(time) * model.support_effects[k].gap;
  }
}

void System::gap_rates(const VectorX& velocity, double time, VectorX& rate) const {
  rate.noalias() = contacts().jacobian * velocity;
  for (std::size_t k = 0; model.moves_supports() && k < model.motions.size(); ++k) {
    if (model.support_effects[k].moves_gaps()) rate += model.motions[k].velocity_at(time) * model.support_effects[k].gap;
  }
}

void System::place_supports(double time) {
  if (!model.moves_supports() || linear()) return;
  VectorX displacement = VectorX::Zero(model.dofs.full), force = VectorX::Zero(model.dofs.size());
  for (std::size_t k = 0; k < model.motions.size(); ++k) {
    const SupportEffect& effect = model.support_effects[k];
    if (effect.displacement.size() == 0) continue;
    const double d = model.motions[k].displacement_at(time);
    displacement += d * effect.displacement;
    force += d * effect.force;
  }
  assembler.move_supports(displacement, force);
}

VectorX System::support_forces(const VectorX& displacement, double time) const {
  const auto count = static_cast<Eigen::Index>(model.motions.size());
  VectorX forces = VectorX::Zero(count), d = VectorX::Zero(count);
  for (Eigen::Index k = 0; k < count; ++k) {
    const SupportEffect& effect = model.support_effects[static_cast<std::size_t>(k)];
    if (effect.displacement.size() == 0) continue;
    d[k] = model.motions[static_cast<std::size_t>(k)].displacement_at(time);
    forces[k] = effect.force.dot(displacement);
    if (!linear()) forces[k] += effect.displacement.dot(assembler.evaluated_force());
  }
  return forces + model.support_stiffness * d;
}

double System::support_kinetic_energy(const VectorX& velocity, double time) const {
  const auto count = static_cast<Eigen::Index>(model.motions.size());
  VectorX rates = VectorX::Zero(count);
  double energy = 0;
  for (Eigen::Index k = 0; k < count; ++k) {
    const auto at = static_cast<std::size_t>(k);
    if (model.support_effects[at].displacement.size() == 0) continue;
    rates[k] = model.motions[at].velocity_at(time);
    energy -= rates[k] * velocity.dot(model.motion_load[at]);  // -M s_k
  }
  return energy + 0.5 * rates.dot(model.support_mass * rates);
}

void System::load_impulse(double start, double end, VectorX& impulse) const {
  impulse = (end - start) * static_load;
  for (std::size_t i = 0; i < model.motions.size(); ++i) {
    const double velocity_change = model.motions[i].velocity_at(end) - model.motions[i].velocity_at(start);
    impulse += velocity_change * model.motion_load[i];
    if (model.moves_supports() && model.support_effects[i].displacement.size() > 0) {
      const double change = model.motions[i].displacement_at(end) - model.motions[i].displacement_at(start);
      impulse -= change * model.support_effects[i].damping;
    }
  }
}

}  // namespace nsframe
