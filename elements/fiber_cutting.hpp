// Blocks that cross-sections are composed of: areas cut into fibers, and bars along lines and arcs. Local axes y, z;
// angles from y towards z [rad].
#pragma once

#include <array>
#include <vector>

#include "elements/sections.hpp"

namespace nsframe {

using Matrix2 = Eigen::Matrix2d;
using Fibers = std::vector<FiberDescription>;

// Where the fibers of n equal strips lie. Midpoints lose 1/n^2 of the strip's second moment. `exact` keeps it: an even
// number of strips is spread about the centroids of the two halves, so that the first moments of the halves stay too,
// and with them the plastic moment; 2 or an odd number about the middle; one strip has no second moment.
enum class Spacing { midpoints, exact };

std::vector<double> cut(double from, double to, int n, Spacing spacing = Spacing::midpoints);

struct Rectangle {
  std::array<double, 2> y, z;  // [m] from, to
};
// By rising y, each by rising z.
void add_rectangle(Fibers& fibers, const Rectangle& rectangle, int ny, int nz, const Reference& material,
                   Spacing spacing = Spacing::midpoints);

// Corners I, J, K, L in order around a convex area; n_ij fibers from I to J, n_jk from J to K, each at its centroid.
using Quadrilateral = std::array<Vector2, 4>;
void add_quadrilateral(Fibers& fibers, const Quadrilateral& corners, int n_ij, int n_jk, const Reference& material);
bool is_convex(const Quadrilateral& corners);

struct RingSector {
  Vector2 center = Vector2::Zero();
  double inner = 0, outer = 0;    // [m] radii
  double from = 0, to = 2 * pi;   // [rad]
};
// By rising radius, each by rising angle, each fiber at its centroid.
void add_ring(Fibers& fibers, const RingSector& sector, int rings, int sectors, const Reference& material);

// Bars from the first to the last point, both included; one alone lies halfway.
void add_bars(Fibers& fibers, const Vector2& first, const Vector2& last, int count, double area,
              const Reference& material);
// Bars along an arc, both ends included unless it is a full circle; one alone lies halfway.
void add_bars(Fibers& fibers, const Vector2& center, double radius, double from, double to, int count, double area,
              const Reference& material);

struct AreaMoments {
  double area = 0;                    // [m2]
  Vector2 centroid = Vector2::Zero();  // [m]
  Matrix2 second = Matrix2::Zero();    // [m4] about the centroid: integrals of yy, yz, zz

  // The same plus `factor` times a part.
  void add(const AreaMoments& part, double factor = 1);
};
AreaMoments moments(const Fibers& fibers);
AreaMoments moments(const Rectangle& rectangle);

// Area between a quarter circle of radius r and its two tangents, which meet at `corner`; it lies on the side of
// `towards` (signs of y and z).
AreaMoments spandrel(double r, const Vector2& corner, const Vector2& towards);

// Scales the areas and moves the fibers by the affine map nearest to none, so that area, centroid and second moments
// are those of the target.
void match_moments(Fibers& fibers, const AreaMoments& target);

// Corners of a circle's polygon, and the convex polygon around points, both counter-clockwise.
SectionOutline circle_outline(const Vector2& center, double radius, int corners = 24);
SectionOutline convex_outline(std::vector<Vector2> points);

}  // namespace nsframe
