// Spectra of oscillators that stand on chosen nodes, driven by the nodes' absolute motion along x, y and z. An impact is
// a jump of the node's velocity, not a large acceleration over one step: the spectra don't grow as the step shrinks
// (theory.md, 124).
#pragma once

#include <map>
#include <string>
#include <vector>

#include "models/analysis.hpp"
#include "models/results.hpp"
#include "output/node_rows.hpp"
#include "spectra/oscillators.hpp"

namespace nsframe {

class FloorSpectra : public MotionObserver {
 public:
  // `dt`: of the steps [s]
  FloorSpectra(const FloorSpectraOptions& options, double dt);

  void start(const Model& model, const State& state) override;
  void step(const State& before, const State& after, const StepReport& report, const Energy& energy) override;
  void save(Snapshot& snapshot) override;
  void resume(const Model& model, const State& state, const Snapshot& snapshot) override;

  // Largest values, node by node and direction by direction; directions in which nothing moved are left out.
  std::vector<FloorSpectrumPeak> peaks() const;

  const std::vector<std::string>& nodes() const { return names_; }
  const std::vector<double>& periods() const { return periods_; }  // [s]
  double damping() const { return damping_; }
  // Largest relative displacements of the oscillators on a node (index into nodes()) along x, y or z [m].
  const std::vector<double>& displacement(std::size_t node, int direction) const {
    return oscillators_[3 * node + static_cast<std::size_t>(direction)].peak();
  }

 private:
  // All oscillators over part of a step, in millionths of it.
  void advance(long part);

  std::vector<std::string> names_;
  std::vector<double> periods_;
  double damping_, dt_;
  const Model* model_ = nullptr;
  std::vector<double> level_;
  TransformationRows rows_;
  std::vector<Oscillators> oscillators_;  // 3 a node
  std::vector<double> acceleration_;      // of the nodes over the step, 3 a node [m/s2]
  std::map<long, OscillatorStep> steps_;  // by their length in millionths of dt
  VectorX smooth_;                        // change of the velocities without the jumps
};

// Sentences about periods that the time step is too long for.
std::vector<std::string> spectrum_warnings(const FloorSpectra& spectra, double dt);

}  // namespace nsframe
