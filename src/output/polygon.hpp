// Plane polygons as the sections of members and the plans of slabs need them for drawing.
#pragma once

#include <array>
#include <vector>

#include "base/types.hpp"

namespace nsframe {

// Positive when the corners go counter-clockwise [m2].
double signed_area(const std::vector<Vector2>& polygon);

// Triangles (indices of corners) that fill a simple, possibly non-convex polygon given counter-clockwise: n - 2 of
// them, by ear clipping.
std::vector<std::array<int, 3>> triangulate(const std::vector<Vector2>& polygon);

}  // namespace nsframe
