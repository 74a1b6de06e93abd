// The load factor is led through its targets.
#include <algorithm>
#include <cmath>

#include "integrators/static_control.hpp"

namespace nsframe {

namespace {

class LoadControl : public StaticControl {
 public:
  explicit LoadControl(const ControlSetup& setup)
      : path_(setup.start.factor, setup.stage.options.targets, setup.stage.options.step, setup.stage.options.steps) {}

  bool done() const override { return path_.done(); }

  PlannedPoint next(const StaticPoint& committed) override {
    const double target = path_.next();
    const double tolerance = 1e-12 * std::max(std::abs(target), std::abs(committed.factor));
    const auto constraint = [=](const VectorX& q, double factor, StaticConstraint& c) {
      c.value = factor - target;
      c.tolerance = tolerance;
      c.by_displacement.setZero(q.size());
      c.by_factor = 1;
    };
    return {constraint, VectorX::Zero(committed.state.displacement.size()), 0};
  }

  bool accept(const StaticPoint&, const StaticPoint&, int) override {
    path_.accept();
    return true;
  }
  bool retreat() override { return path_.retreat(); }

 private:
  Path path_;
};

}  // namespace

std::unique_ptr<StaticControl> make_load_control(const ControlSetup& setup) { return std::make_unique<LoadControl>(setup); }

}  // namespace nsframe
