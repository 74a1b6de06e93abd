#include "elements/quadrature.hpp"

#include <fmt/format.h>

#include <cmath>
#include <stdexcept>
#include <string_view>
#include <utility>

#include "base/types.hpp"

namespace nsframe {

namespace {

// Legendre polynomials of degree n and n - 1 at x.
std::pair<double, double> legendre(int n, double x) {
  double before = 1, current = x;
  for (int k = 2; k <= n; ++k) {
    before = std::exchange(current, ((2 * k - 1) * x * current - (k - 1) * before) / k);
  }
  return {current, before};
}

// Newton's corrections `step(x)` from x until they are rounding.
template <class Step>
double polish(double x, Step step) {
  for (int iteration = 0; iteration < 50; ++iteration) {
    const double change = step(x);
    x += change;
    if (std::abs(change) < 1e-16) break;
  }
  return x;
}

[[noreturn]] void refuse(const std::string& why) { throw std::invalid_argument(why); }

// Fewer points than `least` don't integrate the stiffness of a prismatic elastic member (degree 2).
void require_points(int points, int least) {
  if (points < least || points > max_points)
    refuse(fmt::format("points = {}, must lie in [{}, {}]", points, least, max_points));
}

Quadrature lobatto(const Integration&, int points, double) {
  require_points(points, 3);
  return gauss_lobatto(points);
}

Quadrature radau(const Integration&, int points, double) {
  require_points(points, 2);
  return gauss_radau(points);
}

Quadrature legendre_rule(const Integration&, int points, double) {
  require_points(points, 2);
  return gauss_legendre(points);
}

// Scott and Fenves (2006): two-point Gauss-Radau over four hinge lengths at each end, so that the end points have the
// hinge lengths as weights and linear curvatures are still integrated exactly; two-point Gauss-Legendre between.
Quadrature hinge_radau(const Integration& integration, int, double length) {
  if (!(integration.hinge_i > 0) || !(integration.hinge_j > 0))
    refuse("hinge-radau needs positive hinge_i and hinge_j");
  const double i = integration.hinge_i / length, j = integration.hinge_j / length;
  if (4 * (i + j) > 1 + 1e-12) {
    refuse(fmt::format("4 (hinge_i + hinge_j) = {:.4g} m is more than the length, {:.4g} m", 4 * (i + j) * length,
                       length));
  }
  const double half = std::max(0.0, 0.5 - 2 * (i + j)), middle = 0.5 + 2 * (i - j), inner = half / std::sqrt(3.0);
  return {{0, 8 * i / 3, middle - inner, middle + inner, 1 - 8 * j / 3, 1}, {i, 3 * i, half, half, 3 * j, j}};
}

Quadrature user(const Integration& integration, int, double) {
  const auto& position = integration.positions;
  const auto& weight = integration.weights;
  if (position.size() != weight.size()) {
    refuse(fmt::format("{} positions, but {} weights", position.size(), weight.size()));
  }
  if (position.size() < 2 || position.size() > max_points) {
    refuse(fmt::format("{} positions, must be 2 to {}", position.size(), max_points));
  }
  double sum = 0;
  int acting = 0;
  for (std::size_t k = 0; k < position.size(); ++k) {
    if (!(position[k] >= 0 && position[k] <= 1)) refuse(fmt::format("position {}, must lie in [0, 1]", position[k]));
    if (k > 0 && !(position[k] > position[k - 1])) refuse("positions must rise from the first end to the second");
    if (!(weight[k] >= 0 && weight[k] <= 1)) refuse(fmt::format("weight {}, must lie in [0, 1]", weight[k]));
    sum += weight[k];
    acting += weight[k] > 0 ? 1 : 0;
  }
  if (std::abs(sum - 1) > 1e-6) refuse(fmt::format("the weights sum to {:.8g}, must sum to 1", sum));
  if (acting < 2) refuse("only one weight is not zero: the member would have a mechanism");
  return {position, weight};
}

struct Rule {
  std::string_view name;
  Quadrature (*make)(const Integration&, int points, double length);
};
constexpr Rule rules[] = {
    {"lobatto", lobatto}, {"legendre", legendre_rule}, {"radau", radau}, {"hinge-radau", hinge_radau}, {"user", user}};

}  // namespace

Quadrature gauss_lobatto(int n) {
  if (n < 2) throw std::invalid_argument("Gauss-Lobatto quadrature needs at least 2 points");
  const int degree = n - 1;
  Quadrature rule;
  for (int i = 0; i < n; ++i) {
    // Newton on (1 - x^2) P'(x) = degree (P_{degree-1} - x P_degree), whose derivative is -degree (degree + 1) P_degree
    double x = polish(-std::cos(pi * i / degree), [&](double at) {
      const auto [p, p_before] = legendre(degree, at);
      return (p_before - at * p) / ((degree + 1) * p);
    });
    if (i == 0) x = -1;
    if (i == degree) x = 1;
    const double p = legendre(degree, x).first;
    rule.position.push_back(0.5 * (1 + x));
    rule.weight.push_back(1.0 / (degree * n * p * p));
  }
  return rule;
}

Quadrature gauss_radau(int n) {
  if (n < 1) throw std::invalid_argument("Gauss-Radau quadrature needs at least 1 point");
  Quadrature rule{{0.0}, {1.0 / (n * n)}};
  for (int i = 1; i < n; ++i) {
    // Newton on (P_{n-1} + P_n) / (1 + x), whose derivative at a root is n (P_{n-1} - P_n) / (1 - x^2)
    const double x = polish(-std::cos(2 * pi * i / (2 * n - 1)), [&](double at) {
      const auto [p, p_before] = legendre(n, at);
      return -(1 - at) / n * (p_before + p) / (p_before - p);
    });
    const double p_before = legendre(n, x).second;
    rule.position.push_back(0.5 * (1 + x));
    rule.weight.push_back(0.5 * (1 - x) / (n * n * p_before * p_before));
  }
  return rule;
}

Quadrature gauss_legendre(int n) {
  if (n < 1) throw std::invalid_argument("Gauss-Legendre quadrature needs at least 1 point");
  const auto slope = [n](double x) {
    const auto [p, p_before] = legendre(n, x);
    return n * (x * p - p_before) / (x * x - 1);
  };
  Quadrature rule;
  for (int i = 0; i < n; ++i) {
    const double x =
        polish(-std::cos(pi * (i + 0.75) / (n + 0.5)), [&](double at) { return -legendre(n, at).first / slope(at); });
    rule.position.push_back(0.5 * (1 + x));
    rule.weight.push_back(1 / ((1 - x * x) * slope(x) * slope(x)));
  }
  return rule;
}

std::vector<std::string> integration_rules() {
  std::vector<std::string> names;
  for (const Rule& rule : rules) names.emplace_back(rule.name);
  return names;
}

Quadrature make_quadrature(const Integration& integration, int points, double length) {
  const bool hinges = integration.hinge_i != 0 || integration.hinge_j != 0;
  if (hinges && integration.rule != "hinge-radau") refuse("hinge_i and hinge_j belong to hinge-radau");
  if (!(integration.positions.empty() && integration.weights.empty()) && integration.rule != "user") {
    refuse("positions and weights belong to the rule \"user\"");
  }
  for (const Rule& rule : rules) {
    if (rule.name == integration.rule) return rule.make(integration, points, length);
  }
  refuse(fmt::format("there is no integration rule '{}'", integration.rule));
}

}  // namespace nsframe
