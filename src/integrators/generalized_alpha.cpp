#include "integrators/generalized_alpha.hpp"

#include <fmt/format.h>

#include "integrators/mode_response.hpp"

namespace nsframe {

namespace {

GeneralizedAlphaParameters second_order(double alpha_m, double alpha_f) {
  const double shift = alpha_f - alpha_m;
  return {alpha_m, alpha_f, 0.25 * (1 + shift) * (1 + shift), 0.5 + shift};
}

}  // namespace

GeneralizedAlphaParameters GeneralizedAlphaParameters::chung_hulbert(double rho) { return second_order((2 * rho - 1) / (rho + 1), rho / (rho + 1)); }

GeneralizedAlphaParameters GeneralizedAlphaParameters::hilber_hughes_taylor(double rho) { return second_order(0, (1 - rho) / (1 + rho)); }

Eigen::Matrix3d amplification(const GeneralizedAlphaParameters& p, double w, double xi, double h) {
  const double z = w * h, c = 2 * xi * z, k = z * z;  // of v h and q
  const Eigen::RowVector3d q(1, 1, 0.5 - p.beta), v(0, 1, 1 - p.gamma);  // q+ and h v+ without a+
  const Eigen::RowVector3d known(p.alpha_f * k, p.alpha_f * c, p.alpha_m);
  const Eigen::RowVector3d a = -(known + (1 - p.alpha_f) * (c * v + k * q)) / (1 - p.alpha_m + (1 - p.alpha_f) * (p.gamma * c + p.beta * k));
  Eigen::Matrix3d step;
  step << q + p.beta * a, v + p.gamma * a, a;
  return step;
}

Scheme::ModeResponse generalized_alpha_response(const GeneralizedAlphaParameters& p, double w, double xi, double h) {
  if (w == 0) return {0, 0};
  return response_of(amplification(p, w, xi, h), h);
}

// x is a+, R as in the header, divided by 1 - alpha_m.
class GeneralizedAlpha::Step : public FlightProblem {
 public:
  Step(GeneralizedAlpha& method, System& system, const FlightStep& step, const Start& start, Motion& end, VectorX guess, StepResult& result)
      : FlightProblem({method.own_, method.p_.damping(step.length), method.p_.stiffness(step.length)}, method.options_, system, step, end,
                      std::move(guess), result),
        method_(method), start_(start) {}

 private:
  void evaluate(bool with_tangent) override {
    const GeneralizedAlphaParameters& p = method_.p_;
    const double h = step_.length;
    end_.q = start_.q + (p.beta * h * h) * x;
    end_.v = start_.v + (p.gamma * h) * x;
    members(with_tangent);
    const VectorX inertia = (1 - p.alpha_m) * (system_.mass() * x);
    residual_ = inertia + start_.known + (1 - p.alpha_f) * end_.P;
    system_.damping.add_force(system_.assembler.blocks(), 1 - p.alpha_f, end_.v, residual_);
    measure(inertia.norm() + start_.known.norm() + (1 - p.alpha_f) * end_.P.norm() + method_.least_scale_);
    residual_ /= 1 - p.alpha_m;
  }

