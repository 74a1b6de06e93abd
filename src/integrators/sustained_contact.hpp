// Sustained contact in the scheme `exact`: the forces of closed pairs as polynomials over a panel, found by collocation, drive
// the free modes exactly (theory.md, 155-157). No modes of the constrained system are needed.
#pragma once

#include <map>

#include "base/decompositions.hpp"
#include "integrators/exact_propagator.hpp"

namespace nsframe {

inline constexpr int panel_points = 10;  // Gauss points of a panel

// Forces of the closed pairs over one panel.
struct ContactForces {
  std::vector<int> pairs;
  MatrixX values;     // panel_points x pairs: at the Gauss points of [0, length] [N]
  double length = 0;  // [s]
  VectorX noise;      // what rounding may make of each force [N]

  bool empty() const { return pairs.empty(); }
};

class SustainedContact {
 public:
  SustainedContact(const ExactModes& modes, Propagator& propagator);

  double panel() const { return length_; }

  // Forces that keep the gaps of the pairs: of compliant ones at zero, of the others their accelerations.
  ContactForces solve(const ModalState& state, const VectorX& gap_offset, const std::vector<int>& pairs);
  // What rounding may make of the forces of closed pairs without compliance (theory.md, 170); 0 for the others.
  VectorX force_noise(const ModalState& state, const std::vector<int>& pairs) const;
  // Motion under them, for a time s up to the panel's length.
  void move(const ModalState& from, const ContactForces& forces, double s, ModalState& after) const;

  // What the forces change in Propagator::work() of a load with the slope f1, over a flight of length s [J].
  double work(const VectorX& f1, const ContactForces& forces, double s) const;

  // Of force number k: value and slope at s, integral over [0, s], Bernstein coefficients on the panel.
  static double value(const ContactForces& forces, std::size_t k, double s);
  double slope(const ContactForces& forces, std::size_t k, double s) const;
  static double impulse(const ContactForces& forces, std::size_t k, double s);
  VectorX bernstein(const ContactForces& forces, std::size_t k) const;

  // What the forces add to derivatives n = 1..6 of a gap at the start, and to the bound of its fourth derivative.
  void add_derivatives(const ContactForces& forces, int pair, Eigen::Matrix<double, 7, 1>& gap) const;
  double fourth_bound(const ContactForces& forces, int pair) const;

 private:
  struct SetSolver {
    RankRevealing<long double> factor;
    VectorX scale;
  };
  const SetSolver& solver(const std::vector<int>& pairs);

  const ExactModes& modes_;
  Propagator& propagator_;
  double length_;
  std::vector<double> nodes_;                       // Gauss points times the panel's length
  std::vector<MatrixX> displacement_, acceleration_;  // pairs x pairs, at (node, quadrature point): response to a unit impulse
  std::array<MatrixX, 6> moments_;                  // G diag(n-th derivative of the impulse response at 0) G'
  MatrixX size_, size2_;                            // |G||G|', |G| w^2 |G|'
  std::array<MatrixX, 4> coupled_bound_;            // on derivatives 1..4 of the response of modes that damping ties together
  MatrixX to_bernstein_;
  std::map<std::vector<int>, SetSolver> solvers_;
  ModalState before_, at_node_;
};

}  // namespace nsframe
