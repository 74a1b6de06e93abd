// The alpha-OS method (operator splitting: Nakashima, Kaminosono, Ishida and Ando, 4th US National Conf. Earthquake Eng. 1990; Combescure and
// Pegon, Nucl. Eng. Design 171, 1997, 253-275) over a whole step: the method of Hilber, Hughes and Taylor with the internal force
//   P+ = P(q~) + K0 (q+ - q~),   q~ = q + h v + h^2 (1/2 - beta) a,
// one evaluation a step at the explicit predictor, and a constant matrix. Where members stiffen beyond K0 the step is refused and made by
// Hilber, Hughes and Taylor's implicit method (theory.md, 304-306).
#include <fmt/format.h>

#include "base/errors.hpp"
#include "integrators/generalized_alpha.hpp"

namespace nsframe {

namespace {

constexpr int watch_interval = 8;       // steps between two looks at the tangent
constexpr double safety = 1.25;         // of what stiffening would make unstable
constexpr double massless_stiffening = 0.25;  // of K0, of 1/3 that makes what has no mass unstable
constexpr double suspicious = 1;        // h^2 (stiffening force) / (mass x motion) of a DOF, of 4, from which the tangent is looked at
constexpr double worth_a_look = 1e-3;   // of the work of all stiffening and yielding, that of one DOF

class AlphaOs : public GeneralizedAlpha {
 public:
  AlphaOs(const AnalysisOptions& options, const System& system, const GeneralizedAlphaParameters& parameters)
      : GeneralizedAlpha(options, system, parameters, "alpha_os"), implicit_(options, system, parameters, "alpha_os.implicit"), mass_(system.mass().diagonal()) {}

  void step(System& system, const FlightStep& step, Motion& end, StepResult& result) override;
  long factorizations() const override { return GeneralizedAlpha::factorizations() + implicit_.factorizations() + looks_; }
  std::string describe() const override {
    return fmt::format("alpha-OS between impacts (alpha = {:.4g}): one evaluation of the elements a step and a constant matrix; steps in which members "
                       "stiffen too far are made by its implicit form",
                       -p_.alpha_f);
  }
  void save(Snapshot& snapshot) const override;
  void restore(System& system, const Snapshot& snapshot) override;

 private:
  // Whether M + h^2/4 (K0 - K_t) has a negative direction, at the tangent last evaluated (306).
  bool stiffened(const System& system, double h);
  // A DOF with mass on which the force grew by much more than K0 times its motion.
  bool suspect(const VectorX& motion, const VectorX& force_change, double h) const;

  GeneralizedAlpha implicit_;
  const VectorX mass_;
  Eigen::SimplicialLDLT<SparseMatrix> judge_;
  long looks_ = 0;
  int since_look_ = watch_interval;
  int implicit_left_ = 0;
};

bool AlphaOs::suspect(const VectorX& motion, const VectorX& force_change, double h) const {
  VectorX excess = force_change;
  excess.noalias() -= own_.stiffness * motion;
  const VectorX work = excess.cwiseProduct(motion);
  const double least = worth_a_look * work.cwiseAbs().sum();
  for (Eigen::Index i = 0; i < work.size(); ++i) {
    if (mass_[i] > 0 && work[i] > least && h * h * work[i] > suspicious * mass_[i] * motion[i] * motion[i]) return true;
  }
  return false;
}

bool AlphaOs::stiffened(const System& system, double h) {
  ++looks_;
  since_look_ = 0;
  const double scale = safety * 0.25 * h * h;
  SparseMatrix difference = own_.stiffness - system.assembler.tangent();
  difference = scale * 0.5 * (difference + SparseMatrix(difference.transpose()));
  SparseMatrix S = system.mass() + difference;
  const double spared = scale * massless_stiffening;
  for (Eigen::Index j = 0; j < own_.stiffness.outerSize(); ++j) {
    if (mass_[j] > 0) continue;
    for (SparseMatrix::InnerIterator entry(own_.stiffness, j); entry; ++entry) {
      if (!(mass_[entry.row()] > 0)) S.coeffRef(entry.row(), j) += spared * entry.value();
    }
  }
  judge_.compute(S);
  return judge_.info() != Eigen::Success || !(judge_.vectorD().minCoeff() >= 0);
}

void AlphaOs::step(System& system, const FlightStep& step, Motion& end, StepResult& result) {
  if (system.linear()) return GeneralizedAlpha::step(system, step, end, result);
  if (implicit_left_ > 0) {
    --implicit_left_;
    ++result.stiffened_steps;
    return implicit_.step(system, step, end, result);
  }
  VectorX a = step.start.a, force;
  const Start start = begin(system, step, a);
  const bool look = ++since_look_ >= watch_interval;
  const auto evaluate = [&](bool with_tangent) {
    system.assembler.start_step(step.committed, step.trial);
    system.assembler.internal_force(start.q, step.committed, step.trial, force, with_tangent);
    ++result.evaluations;
  };
  evaluate(look);
  bool refused = look && stiffened(system, step.length);
  if (!look && suspect(start.q - step.start.q, force - step.start.P, step.length)) {
    evaluate(true);
    refused = stiffened(system, step.length);
  }
  if (refused) {
    implicit_left_ = watch_interval;
    return AlphaOs::step(system, step, end, result);
  }
  const VectorX next = solve_linearised(system, start, force);
  finish(step, start, next, end);
  end.P = force;
  end.P.noalias() += own_.stiffness * (end.q - start.q);
}

void AlphaOs::save(Snapshot& snapshot) const {
  GeneralizedAlpha::save(snapshot);
  implicit_.save(snapshot);
  snapshot.put("alpha_os.since_look", static_cast<double>(since_look_));
  snapshot.put("alpha_os.implicit_left", static_cast<double>(implicit_left_));
}

void AlphaOs::restore(System& system, const Snapshot& snapshot) {
  GeneralizedAlpha::restore(system, snapshot);
  implicit_.restore(system, snapshot);
  since_look_ = static_cast<int>(snapshot.number("alpha_os.since_look"));
  implicit_left_ = static_cast<int>(snapshot.number("alpha_os.implicit_left"));
}

}  // namespace

std::unique_ptr<FlightMethod> make_alpha_os(const AnalysisOptions& options, const System& system) {
  if (options.rho_infinity < least_rho_of_alpha_os) {
    throw InputError(fmt::format("error: analysis.rho_infinity = {:g}, must lie in [{:g}, 1] for integrator = \"alpha-os\"", options.rho_infinity,
                                 least_rho_of_alpha_os));
  }
  return std::make_unique<AlphaOs>(options, system, GeneralizedAlphaParameters::hilber_hughes_taylor(options.rho_infinity));
}

}  // namespace nsframe
