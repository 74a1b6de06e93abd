// Integration rules: degrees of exactness, hinge lengths, and what is refused.
#include <doctest/doctest.h>

#include <cmath>
#include <functional>
#include <stdexcept>

#include "elements/quadrature.hpp"

using namespace nsframe;

namespace {

double integral(const Quadrature& rule, const std::function<double(double)>& f) {
  double sum = 0;
  for (std::size_t i = 0; i < rule.weight.size(); ++i) sum += rule.weight[i] * f(rule.position[i]);
  return sum;
}

// Largest degree of polynomials that the rule integrates to rounding.
int exactness(const Quadrature& rule) {
  for (int degree = 0;; ++degree) {
    const double sum = integral(rule, [degree](double x) { return std::pow(x, degree); });
    if (std::abs(sum - 1.0 / (degree + 1)) > 1e-14) return degree - 1;
  }
}

std::string refusal(const Integration& integration, int points = 5, double length = 3) {
  try {
    make_quadrature(integration, points, length);
  } catch (const std::invalid_argument& problem) {
    return problem.what();
  }
  return "accepted";
}

}  // namespace

TEST_CASE("Gauss rules are exact to their degree and not beyond") {
  for (int n = 2; n <= 7; ++n) {  // the first error of more points is below rounding
    CAPTURE(n);
    CHECK(exactness(gauss_lobatto(n)) == 2 * n - 3);
    CHECK(exactness(gauss_radau(n)) == 2 * n - 2);
    CHECK(exactness(gauss_legendre(n)) == 2 * n - 1);
  }
  for (int n = 8; n <= max_points; ++n) {
    CHECK(exactness(gauss_lobatto(n)) >= 2 * n - 3);
    CHECK(exactness(gauss_radau(n)) >= 2 * n - 2);
    CHECK(exactness(gauss_legendre(n)) >= 2 * n - 1);
  }
}

TEST_CASE("Gauss-Lobatto has both ends as points, Gauss-Radau the first, and positions rise") {
  for (int n = 2; n <= max_points; ++n) {
    CHECK(gauss_lobatto(n).position.front() == 0);
    CHECK(gauss_lobatto(n).position.back() == 1);
    CHECK(gauss_radau(n).position.front() == 0);
    for (const Quadrature& rule : {gauss_lobatto(n), gauss_radau(n), gauss_legendre(n)}) {
      CHECK(std::is_sorted(rule.position.begin(), rule.position.end()));
    }
  }
}

TEST_CASE("Gauss-Radau hinges have the hinge lengths as weights and integrate each of their three parts exactly") {
  const double L = 3, i = 0.3, j = 0.2;
  const Quadrature rule = make_quadrature({"hinge-radau", i, j, {}, {}}, 5, L);
  REQUIRE(rule.size() == 6);
  CHECK(rule.weight.front() * L == doctest::Approx(i).epsilon(1e-15));
  CHECK(rule.weight.back() * L == doctest::Approx(j).epsilon(1e-15));
  CHECK(exactness(rule) == 2);
  // a polynomial of degree 2 on each part, none of them the same: the ends to 4 hinge lengths, the middle to degree 3
  const double a = 4 * i / L, b = 1 - 4 * j / L;
  const auto piecewise = [&](double x) {
    return x < a ? 1 + 7 * x * x : x < b ? x * x * x - 2 : 5 * (1 - x) * (1 - x) - x;
  };
  const double exact = a + 7 * a * a * a / 3 + (std::pow(b, 4) - std::pow(a, 4)) / 4 - 2 * (b - a) +
                       5 * std::pow(1 - b, 3) / 3 - (1 - b * b) / 2;
  CHECK(integral(rule, piecewise) == doctest::Approx(exact).epsilon(1e-14));
}

TEST_CASE("impossible integration is refused with what is wrong") {
  CHECK(refusal({"lobatto", 0, 0, {}, {}}, 2) == "points = 2, must lie in [3, 10]");
  CHECK(refusal({"legendre", 0, 0, {}, {}}, 2) == "accepted");
  CHECK(refusal({"radau", 0, 0, {}, {}}, 11) == "points = 11, must lie in [2, 10]");
  CHECK(refusal({"hinge-radau", 0.3, 0, {}, {}}) == "hinge-radau needs positive hinge_i and hinge_j");
  CHECK(refusal({"hinge-radau", 0.5, 0.3, {}, {}}) == "4 (hinge_i + hinge_j) = 3.2 m is more than the length, 3 m");
  CHECK(refusal({"hinge-radau", 0.5, 0.25, {}, {}}) == "accepted");
  CHECK(refusal({"lobatto", 0.5, 0.3, {}, {}}) == "hinge_i and hinge_j belong to hinge-radau");
  CHECK(refusal({"legendre", 0, 0, {0.5}, {1}}) == "positions and weights belong to the rule \"user\"");
  CHECK(refusal({"user", 0, 0, {0, 1}, {0.5}}) == "2 positions, but 1 weights");
  CHECK(refusal({"user", 0, 0, {0.5}, {1}}) == "1 positions, must be 2 to 10");
  CHECK(refusal({"user", 0, 0, {0, 1.2}, {0.5, 0.5}}) == "position 1.2, must lie in [0, 1]");
  CHECK(refusal({"user", 0, 0, {1, 0}, {0.5, 0.5}}) == "positions must rise from the first end to the second");
  CHECK(refusal({"user", 0, 0, {0, 0.5, 1}, {-0.5, 1, 0.5}}) == "weight -0.5, must lie in [0, 1]");
  CHECK(refusal({"user", 0, 0, {0, 1}, {0.5, 0.6}}) == "the weights sum to 1.1, must sum to 1");
  CHECK(refusal({"user", 0, 0, {0, 1}, {0, 1}}) == "only one weight is not zero: the member would have a mechanism");
  CHECK(refusal({"simpson", 0, 0, {}, {}}) == "there is no integration rule 'simpson'");
}
