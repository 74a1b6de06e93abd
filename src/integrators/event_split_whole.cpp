// Whole steps of the scheme `event-split` without contact, by the solution algorithms (theory.md, section 20).
#include <fmt/format.h>

#include "base/errors.hpp"
#include "integrators/event_split.hpp"

namespace nsframe {

// x is the mean velocity w: R = M (w - v) + theta [h ((1 - theta) P(q) + theta P(q + h w)) + h C w - G], dR/dw = J.
class EventSplit::WholeStep : public NonlinearStep {
 public:
  WholeStep(EventSplit& scheme, System& system, double time, StepResult& result)
      : scheme_(scheme), system_(system), q_(scheme.q_), v_(scheme.v_), before_(scheme.force_), guess_(scheme.flow_.mean_velocity(scheme.step_length_)),
        h_(scheme.step_length_), result_(result) {
    system.load_impulse(time, time + h_, load_);
  }

  void restart() override {
    system_.assembler.start_step(*scheme_.from_, *scheme_.to_);
    mean = guess_;
    evaluate(false);
  }
  const VectorX& residual() const override { return residual_; }
  double error() const override { return result_.residual / scheme_.options_.newton_tolerance; }
  void factor(Tangent which) override {
    if (which == Tangent::current && !system_.assembler.tangent_is_current()) evaluate(true);
    scheme_.stiffness_ = which == Tangent::initial ? system_.initial_stiffness : system_.assembler.tangent();
    scheme_.matrix_.factor(system_, scheme_.stiffness_, scheme_.options_.theta * h_);
  }
  void solve(const VectorX& rhs, VectorX& x) override {
    scheme_.matrix_.solve(rhs, x);
    ++result_.solves;
  }
  void move(const VectorX& change) override {
    mean += change;
    evaluate(false);
  }
  bool guess_may_stand() const override { return true; }
  bool has_factors() const override { return scheme_.matrix_.ready(scheme_.options_.theta * h_); }
  double slow_reduction() const override { return 0.005; }

  VectorX mean;

 private:
  void evaluate(bool with_tangent) {
    const double theta = scheme_.options_.theta;
    scheme_.q_ = q_ + h_ * mean;
    system_.assembler.internal_force(scheme_.q_, *scheme_.from_, *scheme_.to_, scheme_.force_, with_tangent);
    ++result_.evaluations;
    const VectorX inertia = system_.mass() * (mean - v_);
    residual_ = h_ * ((1 - theta) * before_ + theta * scheme_.force_) - load_;
    system_.damping.add_force(system_.assembler.blocks(), h_, mean, residual_);
    residual_ = inertia + theta * residual_;
    const double scale = inertia.norm() + theta * (h_ * (scheme_.least_scale_ + scheme_.force_.norm()) + load_.norm());
    result_.residual = residual_.norm() / std::max(scale, 1e-300);
  }

  EventSplit& scheme_;
  System& system_;
  const VectorX q_, v_, before_, guess_;
  double h_;
  StepResult& result_;
  VectorX load_, residual_;
};

void EventSplit::take_whole(System& system, double time, StepResult& result) {
  const VectorX old_velocity = v_, old_force = force_;
  if (system.linear()) {
    q_ += step_length_ * flow_.mean_velocity(step_length_);
    flow_.velocity(step_length_, v_);
    system.assembler.internal_force(q_, *from_, *to_, force_, false);
    ++result.evaluations;
  } else {
    WholeStep problem(*this, system, time, result);
    if (!ladder_.climb(problem, options_.max_newton, result.attempts)) {
      throw ConvergenceError(fmt::format("the step at t = {:.6g} s did not converge (relative residual {:.1e}), largest in element '{}'; tried: {}",
                                         time, result.residual, system.assembler.worst_element(problem.residual()), tried(result.attempts)));
    }
    for (const Attempt& attempt : result.attempts) result.newton_iterations += attempt.iterations;
    result.guess_stood = result.newton_iterations == 0;
    flow_.set_whole(problem.mean);
    flow_.velocity(step_length_, v_);
    from_ = to_;
    std::swap(to_, other_);
  }
  account(system, time, step_length_, step_length_ * flow_.mean_velocity(step_length_), old_velocity, old_force, result);
}

}  // namespace nsframe
