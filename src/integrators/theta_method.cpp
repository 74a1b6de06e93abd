// The theta-method over a whole step. x is the mean velocity w:
//   R = M (w - v) + theta [h ((1 - theta) P(q) + theta P(q + h w)) + h C w - G],  dR/dw = J = M + a C + a^2 K,  a = theta h
//   q+ = q + h w,  v+ = v + (w - v) / theta                                                     (theory.md, section 3)
#include <fmt/format.h>

#include "integrators/flight_method.hpp"
#include "integrators/mode_response.hpp"

namespace nsframe {

namespace {

class ThetaMethod : public FlightMethod {
 public:
  ThetaMethod(const AnalysisOptions& options, const System& system)
      : options_(options), own_{IterationMatrix(system), system.initial_stiffness}, ladder_(options.algorithm),
        least_scale_(negligible_acceleration * system.mass().diagonal().norm()),
        massless_(massless_dofs(system)) {}

  void step(System& system, const FlightStep& step, Motion& end, StepResult& result) override;
  std::optional<double> dissipated(const System& system, const Motion& start, const Motion& end) const override {
    const VectorX dv = end.v - start.v;
    return (options_.theta - 0.5) * (dv.dot(system.mass() * dv) + end.change.dot(end.P - start.P));
  }
  Scheme::ModeResponse mode_response(double w, double xi, double h) const override {
    return theta_method_response(options_.theta, w, xi, h);
  }
  double part_theta() const override { return options_.theta; }
  long factorizations() const override { return own_.matrix.factorizations(); }
  void save(Snapshot& snapshot) const override { own_.save(snapshot, "theta_method"); }
  void restore(System& system, const Snapshot& snapshot) override { own_.restore(system, snapshot, "theta_method"); }
  std::string describe() const override {
    return options_.theta == 0.5 ? "the trapezoidal rule (theta = 0.5) between impacts"
                                 : fmt::format("the theta-method (theta = {:g}) between impacts", options_.theta);
  }

 private:
  class Step;
  const AnalysisOptions options_;
  FactoredStiffness own_;
  Ladder ladder_;
  double least_scale_;  // force that counts as zero [N]
  std::vector<Eigen::Index> massless_;
};

class ThetaMethod::Step : public NonlinearStep {
 public:
  Step(ThetaMethod& method, System& system, const FlightStep& step, Motion& end, const VectorX& load, VectorX guess, StepResult& result)
      : method_(method), system_(system), step_(step), end_(end), load_(load), guess_(std::move(guess)), result_(result) {}

  void restart() override {
    system_.assembler.start_step(step_.committed, step_.trial);
    mean = guess_;
    evaluate(false);
  }
  const VectorX& residual() const override { return residual_; }
  double error() const override { return result_.residual / method_.options_.newton_tolerance; }
  void factor(Tangent which) override {
    if (which == Tangent::current && !system_.assembler.tangent_is_current()) evaluate(true);
    FactoredStiffness& own = method_.own_;
    own.stiffness = which == Tangent::initial ? system_.initial_stiffness : system_.assembler.tangent();
    own.matrix.factor(system_, own.stiffness, method_.options_.theta * step_.length);
  }
  void solve(const VectorX& rhs, VectorX& x) override {
    method_.own_.matrix.solve(rhs, x);
    ++result_.solves;
  }
  void move(const VectorX& change) override {
    mean += change;
    evaluate(false);
  }
  bool guess_may_stand() const override { return true; }
  bool has_factors() const override { return method_.own_.matrix.ready(method_.options_.theta * step_.length); }
  double slow_reduction() const override { return 0.005; }

  VectorX mean;

 private:
  void evaluate(bool with_tangent) {
    const double theta = method_.options_.theta, h = step_.length;
    end_.q = step_.start.q + h * mean;
    system_.assembler.internal_force(end_.q, step_.committed, step_.trial, end_.P, with_tangent);
    ++result_.evaluations;
    const VectorX inertia = system_.mass() * (mean - step_.start.v);
    residual_ = h * ((1 - theta) * step_.start.P + theta * end_.P) - load_;
    system_.damping.add_force(system_.assembler.blocks(), h, mean, residual_);
    residual_ = inertia + theta * residual_;
    const double scale = inertia.norm() + theta * (h * (method_.least_scale_ + end_.P.norm()) + load_.norm());
    result_.residual = residual_.norm() / std::max(scale, 1e-300);
  }

  ThetaMethod& method_;
  System& system_;
  const FlightStep& step_;
  Motion& end_;
  const VectorX& load_;
  const VectorX guess_;
  StepResult& result_;
  VectorX residual_;
};

void ThetaMethod::step(System& system, const FlightStep& step, Motion& end, StepResult& result) {
  const double h = step.length, theta = options_.theta;
  if (!own_.matrix.ready(theta * h)) own_.matrix.factor(system, own_.stiffness, theta * h);
  VectorX load, mean;
  system.load_impulse(step.time, step.time + h, load);
  VectorX rhs = theta * (load - h * step.start.P);
  rhs.noalias() += system.mass() * step.start.v;
  own_.matrix.solve(rhs, mean);
  if (system.linear()) {
    end.q = step.start.q + h * mean;
    system.assembler.internal_force(end.q, step.committed, step.trial, end.P, false);
    ++result.evaluations;
  } else {
    Step problem(*this, system, step, end, load, std::move(mean), result);
    solve_flight(ladder_, problem, options_, system, step.time, result);
    mean = std::move(problem.mean);
  }
  end.v = step.start.v + (mean - step.start.v) / theta;
  end.a.resize(0);
  end.change = h * mean;
  for (const Eigen::Index i : massless_) end.v[i] = mean[i];
}

}  // namespace

std::unique_ptr<FlightMethod> make_theta_method(const AnalysisOptions& options, const System& system) {
  return std::make_unique<ThetaMethod>(options, system);
}

}  // namespace nsframe
