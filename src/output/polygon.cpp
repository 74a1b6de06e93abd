#include "output/polygon.hpp"

#include <cmath>
#include <limits>
#include <numeric>

namespace nsframe {
namespace {

double cross(const Vector2& a, const Vector2& b, const Vector2& c) {
  const Vector2 u = b - a, v = c - a;
  return u.x() * v.y() - u.y() * v.x();
}

using Corners = std::vector<int>;

const Vector2& corner(const std::vector<Vector2>& polygon, const Corners& left, std::size_t i) {
  return polygon[static_cast<std::size_t>(left[i % left.size()])];
}

// Corner i of the polygon that is left makes an ear when it turns left and no other corner lies in its triangle.
bool is_ear(const std::vector<Vector2>& polygon, const Corners& left, std::size_t i) {
  const std::size_t n = left.size();
  const Vector2 &a = corner(polygon, left, i + n - 1), &b = corner(polygon, left, i), &c = corner(polygon, left, i + 1);
  if (cross(a, b, c) <= 0) return false;
  for (std::size_t k = 2; k + 1 < n; ++k) {
    const Vector2& p = corner(polygon, left, i + k);
    if (p == a || p == b || p == c) continue;
    if (cross(a, b, p) >= 0 && cross(b, c, p) >= 0 && cross(c, a, p) >= 0) return false;
  }
  return true;
}

// For a degenerate polygon, where rounding leaves no ear: the flattest corner.
std::size_t flattest(const std::vector<Vector2>& polygon, const Corners& left) {
  std::size_t best = 0;
  double least = std::numeric_limits<double>::max();
  for (std::size_t i = 0; i < left.size(); ++i) {
    const double area = std::abs(
        cross(corner(polygon, left, i + left.size() - 1), corner(polygon, left, i), corner(polygon, left, i + 1)));
    if (area < least) {
      least = area;
      best = i;
    }
  }
  return best;
}

}  // namespace

double signed_area(const std::vector<Vector2>& polygon) {
  double twice = 0;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vector2 &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
    twice += a.x() * b.y() - a.y() * b.x();
  }
  return 0.5 * twice;
}

std::vector<std::array<int, 3>> triangulate(const std::vector<Vector2>& polygon) {
  std::vector<std::array<int, 3>> triangles;
  Corners left(polygon.size());
  std::iota(left.begin(), left.end(), 0);
  while (left.size() >= 3) {
    std::size_t ear = 0;
    while (ear < left.size() && !is_ear(polygon, left, ear)) ++ear;
    if (ear == left.size()) ear = flattest(polygon, left);
    const std::size_t n = left.size();
    triangles.push_back({left[(ear + n - 1) % n], left[ear], left[(ear + 1) % n]});
    left.erase(left.begin() + static_cast<std::ptrdiff_t>(ear));
  }
  return triangles;
}

}  // namespace nsframe
