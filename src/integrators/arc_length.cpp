// The length of the path in displacements, and load factor, is led on (Riks, Int. J. Solids Struct. 15, 1979, 529-551;
// Crisfield, Comput. Struct. 13, 1981, 55-62): |dq|^2 + psi^2 dfactor^2 = l^2 with translations only in |dq|, psi = 0 for
// the cylindrical form; the spherical one takes for psi the elastic displacement of load factor 1, so that both terms are
// lengths. The constraint is linearised with everything else (theory.md, 93): no root to choose. Its length follows the
// iterations that a point takes (Ramm, 1981); the last point is found by displacement control, at the target.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "integrators/static_control.hpp"

namespace nsframe {

namespace {

constexpr double wanted_iterations = 5;
constexpr double turned_back = -0.99;  // cosine to the last increment, beyond which it is the way back
constexpr double longest = 4, shortest = 1.0 / 4096;  // arcs, relative to the first

class ArcLength : public StaticControl {
 public:
  explicit ArcLength(const ControlSetup& setup) : row_(setup.stage.control_row), most_points_(setup.stage.options.max_points) {
    const DofMap& dofs = setup.model.dofs;
    weight_ = VectorX::Zero(dofs.size());
    for (int i = 0; i < dofs.size(); ++i) weight_[i] = dofs.free[static_cast<std::size_t>(i)].direction < 3 ? 1 : 0;
    const StageOptions& options = setup.stage.options;
    const double start = row_.dot(setup.start.state.displacement);
    target_ = options.targets.front() + (options.relative ? start : 0);
    const double way = target_ - start, unit = row_.dot(setup.unit_response);
    if (weight_.isZero(0) || !(norm(setup.unit_response) > 0)) weight_.setOnes();
    const double response = norm(setup.unit_response);
    psi_ = options.arc == ArcKind::spherical ? response : 0;
    done_ = way == 0;
    // the first arc moves the control DOF by a step on the elastic structure, towards the target
    const double step = options.step > 0 ? options.step : std::abs(way) / options.steps;
    const double lead = std::max(std::abs(unit), 1e-6 * response);
    first_factor_ = std::copysign(step / lead, unit * way == 0 ? way : unit * way);
    first_change_ = first_factor_ * setup.unit_response;
    arc_ = first_arc_ = length(first_change_, first_factor_);
    direction_ = std::copysign(1.0, way);
  }

  bool done() const override { return done_; }

  PlannedPoint next(const StaticPoint& committed) override {
    if (landing_) return landing(committed);
    VectorX change = previous_arc_ > 0 ? VectorX(previous_change_ * (arc_ / previous_arc_)) : VectorX(first_change_ * (arc_ / first_arc_));
    const double factor = previous_arc_ > 0 ? previous_factor_ * (arc_ / previous_arc_) : first_factor_ * (arc_ / first_arc_);
    const auto constraint = [this, q0 = committed.state.displacement, factor0 = committed.factor](const VectorX& q, double f,
                                                                                                   StaticConstraint& c) {
      const VectorX dq = q - q0;
      const double df = f - factor0;
      // divided by 2 l: a length, as in displacement control
      c.value = (dq.dot(weight_.cwiseProduct(dq)) + psi_ * psi_ * df * df - arc_ * arc_) / (2 * arc_);
      c.tolerance = 1e-9 * arc_;
      c.by_displacement = weight_.cwiseProduct(dq) / arc_;
      c.by_factor = psi_ * psi_ * df / arc_;
    };
    return {constraint, change, factor};
  }

  bool accept(const StaticPoint& committed, const StaticPoint& found, int iterations) override {
    if (landing_) {
      done_ = true;
      return true;
    }
    const VectorX change = found.state.displacement - committed.state.displacement;
    const double factor = found.factor - committed.factor;
    if (previous_arc_ > 0) {
      const double along = change.dot(weight_.cwiseProduct(previous_change_)) + psi_ * psi_ * factor * previous_factor_;
      if (along < turned_back * length(change, factor) * previous_arc_) {  // the other root: a shorter arc
        if (retreat()) return false;
        complaint_ = fmt::format("the path turns back on itself at load factor {:.6g}", committed.factor);
        return false;
      }
    }
    if (direction_ * (row_.dot(found.state.displacement) - target_) >= 0) {
      landing_ = true;
      return false;
    }
    if (++points_ >= most_points_) {
      complaint_ = fmt::format("the target is not reached after {} points", points_);
      return false;
    }
    previous_change_ = change;
    previous_factor_ = factor;
    previous_arc_ = length(change, factor);
    const double change_of_arc = std::sqrt(wanted_iterations / std::max(1, iterations));
    arc_ = std::min(arc_ * std::clamp(change_of_arc, 0.5, 2.0), longest * first_arc_);
    return true;
  }

  bool retreat() override {
    if (landing_) {  // e.g. the path turns before the target: nearer by a shorter arc
      landing_ = false;
    }
    arc_ /= 2;
    return arc_ >= shortest * first_arc_;
  }
  std::string complaint() const override { return complaint_; }

 private:
  double norm(const VectorX& q) const { return std::sqrt(q.dot(weight_.cwiseProduct(q))); }
  double length(const VectorX& q, double factor) const { return std::hypot(norm(q), psi_ * factor); }

  PlannedPoint landing(const StaticPoint& committed) const {
    const double now = row_.dot(committed.state.displacement);
    const double tolerance = 1e-10 * std::abs(target_ - now) + 1e-14 * std::max(std::abs(target_), std::abs(now));
    const auto constraint = [this, tolerance](const VectorX& q, double, StaticConstraint& c) {
      c.value = row_.dot(q) - target_;
      c.tolerance = tolerance;
      c.by_displacement = row_;
      c.by_factor = 0;
    };
    return {constraint, VectorX::Zero(committed.state.displacement.size()), 0};
  }

  VectorX row_, weight_;
  double target_ = 0, direction_ = 1, psi_ = 0;
  double arc_ = 0, first_arc_ = 0, first_factor_ = 0;
  VectorX first_change_, previous_change_;
  double previous_factor_ = 0, previous_arc_ = 0;
  int points_ = 0, most_points_;
  bool landing_ = false, done_ = false;
  std::string complaint_;
};

}  // namespace

std::unique_ptr<StaticControl> make_arc_length(const ControlSetup& setup) { return std::make_unique<ArcLength>(setup); }

}  // namespace nsframe
