#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "base/errors.hpp"
#include "integrators/flight_method.hpp"

namespace nsframe {

namespace {

using Factory = std::unique_ptr<FlightMethod> (*)(const AnalysisOptions&, const System&);

const std::map<std::string, Factory>& flight_factories() {
  static const std::map<std::string, Factory> methods{
      {"alpha-os", make_alpha_os},
      {"generalized-alpha", make_generalized_alpha},
      {"theta", make_theta_method},
  };
  return methods;
}

}  // namespace

std::vector<std::string> flight_method_names() {
  std::vector<std::string> names;
  for (const auto& entry : flight_factories()) names.push_back(entry.first);
  return names;
}

std::unique_ptr<FlightMethod> make_flight_method(const AnalysisOptions& options, const System& system) {
  const auto found = flight_factories().find(options.integrator);
  if (found == flight_factories().end()) {
    throw InputError(fmt::format("error: integrator '{}' is not known{}", options.integrator,
                                 did_you_mean(options.integrator, flight_method_names())));
  }
  return found->second(options, system);
}

void FactoredStiffness::restore(System& system, const Snapshot& snapshot, const std::string& name) {
  matrix.restore(system, snapshot, name);
  const std::vector<double>& factored = snapshot.array(name + ".stiffness");
  if (!factored.empty()) std::copy(factored.begin(), factored.end(), stiffness.valuePtr());
}

std::vector<Eigen::Index> massless_dofs(const System& system) {
  const VectorX mass = system.mass().diagonal();
  std::vector<Eigen::Index> found;
  for (Eigen::Index i = 0; i < mass.size(); ++i) {
    if (!(mass[i] > 0)) found.push_back(i);
  }
  return found;
}

FlightProblem::FlightProblem(const Factors& factors, const AnalysisOptions& options, System& system, const FlightStep& step, Motion& end,
                             VectorX guess, StepResult& result)
    : system_(system), step_(step), end_(end), factors_(factors), options_(options), guess_(std::move(guess)), result_(result) {}

void FlightProblem::restart() {
  settling_ = false;
  system_.assembler.start_step(step_.committed, step_.trial);
  x = guess_;
  evaluate(false);
}

void FlightProblem::factor(Tangent which) {
  if (which == Tangent::current && !system_.assembler.tangent_is_current()) evaluate(true);
  FactoredStiffness& own = factors_.own;
  own.stiffness = which == Tangent::initial ? system_.initial_stiffness : system_.assembler.tangent();
  own.matrix.factor(system_, own.stiffness, factors_.a, factors_.b);
}

void FlightProblem::solve(const VectorX& rhs, VectorX& solution) {
  factors_.own.matrix.solve(rhs, solution);
  ++result_.solves;
}

void FlightProblem::move(const VectorX& change) {
  x += change;
  evaluate(false);
}

void FlightProblem::settle() {
  if (!system_.assembler.unsettled()) return;
  settling_ = true;
  evaluate(false);
  settling_ = false;
}

void FlightProblem::members(bool with_tangent) {
  const StateDetermination how = settling_ ? StateDetermination::remaining : determination();
  system_.assembler.internal_force(end_.q, step_.committed, step_.trial, end_.P, with_tangent, how);
  if (!settling_) ++result_.evaluations;
}

void solve_flight(Ladder& ladder, NonlinearStep& problem, const AnalysisOptions& options, const System& system, double time,
                  StepResult& result) {
  if (!ladder.climb(problem, options.max_newton, result.attempts)) {
    throw ConvergenceError(fmt::format("the step at t = {:.6g} s did not converge {}; tried: {}", time,
                                       told_residual(result.residual, system.assembler.worst_element(problem.residual())),
                                       tried(result.attempts)));
  }
  int iterations = 0;
  for (const Attempt& attempt : result.attempts) iterations += attempt.iterations;
  result.newton_iterations += iterations;
  result.guess_stood = iterations == 0;
}

}  // namespace nsframe
