// Coulomb friction in contact problems: one block, wedged and redundant contacts, random problems.
#include <doctest/doctest.h>

#include <cmath>
#include <random>

#include "contact/friction.hpp"
#include "tests/support/numbers.hpp"

using namespace nsframe;

namespace {

// The law itself, without the error measure: largest violation as a velocity or, with `w`, of impulses as one.
double violation(const FrictionProblem& problem, const VectorX& p) {
  const VectorX u = problem.delassus * p + problem.rhs;
  double worst = 0;
  for (Eigen::Index i = 0; i < problem.pairs(); ++i) {
    const double mu = problem.friction[i], w = problem.delassus(3 * i, 3 * i), normal = p[3 * i];
    const Vector2 t = p.segment<2>(3 * i + 1), slip = u.segment<2>(3 * i + 1);
    worst = std::max({worst, -w * normal, -u[3 * i], w * (t.norm() - mu * normal)});
    if (w * normal > 1e-9) worst = std::max(worst, std::abs(u[3 * i]));
    if (mu > 0 && slip.norm() > 1e-9) worst = std::max(worst, w * (t + mu * normal * slip.normalized()).norm());
  }
  return worst;
}

// `bodies` free in three directions each, random contacts between two or with the ground; more contacts than bodies: redundant.
FrictionProblem random_problem(std::mt19937& random, int bodies, int contacts, double decades, double largest_friction) {
  std::uniform_real_distribution<double> number(-1, 1);
  MatrixX H = MatrixX::Zero(3 * contacts, 3 * bodies);
  VectorX m(3 * bodies), v(3 * bodies);
  for (int b = 0; b < bodies; ++b) m.segment<3>(3 * b).setConstant(std::pow(10, 0.5 * decades * (1 + number(random))));
  for (Eigen::Index j = 0; j < v.size(); ++j) v[j] = number(random);
  FrictionProblem problem;
  problem.friction.resize(contacts);
  for (int c = 0; c < contacts; ++c) {
    const Vector3 n = Vector3(number(random), number(random), number(random)).normalized();
    const Vector3 s = n.unitOrthogonal(), t = n.cross(s);
    Matrix3 frame;
    frame << n.transpose(), s.transpose(), t.transpose();
    const int a = c % bodies, b = static_cast<int>(random() % static_cast<unsigned>(bodies + 1));
    H.block<3, 3>(3 * c, 3 * a) = frame;
    if (b < bodies && b != a) H.block<3, 3>(3 * c, 3 * b) = -frame;
    problem.friction[c] = random() % 4 == 0 ? 0 : largest_friction * std::abs(number(random));
  }
  problem.delassus = H * m.cwiseInverse().asDiagonal() * H.transpose();
  problem.rhs = H * v;
  return problem;
}

}  // namespace

TEST_CASE("a block that is thrown on the floor sticks, slips or lifts off as by hand") {
  const double m = 2, mu = 0.4;
  const MatrixX W = MatrixX::Identity(3, 3) / m;
  const auto solve = [&](Vector3 velocity) {
    const ContactSolution s = solve_friction({W, velocity, VectorX::Constant(1, mu)}, {});
    CHECK(s.converged);
    return Vector3(s.impulse);
  };
  CHECK(solve({0.1, 3, 2}) == Vector3::Zero());
  CHECK((solve({-1, 0.3, 0}) - m * Vector3(1, -0.3, 0)).norm() < 8 * epsilon);                     // sticks
  CHECK((solve({-1, 3, 4}) - m * Vector3(1, -0.4 * 0.6, -0.4 * 0.8)).norm() < 32 * epsilon);       // slips on
  CHECK((solve({-1, 3, 4}) - m * solve_one_contact(Matrix3::Identity(), {-1, 3, 4}, mu)).norm() < 32 * epsilon);
}

TEST_CASE("two walls that close on a block leave no solution, and that is told") {
  const double mu = 0.5;
  for (const double v : {0.9, 1.1}) {
    MatrixX H(6, 3);  // block: x, y, z; walls at both sides
    H << -1, 0, 0, 0, 1, 0, 0, 0, 1, 1, 0, 0, 0, 1, 0, 0, 0, 1;
    VectorX rhs = H * Vector3(0, v, 0);
    rhs[0] = rhs[3] = -1e-3;  // walls that close a little cannot: no solution at rest
    FrictionProblem problem{H * H.transpose(), rhs, VectorX::Constant(2, mu)};
    const ContactSolution squeezed = solve_friction(problem, {1e-12, 500});
    CHECK_FALSE(squeezed.converged);
    CHECK(squeezed.error > 1e-4);
  }
}

TEST_CASE("random contacts with friction, redundant ones and masses over decades included, all hold Coulomb's law") {
  std::mt19937 random(11);
  int failed = 0, most = 0, slipping = 0, sticking = 0;
  double worst = 0;
  const int trials = 3000;
  for (int trial = 0; trial < trials; ++trial) {
    const int bodies = 1 + trial % 6, contacts = 1 + static_cast<int>(random() % 12);
    const FrictionProblem problem = random_problem(random, bodies, contacts, trial % 4, 0.8);
    const ContactSolution s = solve_friction(problem, {1e-12, 20000});
    most = std::max(most, s.iterations);
    if (!s.converged) {
      ++failed;
      continue;
    }
    worst = std::max(worst, violation(problem, s.impulse));
    const VectorX u = problem.delassus * s.impulse + problem.rhs;
    for (Eigen::Index i = 0; i < problem.pairs(); ++i) {
      if (problem.friction[i] > 0 && s.impulse[3 * i] > 1e-6) ++(u.segment<2>(3 * i + 1).norm() > 1e-9 ? slipping : sticking);
    }
    CHECK(s.impulse.dot(problem.rhs + 0.5 * problem.delassus * s.impulse) < 1e-10);  // restitution 0 and friction take energy away
  }
  MESSAGE(failed, " of ", trials, " failed; most iterations ", most, "; worst violation ", worst, "; slips ", slipping, ", sticks ", sticking);
  CHECK(failed == 0);
  CHECK(worst < 1e-9);
  CHECK(slipping > 500);
  CHECK(sticking > 500);
}
