// A linear system in its natural modes, for the schemes `exact` and `exponential`: q = Phi x + F (f + H' lambda), x'' + 2 a x' + w^2 x =
// Phi'(f + H' lambda) for every mode (theory.md, 150-153). Phi: all modes of finite frequency, Phi' M Phi = 1; F: flexibility of
// what has no mass, which follows its loads at once.
#pragma once

#include <string>
#include <vector>

#include "assembly/system.hpp"
#include "modal/block_diagonal.hpp"

namespace nsframe {

// Modes of one structure that damping ties together, and the motions z of first order of what has dashpots and no mass (theory.md, 335-337):
// x'' + D x' + w^2 x = Phi' (f + H' lambda) + E z, z' = -E' x' - T z.
struct DampingCoupling {
  std::string structure;
  std::vector<int> places;            // in arrays by mode: of the n modes, then of the m motions of first order
  VectorX square;                     // w^2 [1/s2]
  MatrixX damping, coupling;          // D (n x n) [1/s], E (n x m)
  VectorX rate, rest;                 // T [1/s]; z of the rest under static loads
  BlockDiagonal form;                 // of the matrix of (x, z, y)
  std::vector<int> modal_places() const { return {places.begin(), places.begin() + square.size()}; }  // of the n modes
  VectorX complex_frequency, complex_damping;  // |lambda| [rad/s] and -Re lambda / |lambda| of the n modes' complex counterparts
};

// Displacements, velocities, loads and their slopes of all modes; of motions of first order x = z, and y only in EventFlow::write().
struct ModalState {
  VectorX x, y, f0, f1;  // [m sqrt(kg)], [m/s sqrt(kg)], [N/sqrt(kg)], [N/s/sqrt(kg)]
};

// Arrays by mode have `padded` entries. Those of a structure stand side by side in its range, slowest first, then motions of first order;
// what fills the range up to whole SIMD registers are modes that nothing moves.
struct ExactModes {
  int dofs = 0, padded = 0, massless = 0;
  int moving = 0, left_out = 0;       // modes, without motions of first order; those above the highest frequency
  std::vector<BlockRange> ranges;     // of the structures
  VectorX square, decay;              // w^2 [1/s2], a [1/s]
  VectorX flexibility;                // 1 / w^2 of oscillators, 0 of the special ones
  VectorX damped;                     // sqrt(w^2 - a^2); 1 for the special ones
  std::vector<int> special;           // rigid-body, very slow, critically damped or overdamped: not by the formulas of oscillators
  double highest = 0;                 // largest w + 2 a of the modes that contact can feel [1/s]
  bool undamped = true;
  std::vector<DampingCoupling> couplings;  // at their places decay = flexibility = 0: no oscillators of their own
  BlockOperator shape, projection, shape_transposed;  // Phi, Phi' M, Phi'
  BlockOperator massless_flexibility; // F, with Phi w^-2 Phi' of the modes left out: they follow their loads at once, too, but contact does not feel them
  MatrixX massless_basis;             // N: columns span the motions without mass, and those left out
  VectorX kept_mass;                  // of the mass that each motion shakes, the part that the kept modes hold
  VectorX static_load;                // Phi' F_g
  std::vector<VectorX> motion_load;   // of a unit base acceleration, one a motion
  VectorX rest;                       // F F_g, free DOFs [m]
  // contact pairs
  SparseRows jacobian;                // H
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> gap, gap_size;  // H Phi, a row a pair; its absolute values
  VectorX gap_offset;                 // g0 + H rest [m]
  VectorX rest_gap;                   // H rest
  MatrixX delassus;                   // H Phi Phi' H' [1/kg]
  MatrixX compliance;                 // H F H' [m/N]
  std::vector<bool> compliant;        // pairs reached through massless DOFs: no impulse, a spring in series
  MatrixX velocity_jump;              // Phi Phi' H', free DOFs x pairs: of a unit impulse
  MatrixX massless_response;          // F H', free DOFs x pairs

  // Damping ratio and circular frequency of a mode of a structure that damping ties to others; zeros for the others.
  std::pair<double, double> complex_mode(int structure, int mode) const;
  bool follows() const { return massless + left_out > 0; }  // something moves without inertia
  int pairs() const { return static_cast<int>(compliant.size()); }
};

// The first nonlinear element and its kind, as "element 'a' (spring)"; empty when there is none.
std::string nonlinear_element(const System& system);

// Modes under a symmetric `stiffness` (free DOFs); those above `highest` [rad/s] are left out. Throws InputError, naming the structure, where contact meets DOFs that have dashpots and
// no mass, and where damped modes are too nearly parallel to be told apart.
ExactModes exact_modes(const System& system, const SparseMatrix& stiffness, double highest);

}  // namespace nsframe
