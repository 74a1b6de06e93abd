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
        least_scale_(system.negligible_force()),
        massless_(massless_dofs(system)) {}

  void step(System& system, const FlightStep& step, Motion& end, StepResult& result) override;
  std::optional<double> dissipated(const System& system, const Motion& start, const Motion& end) const override {
    const VectorX dv = end.v - start.v;
    return (options_.theta - 0.5) * (dv.dot(system.mass() * dv) + end.change.dot(end.P - start.P));
  }
  Scheme::ModeResponse mode_response(double w, double xi, double h) const override {
    return theta_method_response(options_.theta, w, xi, h);
  }
  PartRule part_rule() const override { return {options_.theta, 1}; }
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

class ThetaMethod::Step : public FlightProblem {
 public:
  Step(ThetaMethod& method, System& system, const FlightStep& step, Motion& end, const VectorX& load, VectorX guess, StepResult& result)
      : FlightProblem(factors(method, method.options_.theta * step.length), method.options_, system, step, end, std::move(guess), result),
        method_(method), load_(load) {}

 private:
  static Factors factors(ThetaMethod& method, double a) { return {method.own_, a, a * a}; }
  void evaluate(bool with_tangent) override {
    const double theta = method_.options_.theta, h = step_.length;
    end_.q = step_.start.q + h * x;
    members(with_tangent);
    const VectorX inertia = system_.mass() * (x - step_.start.v);
    residual_ = h * ((1 - theta) * step_.start.P + theta * end_.P) - load_;
    system_.damping.add_force(system_.assembler.blocks(), h, x, residual_);
    residual_ = inertia + theta * residual_;
    measure(inertia.norm() + theta * (h * (method_.least_scale_ + end_.P.norm()) + load_.norm()));
  }

  const ThetaMethod& method_;
  const VectorX& load_;
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
    mean = std::move(problem.x);
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
