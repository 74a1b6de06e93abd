// Integration along members: points and weights on [0, 1]. A new rule is one function and one line in the table `rules`
// of quadrature.cpp; scenes call it by its name there.
#pragma once

#include <string>
#include <vector>

namespace nsframe {

inline constexpr int max_points = 10;  // integration points of a member

struct Quadrature {
  std::vector<double> position;  // in [0, 1], rising
  std::vector<double> weight;    // sum 1
  int size() const { return static_cast<int>(position.size()); }
};

// n points that integrate polynomials exactly: both ends among them, up to degree 2 n - 3 (n >= 2); the first end
// among them, up to 2 n - 2; inner points only, up to 2 n - 1.
Quadrature gauss_lobatto(int n);
Quadrature gauss_radau(int n);
Quadrature gauss_legendre(int n);

// Which rule, and what only some of them need.
struct Integration {
  std::string rule = "lobatto";
  double hinge_i = 0, hinge_j = 0;         // [m] plastic hinge lengths: hinge-radau
  std::vector<double> positions, weights;  // user: along the member in [0, 1]; parts of its length, sum 1
  bool operator==(const Integration&) const = default;
};

std::vector<std::string> integration_rules();

// The rule for a member; `points` counts only where the rule doesn't fix the number. Throws std::invalid_argument
// with what is wrong.
Quadrature make_quadrature(const Integration& integration, int points, double length);

}  // namespace nsframe
