// Gauss-Lobatto quadrature on [0, 1].
#pragma once

#include <vector>

namespace nsframe {

struct Quadrature {
  std::vector<double> position;  // in [0, 1], ascending, ends included
  std::vector<double> weight;    // sum 1; exact for polynomials of degree 2 n - 3
};

// n >= 2 points: the ends and the roots of the derivative of the Legendre polynomial of degree n - 1.
Quadrature gauss_lobatto(int n);

}  // namespace nsframe
