// What drives a static stage from point to point: load factor, a displacement, the arc length. A new control is one file
// with a class derived from StaticControl, one line in static_controls.cpp and one test.
#pragma once

#include <memory>

#include "integrators/static_step.hpp"
#include "models/static_stage.hpp"

namespace nsframe {

// The next point to look for: the equation that it fulfils, and where to begin.
struct PlannedPoint {
  ConstraintFunction constraint;
  VectorX change;              // of the displacement
  double factor_change = 0;
};

class StaticControl {
 public:
  virtual ~StaticControl() = default;
  virtual bool done() const = 0;
  virtual PlannedPoint next(const StaticPoint& committed) = 0;
  // The point was found; false when it is not to be kept, and next() says what to do instead.
  virtual bool accept(const StaticPoint& committed, const StaticPoint& found, int iterations) = 0;
  // The point was not found; false when a smaller step makes no sense any more.
  virtual bool retreat() = 0;
  // Why a stage cannot go on, beyond iterations that do not converge; empty: no reason of its own.
  virtual std::string complaint() const { return ""; }
};

// What a control may need to know of its stage.
struct ControlSetup {
  const StaticStage& stage;
  const Model& model;
  const StaticPoint& start;
  VectorX unit_response;       // K^-1 pattern at the start [m, rad]
};

// Throws InputError for an unknown name.
std::unique_ptr<StaticControl> make_control(const ControlSetup& setup);
std::vector<std::string> control_names();
// Stages that lack what their control needs, by place.
void check_stages(const std::vector<StaticStage>& stages, Diagnostics& diagnostics);

std::unique_ptr<StaticControl> make_load_control(const ControlSetup& setup);
std::unique_ptr<StaticControl> make_displacement_control(const ControlSetup& setup);
std::unique_ptr<StaticControl> make_arc_length(const ControlSetup& setup);

// A value led through targets by increments, smaller ones where a point was not found.
class Path {
 public:
  Path(double start, const std::vector<double>& targets, double step, int steps);
  bool done() const { return at_ == targets_.size(); }
  double next() const;
  double from() const { return from_; }
  void accept();
  bool retreat();

 private:
  void begin_branch();

  std::vector<double> targets_;
  double step_;
  int steps_;
  std::size_t at_ = 0;
  double from_;                // where the present branch began
  double count_ = 1;           // increments of the branch
  double reached_ = 0, increment_ = 1;  // in increments; powers of two, so that halves meet their wholes again
};

}  // namespace nsframe
