// The solution algorithms on small systems with known roots.
#include <doctest/doctest.h>

#include <cmath>

#include "base/decompositions.hpp"
#include "base/errors.hpp"
#include "integrators/algorithms.hpp"

using namespace nsframe;

namespace {

// R(x) = K x + stiffening x^3 - load of a chain of springs; J without symmetry when `twist` is not zero.
class Chain : public NonlinearStep {
 public:
  Chain(int size, double stiffening, double twist) : stiffening_(stiffening) {
    K_ = 2 * MatrixX::Identity(size, size);
    for (int i = 0; i + 1 < size; ++i) {
      K_(i, i + 1) = -1 + twist;
      K_(i + 1, i) = -1 - twist;
    }
  }
  void restart() override { x = VectorX::Zero(K_.rows()); evaluate(); }
  const VectorX& residual() const override { return residual_; }
  double error() const override { return residual_.norm() / 1e-10; }
  void factor(Tangent which) override {
    MatrixX J = K_;
    if (which == Tangent::current) J.diagonal().array() += 3 * stiffening_ * x.array().square();
    factor_.compute(J);
    ++factorizations;
  }
  void solve(const VectorX& rhs, VectorX& solution) override { solution = factor_.solve(rhs); }
  void move(const VectorX& change) override { x += change; evaluate(); }

  VectorX x;
  int factorizations = 0;

 private:
  void evaluate() { residual_ = K_ * x + stiffening_ * x.array().cube().matrix() - VectorX::Ones(x.size()); }
  MatrixX K_;
  double stiffening_;
  VectorX residual_;
  Eigen::PartialPivLU<MatrixX> factor_;
};

// R(x) = atan(x) - atan(1), from x = 4, where Newton's method runs away.
class Saturating : public NonlinearStep {
 public:
  void restart() override { x = VectorX::Constant(1, 4); evaluate(); }
  const VectorX& residual() const override { return residual_; }
  double error() const override { return std::abs(residual_[0]) / 1e-12; }
  void factor(Tangent which) override { slope_ = which == Tangent::initial ? 1 : 1 / (1 + x[0] * x[0]); }
  void solve(const VectorX& rhs, VectorX& solution) override { solution = rhs / slope_; }
  void move(const VectorX& change) override { x += change; evaluate(); }
  VectorX x;

 private:
  void evaluate() { residual_ = VectorX::Constant(1, std::atan(x[0]) - std::atan(1.0)); }
  VectorX residual_;
  double slope_ = 1;
};

Attempt only(NonlinearStep& step, const std::string& name, int iterations = 30) {
  std::vector<Attempt> attempts;
  Ladder({name}).climb(step, iterations, attempts);
  return attempts.front();
}

}  // namespace

TEST_CASE("every algorithm finds the same equilibrium, with and without a symmetric tangent") {
  for (const double twist : {0.0, 0.3}) {
    Chain reference(5, 0.002, twist);
    REQUIRE(only(reference, "newton").converged);
    for (const std::string& name : algorithm_names()) {
      CAPTURE(name);
      Chain chain(5, 0.002, twist);
      CHECK(only(chain, name, 60).converged);
      CHECK((chain.x - reference.x).norm() < 1e-9);  // the tolerance over the smallest stiffness
    }
  }
}

TEST_CASE("acceleration takes fewer iterations than modified Newton from the same tangent") {
  Chain modified(5, 0.002, 0), krylov(5, 0.002, 0), broyden(5, 0.002, 0), bfgs(5, 0.002, 0);
  const int slow = only(modified, "modified", 60).iterations;
  CHECK(modified.factorizations == 1);
  CHECK(only(krylov, "krylov").iterations < slow);
  CHECK(only(broyden, "broyden").iterations < slow);
  CHECK(only(bfgs, "bfgs").iterations < slow);
  CHECK(krylov.factorizations <= 2);
  CHECK(broyden.factorizations == 1);
  CHECK(bfgs.factorizations == 1);
}

TEST_CASE("acceleration and updates solve a linear system with a wrong matrix in as many iterations as it has unknowns") {
  // J0 = K at x = 0; a linear problem whose matrix differs from J0 in two directions
  class Wrong : public NonlinearStep {
   public:
    void restart() override { x = VectorX::Zero(6); evaluate(); }
    const VectorX& residual() const override { return residual_; }
    double error() const override { return residual_.norm() / 1e-12; }
    void factor(Tangent) override {}
    void solve(const VectorX& rhs, VectorX& solution) override { solution = rhs; }
    void move(const VectorX& change) override { x += change; evaluate(); }
    VectorX x;

   private:
    void evaluate() {
      MatrixX A = MatrixX::Identity(6, 6);
      A(0, 0) = 0.2;
      A(3, 3) = 3;
      residual_ = A * x - VectorX::Ones(6);
    }
    VectorX residual_;
  };
  Wrong krylov, broyden;
  // a subspace of two directions, the first iteration, and one for what rounding leaves
  CHECK(only(krylov, "krylov", 2).converged);
  CHECK(only(broyden, "broyden", 4).converged);
  CHECK((krylov.x - broyden.x).norm() < 1e-11);
}

TEST_CASE("where Newton runs away, the line search converges, and the ladder says so") {
  Saturating newton;
  const Attempt failed = only(newton, "newton");
  CHECK_FALSE(failed.converged);
  Saturating step;
  std::vector<Attempt> attempts;
  CHECK(Ladder({"auto"}).climb(step, 30, attempts));
  REQUIRE(attempts.size() == 2);
  CHECK(attempts[0].algorithm == "newton");
  CHECK_FALSE(attempts[0].converged);
  CHECK(attempts[1].algorithm == "line-search");
  CHECK(attempts[1].converged);
  CHECK(step.x[0] == doctest::Approx(1).epsilon(1e-10));
  CHECK(tried(attempts).find("line-search (") != std::string::npos);
}

TEST_CASE("a ladder of one's own choice stops at its end") {
  Saturating step;
  std::vector<Attempt> attempts;
  CHECK_FALSE(Ladder({"newton", "newton"}).climb(step, 5, attempts));
  CHECK(attempts.size() == 2);
  CHECK_THROWS_WITH_AS(Ladder({"newtn"}), "error: algorithm 'newtn' is not known; did you mean 'newton'?", InputError);
}
