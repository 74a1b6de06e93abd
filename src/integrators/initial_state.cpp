#include "integrators/initial_state.hpp"

#include <fmt/format.h>

#include "base/diagnostics.hpp"
#include "integrators/static_analysis.hpp"

namespace nsframe {

void find_initial_state(System& system, State& state) {
  const Model& model = system.model;
  system.static_load = model.gravity_load;
  const bool statically = model.gravity_statically_first && model.loaded();
  const bool pretensioned = state.internal_force.cwiseAbs().maxCoeff() > 0;
  if (statically) {
    for (const Structure& structure : model.structures) {
      if (structure.may_move_freely) {
        Diagnostics diagnostics;
        diagnostics.error(structure.at, fmt::format("gravity cannot act statically on structure '{}', which may move freely; "
                                                    "set statically_first = false in [gravity]", structure.name));
        diagnostics.throw_if_any();
      }
    }
  }
  if (statically || pretensioned) {
    const VectorX load = statically ? model.gravity_load : VectorX::Zero(model.dofs.size());
    solve_static(system, load, StaticOptions{}, state);
  }
  const bool loads_act_suddenly = system.assembler.load_factor(state.history) != 1;
  if (model.initial_displacement.cwiseAbs().maxCoeff() > 0 || loads_act_suddenly) {
    State displaced = state;
    displaced.displacement += model.initial_displacement;
    system.assembler.start_step(state.history, displaced.history);
    system.assembler.set_load_factor(1, displaced.history);
    system.assembler.internal_force(displaced.displacement, state.history, displaced.history, displaced.internal_force);
    state = displaced;
  }
  state.velocity = model.initial_velocity;
}

}  // namespace nsframe
