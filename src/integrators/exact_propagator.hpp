// Motion of modes in closed form under loads that are linear in time (theory.md, 151-152).
#pragma once

#include <array>
#include <vector>

#include "integrators/coupled_motion.hpp"
#include "integrators/exact_kernel.hpp"

namespace nsframe {

// x+ = A x + B y + L f0 + R f1, y+ = -w^2 B x + (A - 2 a B) y + B f0 + L f1; B is the response to a unit impulse, L, R and Q
// its first, second and third integrals.
struct StepCoefficients {
  long double A, B, L, R, Q;
};
// s^k / k!, for all modes that move on by the same time s.
class TaylorPowers {
 public:
  static constexpr int terms = 30;
  explicit TaylorPowers(long double s);
  long double operator[](int k) const { return power_[static_cast<std::size_t>(k)]; }
  const long double s;

 private:
  std::array<long double, terms + 4> power_;
};
// Of one mode with w^2 = square and any damping a, after a time s.
StepCoefficients step_coefficients(long double square, long double a, const TaylorPowers& powers);
inline StepCoefficients step_coefficients(long double square, long double a, long double s) { return step_coefficients(square, a, TaylorPowers(s)); }

class Propagator {
 public:
  explicit Propagator(const ExactModes& modes)
      : modes_(modes), coupled_(modes), raised_(modes.square.cwiseQuotient(modes.damped.cwiseAbs2())) {}

  // All motions of move() and step(), and their bounds and energies, are from this state on.
  void begin(const ModalState& from) { coupled_.begin(from); }
  // The state after any time s; the load has moved on. `after` may not be `from`.
  void move(const ModalState& from, double s, ModalState& after);
  // The same of modes that damping doesn't tie together; what it does to the others is for coupled().
  void move_oscillators(const ModalState& from, double s, ModalState& after) const;
  CoupledMotion& coupled() { return coupled_; }
  // The same by coefficients that are kept for further steps of that length. `s` is best of few values; these are found
  // to more digits than double has, so that no energy is lost or gained in millions of steps.
  void step(const ModalState& from, double s, ModalState& after);
  void prepare(double s) { find(s); }  // for step()
  // The same where all modes are oscillators, with energy() of all loads and size() of the start.
  FlightSums step_and_sum(const ModalState& from, double s, ModalState& after);

  // Derivatives n = 0..6 of the modal displacements, by columns.
  void derivatives(const ModalState& state, Eigen::Matrix<double, Eigen::Dynamic, 7>& out) const;
  // Second derivatives under the state's load.
  VectorX accelerations(const ModalState& state) const;
  // Of oscillators alone.
  ModalSize size(const ModalState& state) const;
  // For every pair a bound on |d4 g / dt4| from begin() on, while the load keeps its slope.
  void bound_fourth(const ModalState& state, VectorX& bound);

  // Over a free motion of length s between two states: the work of a part f0 + f1 t of the loads, and the changes of 1/2 w^2 x^2 and
  // 1/2 y^2, summed [J].
  FlightEnergy energy(const VectorX& f0, const VectorX& f1, const ModalState& from, const ModalState& to, double s);

 private:
  struct Step {
    double length = -1;
    std::array<VectorX, 12> arrays;
  };
  const Step& find(double s);
  FlightArrays arrays_of(const ModalState& from) const;
  const ExactModes& modes_;
  CoupledMotion coupled_;
  std::vector<Step> steps_;
  std::size_t next_ = 0;
  VectorX raised_;  // w^2 / (w^2 - a^2)
  VectorX mode_bound_, integral_;
};

}  // namespace nsframe
