// results.h5: the histories that a scene asks for, impacts and poundings, the final energies, and the scene itself.
#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "models/analysis.hpp"
#include "models/results.hpp"

namespace nsframe {

class FloorSpectra;

// Layout (n rows of time, the first is the initial state; units and component names are attributes):
//   /time (n)
//   /nodes/id (m); displacement, velocity, acceleration_absolute (n, m, 6)
//   /elements/<kind>/id (k); forces (n, k, 12) in local axes, acting on the ends
//   /sections/<kind>/element (p), position (p); deformation, force (n, p, 3); peak_strain_ratio, yielded (n, p)
//   /fibers/<kind>/element, point, position, y, z, area, material (f); strain, stress, yielded (n, f)
//   /contacts/pair (c); gap, impulse (n, c), the impulse since the row before
//   /energy/kinetic, strain, damping, contact, friction, numerical, input, balance_error (n); final values as attributes
//   /ground/acceleration, velocity (n, 3)
//   /impacts/time, pair, approach_velocity, impulse, rate_before, rate_after (i)
//   /poundings/time, duration, pair, approach_velocity, impulse, effective_restitution, impacts
//   /floor_spectra/node (m), period (p); displacement, pseudo_velocity, pseudo_acceleration (m, 3, p), along x, y, z
//   /static/<stage>/load_factor, control_displacement, iterations (n, the first row is the start), and below it nodes (but
//     for velocity and acceleration, which are zero), elements, sections and fibers as above; attributes control, at, completed
//   /model, what stands where: model_tables.hpp
//   /scene, the complete scene as text; attributes program, version, finished
// Only histories named in OutputOptions::history have rows; without any, a step costs nothing.
// Rows are written in blocks and flushed, so that after a crash everything but the last block is readable, and a run
// can be resumed from its last snapshot.
class HistoryFile : public Observer {
 public:
  // `spectra`: to write when the run ends; may be null.
  HistoryFile(std::filesystem::path path, const OutputOptions& options, std::string scene_text,
              const FloorSpectra* spectra = nullptr);
  ~HistoryFile() override;

  // Creates the file; an earlier one at `path` is replaced here, not before.
  void start(const Model& model, const State& state) override;
  void step(const State& before, const State& after, const StepReport& report, const Energy& energy) override;
  double next_history_time() const override;
  void impact(const Impact& impact) override;
  void finish() override;
  void save(Snapshot& snapshot) override;
  // Opens the existing file, drops the rows after the snapshot and goes on with it.
  void resume(const Model& model, const State& state, const Snapshot& snapshot) override;

  double seconds() const;  // spent writing blocks

  // Watches the static stages that come before start(), or are all that there is: then close() ends the file.
  StageObserver& stages();
  void close();

 private:
  class Writer;
  std::unique_ptr<Writer> writer_;
};

}  // namespace nsframe
