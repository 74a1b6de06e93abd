// What damping does to the natural modes of one structure: nothing but decay, or it ties them together (theory.md, 335-338).
#pragma once

#include "integrators/exact_modes.hpp"

namespace nsframe {

// Modes of one structure: columns of shape (n x modes); basis of what has no mass, with its flexibility; modes that are left out.
struct BlockModes {
  VectorX square;
  MatrixX shape, massless, flexibility;
  VectorX left_out_square = {};
  MatrixX left_out = {};
};

struct BlockDamping {
  VectorX decay;                           // 2 a of the modes that move alone, 0 of the others
  std::vector<DampingCoupling> couplings;  // places: numbers of modes, from modes.square.size() on of first-order motions
  MatrixX follow, follow_projection;       // shapes v of these (columns), v' K v = 1; v' K (rows)
};

[[noreturn]] void refuse_modes(const Structure& structure, const std::string& why);

// Of the damping C of a structure with stiffness K and contact pairs H, all in its own DOFs. Turns modes of one frequency so that damping
// ties as few as possible together. Throws InputError as exact_modes() does.
BlockDamping block_damping(const System& system, const Structure& structure, BlockModes& modes, const MatrixX& K, const MatrixX& C, const MatrixX& H);

}  // namespace nsframe
