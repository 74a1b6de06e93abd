// Motion of modes that damping ties together, in closed form (theory.md, 335-345): a set of modes x with the first-order motions z of what has
// dashpots and no mass,
//   x'' + D x' + w^2 x = f + E z,   z' = -E' x' - T z,
// moves by the block-diagonal form of its matrix: every block by its own exponential, at any time after begin().
#pragma once

#include <array>
#include <complex>

#include "base/padded_matrix.hpp"
#include "integrators/exact_modes.hpp"

namespace nsframe {

class CoupledMotion {
 public:
  explicit CoupledMotion(const ExactModes& modes);
  bool empty() const { return sets_.empty(); }

  // The motion that starts now from this state, under its load.
  void begin(const ModalState& from);
  // Writes the places of the sets a time s after begin(); y = 0 where motions are of first order. `kept`: s is one of few values.
  void at(double s, ModalState& after, bool kept);
  // Integral of x over [0, s] after begin(), at these places.
  void integrate(double s, VectorX& integral);

  // The same motion in pieces, with impulses of contact pairs between them.
  void start_run();
  void run(double s);
  void kick(int pair, double impulse);
  void finish_run(ModalState& after);

  // Second derivatives under the state's load, and the sizes of the terms that they consist of.
  void accelerations(const ModalState& state, VectorX& out) const;
  void add_sizes(const ModalState& state, VectorX& out) const;
  // Derivatives n = 0..6 of x by columns.
  void derivatives(const ModalState& state, Eigen::Matrix<double, Eigen::Dynamic, 7>& out) const;
  // Adds to bounds on |d4 g / dt4| of all pairs from begin() on, while the load keeps its slope.
  void add_fourth(VectorX& fourth) const;
  // Sets y where motions are of first order to their rates, or to nothing.
  void set_rates(ModalState& state) const;
  void clear_rates(ModalState& state) const;
  // Work of static loads along the motions of first order between two states.
  double rest_work(const VectorX& from, const VectorX& to) const;

  // Pairs x pairs: gap, and its acceleration, at s after a unit impulse; derivative n of the gap right after it, and bounds on it for ever.
  MatrixX displacement_response(double s) const { return response(s, 0); }
  MatrixX acceleration_response(double s) const { return response(s, 2); }
  std::array<MatrixX, 6> moments() const;
  MatrixX derivative_bound(int n) const;
  // Sum over pairs of `impulses` times the integral over [0, s] of load' x after them; the load is that of weigh().
  void weigh(const VectorX& load);
  double impulse_integral(double s, const VectorX& impulses) const;

 private:
  using Complex = std::complex<double>;
  // exp(B s) and its integrals p_n of a block of size 1 or 2, as a complex number: c+ = e c + p1 b0 + p2 b1, int c = p1 c + p2 b0 + p3 b1.
  struct Factors {
    Complex e, p1, p2, p3;
  };
  struct KeptFactors {
    double s = -1;
    std::vector<Factors> blocks;
  };
  struct Set {
    const DampingCoupling* coupling = nullptr;
    int modes = 0, follow = 0, size = 0;         // n, m, 2 n + m
    PaddedMatrix basis, inverse, load;           // (x, z, y) from c, c from (x, z, y), c from f
    MatrixX displacement;                        // x from c
    MatrixX gap, gap_size;                       // of pairs from c; its norms by blocks
    MatrixX kick;                                // c of a unit impulse, a column a pair
    VectorX c, b0, b1;                           // at begin(), or within a run
    VectorX run_c, run_b0;
    std::vector<KeptFactors> kept;
    VectorX weight;                              // load' x by c
    mutable VectorX room, room2, result;         // padded
  };
  static Factors factors(const DiagonalBlock& block, double s, bool long_double);
  const std::vector<Factors>& find(Set& set, double s, bool kept);
  // c after s, and its integral where asked for.
  static void move(const Set& set, const std::vector<Factors>& factors, double s, const VectorX& c, const VectorX& b0, const VectorX& b1, VectorX& after,
                   VectorX* integral);
  void write(const Set& set, const VectorX& c, ModalState& after) const;
  MatrixX response(double s, int derivative) const;

  const ExactModes& modes_;
  std::vector<Set> sets_;
  std::vector<Factors> passing_;
  VectorX moved_, sum_;
};

}  // namespace nsframe
