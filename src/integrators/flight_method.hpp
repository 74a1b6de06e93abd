// How the scheme `event-split` moves over a whole step without contact: the time integration methods of its option `integrator`. A new
// method is one file with a class derived from FlightMethod, one line in flight_methods.cpp and one test.
#pragma once

#include <algorithm>
#include <optional>

#include "integrators/algorithms.hpp"
#include "integrators/iteration_matrix.hpp"
#include "integrators/part_flow.hpp"
#include "integrators/scheme.hpp"

namespace nsframe {

// Where the motion stands, in free DOFs.
struct Motion {
  VectorX q, v, P;  // displacement [m, rad], velocity, internal force [N, N m]
  VectorX a;        // acceleration as the method carries it [m/s2, rad/s2]; empty where something else has moved since its last step
  VectorX change;   // of q over the last step or part, without the rounding of q
};

// A whole step to be made: from `start` at `time` [s] over `length` [s]; histories of nonlinear elements from `committed` to `trial`.
struct FlightStep {
  double time, length;
  const Motion& start;
  const VectorX& committed;
  VectorX& trial;
};

// An iteration matrix in use, and the stiffness that is in it.
struct FactoredStiffness {
  IterationMatrix matrix;
  SparseMatrix stiffness;

  void save(Snapshot& snapshot, const std::string& name) const { matrix.save(snapshot, name); }
  void restore(System& system, const Snapshot& snapshot, const std::string& name);
};

// The problem of an implicit method over a whole step: R(x) = 0 with dR/dx = M + a C + b K, K that of the members at the step's end.
class FlightProblem : public NonlinearStep {
 public:
  struct Factors {
    FactoredStiffness& own;
    double a, b;  // [s], [s2]
  };
  FlightProblem(const Factors& factors, const AnalysisOptions& options, System& system, const FlightStep& step, Motion& end, VectorX guess,
                StepResult& result);

  void restart() override;
  const VectorX& residual() const override { return residual_; }
  double error() const override { return result_.residual / options_.newton_tolerance; }
  void factor(Tangent which) override;
  void solve(const VectorX& rhs, VectorX& solution) override;
  void move(const VectorX& change) override;
  void settle() override;
  bool guess_may_stand() const override { return true; }
  bool has_factors() const override { return factors_.own.matrix.ready(factors_.a, factors_.b); }
  double slow_reduction() const override { return 0.005; }

  VectorX x;

 protected:
  // Sets end_ and residual_ at x by members(), and measure()s the residual.
  virtual void evaluate(bool with_tangent) = 0;
  // Internal force and histories at end_.q.
  void members(bool with_tangent);
  // `scale`: what the residual is small against [N].
  void measure(double scale) { result_.residual = residual_.norm() / std::max(scale, 1e-300); }

  System& system_;
  const FlightStep& step_;
  Motion& end_;
  VectorX residual_;

 private:
  const Factors factors_;
  const AnalysisOptions& options_;
  const VectorX guess_;
  StepResult& result_;
  bool settling_ = false;
};

class FlightMethod {
 public:
  virtual ~FlightMethod() = default;

  // Throws ConvergenceError. `start` and `committed` stay as they are, so a step that is not wanted has nothing to undo.
  virtual void step(System& system, const FlightStep& step, Motion& end, StepResult& result) = 0;
  // Energy that such a step took from the motion beside physical damping [J]; empty: what the balance leaves.
  virtual std::optional<double> dissipated(const System& system, const Motion& start, const Motion& end) const {
    (void)system, (void)start, (void)end;
    return std::nullopt;
  }
  // Of a free mode of circular frequency w [rad/s] and damping ratio xi at step h [s].
  virtual Scheme::ModeResponse mode_response(double w, double xi, double h) const = 0;
  // Of the parts of a step.
  virtual PartRule part_rule() const = 0;
  virtual long factorizations() const = 0;
  virtual std::string describe() const = 0;
  virtual void save(Snapshot& snapshot) const = 0;
  virtual void restore(System& system, const Snapshot& snapshot) = 0;
};

// That of options.integrator. Throws InputError for an unknown name, or parameters out of its range.
std::unique_ptr<FlightMethod> make_flight_method(const AnalysisOptions& options, const System& system);
std::vector<std::string> flight_method_names();
inline constexpr double least_rho_of_alpha_os = 0.5;  // of Hilber, Hughes and Taylor's method

std::unique_ptr<FlightMethod> make_theta_method(const AnalysisOptions& options, const System& system);
std::unique_ptr<FlightMethod> make_generalized_alpha(const AnalysisOptions& options, const System& system);
std::unique_ptr<FlightMethod> make_alpha_os(const AnalysisOptions& options, const System& system);

// DOFs without mass: they have no velocity of their own, and get the mean one of the step.
std::vector<Eigen::Index> massless_dofs(const System& system);

// By the solution algorithms; throws ConvergenceError when none converges. Counts iterations.
void solve_flight(Ladder& ladder, NonlinearStep& problem, const AnalysisOptions& options, const System& system, double time,
                  StepResult& result);

}  // namespace nsframe
