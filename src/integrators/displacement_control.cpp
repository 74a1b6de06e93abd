// One displacement is led through its targets, the load factor follows (Batoz and Dhatt, Int. J. Numer. Meth. Eng. 14,
// 1979, 1262-1267).
#include <algorithm>
#include <cmath>

#include "integrators/static_control.hpp"

namespace nsframe {

namespace {

double start_of(const ControlSetup& setup) { return setup.stage.control_row.dot(setup.start.state.displacement); }

std::vector<double> targets_of(const ControlSetup& setup) {
  std::vector<double> targets = setup.stage.options.targets;
  if (setup.stage.options.relative) {
    for (double& target : targets) target += start_of(setup);
  }
  return targets;
}

class DisplacementControl : public StaticControl {
 public:
  explicit DisplacementControl(const ControlSetup& setup)
      : row_(setup.stage.control_row),
        path_(start_of(setup), targets_of(setup), setup.stage.options.step, setup.stage.options.steps) {}

  bool done() const override { return path_.done(); }

  PlannedPoint next(const StaticPoint& committed) override {
    const double target = path_.next(), now = row_.dot(committed.state.displacement);
    const double tolerance = 1e-10 * std::abs(target - now) + 1e-14 * std::max(std::abs(target), std::abs(now));
    const auto constraint = [this, target, tolerance](const VectorX& q, double, StaticConstraint& c) {
      c.value = row_.dot(q) - target;
      c.tolerance = tolerance;
      c.by_displacement = row_;
      c.by_factor = 0;
    };
    return {constraint, VectorX::Zero(committed.state.displacement.size()), 0};
  }

  bool accept(const StaticPoint&, const StaticPoint&, int) override {
    path_.accept();
    return true;
  }
  bool retreat() override { return path_.retreat(); }

 private:
  VectorX row_;
  Path path_;
};

}  // namespace

std::unique_ptr<StaticControl> make_displacement_control(const ControlSetup& setup) {
  return std::make_unique<DisplacementControl>(setup);
}

}  // namespace nsframe
