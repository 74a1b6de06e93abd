// Broyden's first method with the tangent of the step's start (Kelley, Iterative Methods for Linear and Nonlinear
// Equations, 1995, algorithm brsol): rank-one updates J + (R+ - R - J s) s'/|s|^2, kept as the steps s alone. Unlike BFGS
// it doesn't need a symmetric tangent, which P-Delta and displacement control don't have.
#include <cmath>

#include "base/errors.hpp"
#include "integrators/algorithms.hpp"

namespace nsframe {

namespace {

class Broyden : public Algorithm {
 public:
  int patience() const override { return 3; }
  void start() override { steps_.clear(); }

  void iterate(NonlinearStep& step) override {
    if (steps_.empty() || static_cast<int>(steps_.size()) == most_updates) {
      steps_.clear();
      step.factor(Tangent::current);
    }
    VectorX z;
    step.solve(step.residual(), z);
    z = -z;
    for (std::size_t j = 0; j + 1 < steps_.size(); ++j) {
      z += steps_[j + 1] * (steps_[j].dot(z) / steps_[j].squaredNorm());
    }
    if (!steps_.empty()) {
      const VectorX& last = steps_.back();
      const double left = 1 - last.dot(z) / last.squaredNorm();
      if (!(std::abs(left) > 1e-8)) throw ConvergenceError("an update made the matrix singular");
      z /= left;
    }
    steps_.push_back(z);
    step.move(steps_.back());
  }

 private:
  static constexpr int most_updates = 15;  // after which the tangent is formed anew
  std::vector<VectorX> steps_;
};

}  // namespace

std::unique_ptr<Algorithm> make_broyden() { return std::make_unique<Broyden>(); }

}  // namespace nsframe
