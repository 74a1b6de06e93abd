// What measured frequencies can tell of parameters: singular values of the sensitivities, errors of the parameters that errors of
// the frequencies mean, combinations that no frequency sees (theory.md, 334 to 337).
#pragma once

#include <array>
#include <vector>

#include "base/types.hpp"

namespace nsframe {

struct Identifiability {
  VectorX singular_values;               // of sqrt(w) d ln f / d ln p, falling; as many as parameters
  VectorX error;                         // standard error of ln p; infinite where nothing can be said
  MatrixX correlation;                   // of parameters with finite errors; 0 elsewhere, 1 on the diagonal
  std::vector<VectorX> unseen;           // combinations of ln p that change no frequency; first the parameters that none depends on
};

// `sensitivity`: sqrt(w) d ln f / d ln p, frequencies by parameters; `accuracy`: relative standard error of a frequency of weight 1.
Identifiability identifiability(const MatrixX& sensitivity, double accuracy);

}  // namespace nsframe
