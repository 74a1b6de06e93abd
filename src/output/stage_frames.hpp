// ParaView frames of static stages: `<folder>/<stage>/frames.pvd`, one frame a point, at the "time" of its number.
#pragma once

#include <filesystem>
#include <memory>

#include "output/vtk_frames.hpp"

namespace nsframe {

class StageFrames : public StageObserver {
 public:
  StageFrames(std::filesystem::path folder, const OutputOptions& options) : folder_(std::move(folder)), options_(options) {
    options_.frames = 1;
  }
  void start(const Model& model, const StaticStage& stage, const State& state) override {
    frames_ = std::make_unique<VtkFrames>(folder_ / stage.name, options_);
    number_ = 0;
    model_ = &model;
    (void)state;
  }
  void point(const StagePoint&, const State& state) override {
    State shown = state;
    shown.time = number_;
    if (number_++ == 0) {
      frames_->start(*model_, shown);
    } else {
      frames_->step(before_, shown, {}, {});
    }
    before_ = std::move(shown);
  }
  void finish(const StageResult&) override { frames_->finish(); }

 private:
  std::filesystem::path folder_;
  OutputOptions options_;
  const Model* model_ = nullptr;
  std::unique_ptr<VtkFrames> frames_;
  State before_;
  int number_ = 0;
};

}  // namespace nsframe
