// A simulation of the smaller model that a scheme may do with, shown to observers as one of the model that the scene describes:
// supports that move relative to the base are taken out, and DOFs without mass condensed where the scheme does not do so itself and
// the factors get no dearer (src/assembly/moved_supports.hpp, condensation.hpp).
#pragma once

#include <optional>

#include "assembly/condensation.hpp"
#include "assembly/moved_supports.hpp"
#include "integrators/simulation.hpp"

namespace nsframe {

class ReducedSimulation {
 public:
  // `model` must outlive it. Throws as Simulation does.
  ReducedSimulation(const Model& model, const AnalysisOptions& options);
  ReducedSimulation(const ReducedSimulation&) = delete;  // simulation_ refers to the models here
  ReducedSimulation& operator=(const ReducedSimulation&) = delete;

  // Of the smaller model.
  Simulation& simulation() { return *simulation_; }
  // As Simulation::run(); observers see `model` and its states.
  Summary run(const std::vector<Observer*>& observers, const RunControl& control = {},
              const std::vector<StageObserver*>& stage_observers = {});
  // The model of the scene with all its free DOFs, those included that are condensed, without those that motions prescribe.
  const Model& held() const;
  // What `nsframe check` says of it, a line each.
  std::vector<std::string> describe() const;

 private:
  const Model& model_;
  Condensation condensation_;
  std::optional<LargerModel> larger_;  // what observers are shown, where simulation_ has a smaller one
  Model held_, smaller_;  // without moved supports; and without condensed DOFs
  std::optional<Simulation> simulation_;
};

}  // namespace nsframe
