#pragma once

#include <cmath>
#include <limits>

constexpr double epsilon = std::numeric_limits<double>::epsilon();

inline double relative_difference(double value, double reference) { return std::abs(value / reference - 1); }
