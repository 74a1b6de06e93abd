// Small dense systems of equations, without the compile time of a matrix library.
#pragma once

#include <vector>

namespace nsframe {

// Solves A x = b, A row by row of the size of b, by elimination with row pivots. Throws std::invalid_argument when A is
// singular.
std::vector<double> solve_equations(std::vector<double> A, std::vector<double> b);

}  // namespace nsframe