  const GeneralizedAlpha& method_;
  const Start& start_;
};

GeneralizedAlpha::GeneralizedAlpha(const AnalysisOptions& options, const System& system, const GeneralizedAlphaParameters& parameters,
                                   std::string name)
    : p_(parameters), own_{IterationMatrix(system), system.initial_stiffness}, massless_(massless_dofs(system)), options_(options),
      name_(std::move(name)), ladder_(options.algorithm), least_scale_(system.negligible_force()) {}

std::string GeneralizedAlpha::describe() const {
  return fmt::format("generalized-alpha between impacts (alpha_m = {:.4g}, alpha_f = {:.4g}, beta = {:.4g}, gamma = {:.4g}): of second order, waves "
                     "far above what steps resolve shrink to {:g} of themselves in each",
                     p_.alpha_m, p_.alpha_f, p_.beta, p_.gamma, options_.rho_infinity);
}

void GeneralizedAlpha::make_ready(const System& system, double h) {
  if (!own_.matrix.ready(p_.damping(h), p_.stiffness(h))) own_.matrix.factor(system, own_.stiffness, p_.damping(h), p_.stiffness(h));
}

GeneralizedAlpha::Start GeneralizedAlpha::begin(const System& system, const FlightStep& step, VectorX& a) {
  const double h = step.length;
  const auto& blocks = system.assembler.blocks();
  make_ready(system, h);
  VectorX load;
  if (a.size() == 0) {
    system.load_impulse(step.time, step.time + h, load);  // the load now, from the impulses of this step and of its first half
    VectorX half;
    system.load_impulse(step.time, step.time + 0.5 * h, half);
    VectorX residual = (4 * half - load) / h - step.start.P;
    system.damping.add_force(blocks, -1, step.start.v, residual);
    own_.matrix.solve(residual, a);
    VectorX momentum = system.mass() * a, again;
    system.damping.add_force(blocks, p_.damping(h), a, momentum);
    own_.matrix.solve(momentum, again);
    a = 2 * a - again;
    for (const Eigen::Index i : massless_) a[i] = 0;
  }
  const double middle = step.time + (1 - p_.alpha_f) * h;
  system.load_impulse(middle - 0.5 * h, middle + 0.5 * h, load);
  Start start;
  start.a = a;
  start.q = step.start.q + h * step.start.v + (h * h * (0.5 - p_.beta)) * a;
  start.v = step.start.v + (h * (1 - p_.gamma)) * a;
  start.known = p_.alpha_m * (system.mass() * a) + p_.alpha_f * step.start.P - load / h;
  system.damping.add_force(blocks, p_.alpha_f, step.start.v, start.known);
  return start;
}

VectorX GeneralizedAlpha::solve_linearised(const System& system, const Start& start, const VectorX& force) {
  VectorX rhs = -start.known - (1 - p_.alpha_f) * force, a;
  system.damping.add_force(system.assembler.blocks(), -(1 - p_.alpha_f), start.v, rhs);
  rhs /= 1 - p_.alpha_m;
  own_.matrix.solve(rhs, a);
  return a;
}

void GeneralizedAlpha::finish(const FlightStep& step, const Start& start, const VectorX& a, Motion& end) const {
  const double h = step.length;
  end.q = start.q + (p_.beta * h * h) * a;
  end.v = start.v + (p_.gamma * h) * a;
  end.a = a;
  end.change = h * step.start.v + (h * h) * ((0.5 - p_.beta) * start.a + p_.beta * a);
  for (const Eigen::Index i : massless_) {
    end.v[i] = end.change[i] / h;
    end.a[i] = 0;
  }
}

void GeneralizedAlpha::step(System& system, const FlightStep& step, Motion& end, StepResult& result) {
  VectorX a = step.start.a;
  const Start start = begin(system, step, a);
  VectorX predicted = step.start.P;
  predicted.noalias() += own_.stiffness * (start.q - step.start.q);
  VectorX next = solve_linearised(system, start, predicted);
  if (system.linear()) {
    finish(step, start, next, end);
    system.assembler.internal_force(end.q, step.committed, step.trial, end.P, false);
    ++result.evaluations;
    return;
  }
  Step problem(*this, system, step, start, end, std::move(next), result);
  solve_flight(ladder_, problem, options_, system, step.time, result);
  finish(step, start, problem.x, end);
}

std::unique_ptr<FlightMethod> make_generalized_alpha(const AnalysisOptions& options, const System& system) {
  return std::make_unique<GeneralizedAlpha>(options, system, GeneralizedAlphaParameters::chung_hulbert(options.rho_infinity), "generalized_alpha");
}

}  // namespace nsframe
