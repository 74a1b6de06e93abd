#include "elements/fiber_cutting.hpp"

#include <algorithm>
#include <cmath>

namespace nsframe {

namespace {

double cross(const Vector2& a, const Vector2& b) { return a.x() * b.y() - a.y() * b.x(); }

void stretch(std::vector<double>& positions, std::size_t first, std::size_t count) {
  double middle = 0;
  for (std::size_t i = 0; i < count; ++i) middle += positions[first + i] / double(count);
  // n points at the middles of n equal strips have (1 - 1/n^2) of the variance of the whole.
  const double factor = 1 / std::sqrt(1 - 1 / double(count * count));
  for (std::size_t i = 0; i < count; ++i)
    positions[first + i] = middle + factor * (positions[first + i] - middle);
}

}  // namespace

std::vector<double> cut(double from, double to, int n, Spacing spacing) {
  std::vector<double> positions;
  for (int i = 0; i < n; ++i) positions.push_back(from + (i + 0.5) * ((to - from) / n));
  if (spacing == Spacing::midpoints || n == 1) return positions;
  const std::size_t half = positions.size() / 2;
  if (n % 2 == 1 || n == 2) {
    stretch(positions, 0, positions.size());
  } else {
    stretch(positions, 0, half);
    stretch(positions, half, half);
  }
  return positions;
}

void add_rectangle(Fibers& fibers, const Rectangle& rectangle, int ny, int nz, const Reference& material,
                   Spacing spacing) {
  const auto& [y, z] = rectangle;
  const double area = std::abs((y[1] - y[0]) / ny * ((z[1] - z[0]) / nz));
  const std::vector<double> rows = cut(y[0], y[1], ny, spacing), columns = cut(z[0], z[1], nz, spacing);
  for (const double row : rows)
    for (const double column : columns) fibers.push_back({row, column, area, material});
}

bool is_convex(const Quadrilateral& corners) {
  int left = 0, right = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    const Vector2 &a = corners[i], &b = corners[(i + 1) % 4], &c = corners[(i + 2) % 4];
    const double turn = cross(b - a, c - b);
    left += turn > 0;
    right += turn < 0;
  }
  return (left > 0) != (right > 0) && left + right >= 3;
}

void add_quadrilateral(Fibers& fibers, const Quadrilateral& corners, int n_ij, int n_jk, const Reference& material) {
  const auto& [I, J, K, L] = corners;
  const auto at = [&](int i, int j) -> Vector2 {
    const double s = double(i) / n_ij, t = double(j) / n_jk;
    return (1 - t) * ((1 - s) * I + s * J) + t * ((1 - s) * L + s * K);
  };
  for (int j = 0; j < n_jk; ++j) {
    for (int i = 0; i < n_ij; ++i) {
      // two triangles on the diagonal
      const Vector2 a = at(i, j), b = at(i + 1, j), c = at(i + 1, j + 1), d = at(i, j + 1);
      const double first = cross(b - a, c - a) / 2, second = cross(c - a, d - a) / 2, area = first + second;
      const Vector2 centroid = (first * (a + b + c) + second * (a + c + d)) / (3 * area);
      fibers.push_back({centroid.x(), centroid.y(), std::abs(area), material});
    }
  }
}

void add_ring(Fibers& fibers, const RingSector& sector, int rings, int sectors, const Reference& material) {
  const double angle = (sector.to - sector.from) / sectors, thickness = (sector.outer - sector.inner) / rings;
  for (int ring = 0; ring < rings; ++ring) {
    const double inner = sector.inner + ring * thickness, outer = inner + thickness;
    const double squares = outer * outer - inner * inner;
    const double area = std::abs(angle) / 2 * squares;
    const double radius = 2.0 / 3 * (outer * outer * outer - inner * inner * inner) / squares * std::sin(angle / 2) / (angle / 2);
    for (int i = 0; i < sectors; ++i) {
      const double at = sector.from + (i + 0.5) * angle;
      fibers.push_back({sector.center.x() + radius * std::cos(at), sector.center.y() + radius * std::sin(at), area,
                        material});
    }
  }
}

void add_bars(Fibers& fibers, const Vector2& first, const Vector2& last, int count, double area,
              const Reference& material) {
  for (int i = 0; i < count; ++i) {
    const double s = count == 1 ? 0.5 : double(i) / (count - 1);
    const Vector2 at = first + s * (last - first);
    fibers.push_back({at.x(), at.y(), area, material});
  }
}

