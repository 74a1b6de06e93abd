// Newton's method; modified Newton, with the tangent of the step's start or the initial stiffness; and Newton with a line
// search on the work of the residual along the correction, d'R(x + s d), by regula falsi (Crisfield, Non-linear Finite
// Element Analysis 1, 1991, 9.2; Illinois variant of Dowell and Jarratt, BIT 11, 1971).
#include <algorithm>
#include <cmath>
#include <limits>

#include "integrators/algorithms.hpp"

namespace nsframe {

namespace {

class Newton : public Algorithm {
 public:
  bool evaluates_once() const override { return true; }
  void start() override { first_ = true; }
  void iterate(NonlinearStep& step) override {
    const double error = step.error();
    if (first_ ? !step.has_factors() : error > step.slow_reduction() * previous_) step.factor(Tangent::current);
    // the error of the first guess says nothing of the factors
    previous_ = first_ ? std::numeric_limits<double>::max() : error;
    first_ = false;
    step.solve(step.residual(), correction_);
    correction_ = -correction_;
    step.move(correction_);
  }

 private:
  VectorX correction_;
  double previous_ = 0;
  bool first_ = true;
};

class ModifiedNewton : public Algorithm {
 public:
  explicit ModifiedNewton(Tangent which) : which_(which) {}
  int patience() const override { return 5; }
  bool evaluates_once() const override { return true; }
  void start() override { first_ = true; }
  void iterate(NonlinearStep& step) override {
    if (first_) step.factor(which_);
    first_ = false;
    step.solve(step.residual(), correction_);
    correction_ = -correction_;
    step.move(correction_);
  }

 private:
  Tangent which_;
  VectorX correction_;
  bool first_ = true;
};

class LineSearch : public Algorithm {
 public:
  int patience() const override { return 2; }
  void start() override {}
  void iterate(NonlinearStep& step) override {
    step.factor(Tangent::current);
    step.solve(step.residual(), correction_);
    correction_ = -correction_;
    const double start = correction_.dot(step.residual());
    double low = 0, at_low = start, high = 1;
    step.move(correction_);
    double reached = 1, work = correction_.dot(step.residual()), at_high = work;
    for (int i = 0; i < most_trials && !(std::abs(work) <= enough * std::abs(start)); ++i) {
      double next = 0;
      if (!std::isfinite(work)) {
        next = 0.1 * reached;
      } else if ((at_low > 0) == (work > 0)) {
        break;  // no zero in between: the full step stands
      } else {
        next = low + (high - low) * at_low / (at_low - at_high);
      }
      next = std::clamp(next, least_step, 1.0);
      step.move((next - reached) * correction_);
      reached = next;
      work = correction_.dot(step.residual());
      if ((work > 0) == (at_high > 0)) {
        high = reached;
        at_high = work;
        at_low /= 2;  // Illinois
      } else {
        low = reached;
        at_low = work;
        at_high /= 2;
      }
      if (high - low < least_step) break;
    }
  }

 private:
  static constexpr int most_trials = 10;
  static constexpr double enough = 0.8, least_step = 1e-3;
  VectorX correction_;
};

}  // namespace

std::unique_ptr<Algorithm> make_newton() { return std::make_unique<Newton>(); }
std::unique_ptr<Algorithm> make_modified_newton(Tangent which) { return std::make_unique<ModifiedNewton>(which); }
std::unique_ptr<Algorithm> make_line_search() { return std::make_unique<LineSearch>(); }

}  // namespace nsframe
