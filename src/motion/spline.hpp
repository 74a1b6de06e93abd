// Displacements as a twice differentiable motion.
#pragma once

#include <vector>

namespace nsframe {

// Accelerations, linear between equal steps `dt` [s], of the cubic spline through `displacement` [m] that is at rest at both ends:
// its second derivatives (de Boor, A Practical Guide to Splines, 1978, chapter IV).
std::vector<double> spline_accelerations(const std::vector<double>& displacement, double dt);

}  // namespace nsframe