void add_bars(Fibers& fibers, const Vector2& center, double radius, double from, double to, int count, double area,
              const Reference& material) {
  const bool full = std::abs(std::abs(to - from) - 2 * pi) < 1e-9;
  const double step = full ? (to - from) / count : count > 1 ? (to - from) / (count - 1) : 0;
  const double first = !full && count == 1 ? (from + to) / 2 : from;
  for (int i = 0; i < count; ++i) {
    const double at = first + i * step;
    fibers.push_back({center.x() + radius * std::cos(at), center.y() + radius * std::sin(at), area, material});
  }
}

void AreaMoments::add(const AreaMoments& part, double factor) {
  const double total = area + factor * part.area;
  const Vector2 middle = (area * centroid + factor * part.area * part.centroid) / total;
  const Vector2 own = centroid - middle, others = part.centroid - middle;
  second += area * own * own.transpose() + factor * (part.second + part.area * others * others.transpose());
  area = total;
  centroid = middle;
}

AreaMoments moments(const Fibers& fibers) {
  AreaMoments sum;
  for (const FiberDescription& f : fibers) sum.add({f.area, {f.y, f.z}, Matrix2::Zero()}, f.displaced ? -1 : 1);
  return sum;
}

AreaMoments moments(const Rectangle& rectangle) {
  const double h = std::abs(rectangle.y[1] - rectangle.y[0]), b = std::abs(rectangle.z[1] - rectangle.z[0]);
  AreaMoments out{b * h, {(rectangle.y[0] + rectangle.y[1]) / 2, (rectangle.z[0] + rectangle.z[1]) / 2}, {}};
  out.second << b * h * h * h / 12, 0, 0, h * b * b * b / 12;
  return out;
}

// A square of side r less a quarter circle of radius r about its far corner.
AreaMoments spandrel(double r, const Vector2& corner, const Vector2& towards) {
  AreaMoments out = moments(Rectangle{{0, r}, {0, r}});
  const double area = pi / 4 * r * r, place = 4 * r / (3 * pi), to_fourth = r * r * r * r;
  AreaMoments circle{area, {r - place, r - place}, {}};
  const double own = pi / 16 * to_fourth - area * place * place, product = to_fourth / 8 - area * place * place;
  circle.second << own, product, product, own;
  out.add(circle, -1);
  const Vector2 sign = towards.cwiseSign();
  out.centroid = corner + sign.cwiseProduct(out.centroid);
  out.second = sign.asDiagonal() * out.second * sign.asDiagonal();
  return out;
}

namespace {
// The positive root of a positive definite matrix of two rows, by the theorem of Cayley and Hamilton.
Matrix2 square_root(const Matrix2& A) {
  const double root_of_determinant = std::sqrt(A.determinant());
  return (A + root_of_determinant * Matrix2::Identity()) / std::sqrt(A.trace() + 2 * root_of_determinant);
}
}  // namespace

void match_moments(Fibers& fibers, const AreaMoments& target) {
  const AreaMoments from = moments(fibers);
  const double scale = target.area / from.area;
  // The symmetric L with L A L = B: A^(-1/2) (A^(1/2) B A^(1/2))^(1/2) A^(-1/2), near I when A is near B.
  const Matrix2 root = square_root(scale * from.second), inverse = root.inverse();
  const Matrix2 map = inverse * square_root(root * target.second * root) * inverse;
  for (FiberDescription& f : fibers) {
    const Vector2 at = target.centroid + map * (Vector2(f.y, f.z) - from.centroid);
    f.y = at.x();
    f.z = at.y();
    f.area *= scale;
  }
}

SectionOutline circle_outline(const Vector2& center, double radius, int corners) {
  SectionOutline out;
  for (int i = 0; i < corners; ++i)
    out.emplace_back(center + radius * Vector2(std::cos(2 * pi * i / corners), std::sin(2 * pi * i / corners)));
  return out;
}

// Andrew's monotone chain.
SectionOutline convex_outline(std::vector<Vector2> points) {
  const auto before = [](const Vector2& a, const Vector2& b) {
    return a.x() < b.x() || (a.x() == b.x() && a.y() < b.y());
  };
  std::sort(points.begin(), points.end(), before);
  points.erase(std::unique(points.begin(), points.end()), points.end());
  if (points.size() < 3) return {};
  SectionOutline hull;
  for (int side = 0; side < 2; ++side) {
    const std::size_t start = hull.size();
    for (const Vector2& point : points) {
      while (hull.size() >= start + 2 && cross(hull.back() - hull[hull.size() - 2], point - hull.back()) <= 0)
        hull.pop_back();
      hull.push_back(point);
    }
    hull.pop_back();
    std::reverse(points.begin(), points.end());
  }
  return hull;
}

}  // namespace nsframe
