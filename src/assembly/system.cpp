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

void Damping::add_force(const std::vector<BlockRange>& blocks, double factor, const VectorX& velocity,
                        VectorX& force) const {
  if (viscous.nonZeros() > 0) force.noalias() += factor * (viscous * velocity);
  if (tangent.nonZeros() > 0) force.noalias() += factor * (tangent * velocity);
  for (std::size_t i = 0; i < modal.size(); ++i) {
    if (modal[i].cols() == 0) continue;
    const VectorX rates = modal[i].transpose() * velocity.segment(blocks[i].first, blocks[i].size());
    force.segment(blocks[i].first, blocks[i].size()).noalias() += modal[i] * (factor * rates);
  }
}

System::System(const Model& the_model, int threads)
    : model(the_model), assembler(the_model, threads), static_load(VectorX::Zero(the_model.dofs.size())) {
  damping.viscous = model.viscous_damping;
  for (const BlockRange& block : assembler.blocks()) damping.modal.emplace_back(block.size(), 0);
  const VectorX virgin = assembler.virgin_history();
  VectorX loaded = virgin;
  assembler.set_load_factor(1, loaded);
  if (loaded == virgin) return;
  VectorX trial = virgin, with = static_load, without = static_load;
  assembler.internal_force(static_load, virgin, trial, without, false);
  trial = loaded;
  assembler.internal_force(static_load, loaded, trial, with, false);
  member_load = (with - without).norm();
}

void System::load_impulse(double start, double end, VectorX& impulse) const {
  impulse = (end - start) * static_load;
  for (std::size_t i = 0; i < model.motions.size(); ++i) {
    const double velocity_change = model.motions[i].velocity_at(end) - model.motions[i].velocity_at(start);
    impulse += velocity_change * model.motion_load[i];
  }
}

}  // namespace nsframe
