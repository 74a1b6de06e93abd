#include "elements/quadrature.hpp"

#include <cmath>
#include <stdexcept>
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

}  // namespace

Quadrature gauss_lobatto(int n) {
  if (n < 2) throw std::invalid_argument("Gauss-Lobatto quadrature needs at least 2 points");
  const int degree = n - 1;
  Quadrature rule;
  for (int i = 0; i < n; ++i) {
    double x = -std::cos(pi * i / degree);
    // Newton on (1 - x^2) P'(x) = degree (P_{degree-1} - x P_degree), whose derivative is -degree (degree + 1) P_degree
    for (int iteration = 0; iteration < 50; ++iteration) {
      const auto [p, p_before] = legendre(degree, x);
      const double change = (p_before - x * p) / ((degree + 1) * p);
      x += change;
      if (std::abs(change) < 1e-16) break;
    }
    if (i == 0) x = -1;
    if (i == degree) x = 1;
    const double p = legendre(degree, x).first;
    rule.position.push_back(0.5 * (1 + x));
    rule.weight.push_back(1.0 / (degree * n * p * p));
  }
  return rule;
}

}  // namespace nsframe
