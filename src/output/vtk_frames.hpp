// ParaView frames: `frames.pvd` and `frames/frame_000123.vtu`, at a fixed rate of model time. Points are in the
// undeformed position, with the true displacement as a point vector, so that Warp By Vector works at any scale.
#pragma once

#include <filesystem>
#include <memory>

#include "models/analysis.hpp"
#include "models/results.hpp"

namespace nsframe {

// Point fields: displacement [m], rotation [rad], velocity [m/s] (and displacement_exaggerated when
// OutputOptions::amplification is not 1). Cell fields: kind (index into the field data kind_names), element (into
// element_ids), structure (into structure_names), pair (into pair_names), force (N VY VZ) [N], moment (T MY MZ) [N m],
// peak_strain_ratio, yielded, gap [m], impulse (since the frame before) [N s]; 0 where a field does not apply, -1 for
// an index that does not.
class VtkFrames : public Observer {
 public:
  // Writes nothing before start(). Does nothing at all when options.frames is 0.
  VtkFrames(std::filesystem::path folder, const OutputOptions& options);
  ~VtkFrames() override;

  void start(const Model& model, const State& state) override;
  void step(const State& before, const State& after, const StepReport& report, const Energy& energy) override;
  double next_history_time() const override;
  void finish() override;
  void save(Snapshot& snapshot) override;
  // Drops the frames after the snapshot and goes on.
  void resume(const Model& model, const State& state, const Snapshot& snapshot) override;

  double seconds() const;  // spent in this observer
  int frames() const;

 private:
  class Writer;
  std::unique_ptr<Writer> writer_;
};

}  // namespace nsframe
