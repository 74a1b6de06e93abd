// Contact problems with known answers, for every solver.
#pragma once

#include <string>
#include <vector>

#include "contact/contact_problem.hpp"

namespace nsframe::test {

struct StoredProblem {
  std::string name;
  ContactProblem problem;
  MatrixX response;       // M^-1 H': velocity change = response * p
  VectorX before, after;  // velocities of the bodies [m/s]
};

// Bodies with masses `m` and velocities `v`, contacts H (gap rate = H v), restitution e.
inline StoredProblem bodies(const std::string& name, const VectorX& m, const MatrixX& H, const VectorX& v, double e, const VectorX& after) {
  const MatrixX response = m.cwiseInverse().asDiagonal() * H.transpose();
  return {name, {H * response, (1 + e) * (H * v)}, response, v, after};
}

inline StoredProblem mass_on_wall(double m, double v, double e) {
  return bodies("mass on a wall", VectorX::Constant(1, m), MatrixX::Ones(1, 1), VectorX::Constant(1, v), e, VectorX::Constant(1, v < 0 ? -e * v : v));
}

// n touching equal balls, the first arrives with 1 m/s, e = 1: v1 = (2 - n)/n, others 2/n (Moreau; hard-case figures).
inline StoredProblem newtons_cradle(int n) {
  MatrixX H = MatrixX::Zero(n - 1, n);
  for (int i = 0; i + 1 < n; ++i) {
    H(i, i) = -1;
    H(i, i + 1) = 1;
  }
  VectorX after = VectorX::Constant(n, 2.0 / n);
  after[0] = (2.0 - n) / n;
  return bodies("Newton's cradle of " + std::to_string(n), VectorX::Ones(n), H, VectorX::Unit(n, 0), 1, after);
}

// A rigid slab (m = 4600 kg, corners at +-1.6, +-1.1 m) dropped flat by 0.05 m on its four corners, e = 0.5: three
// DOFs uz, rx, ry, so that W has rank 3 of 4; the sum of impulses is 6834.136 N s, and it does not turn.
inline StoredProblem dropped_slab() {
  const double m = 4600, a = 1.6, b = 1.1, e = 0.5, speed = std::sqrt(2 * 9.81 * 0.05);
  VectorX inertia(3);
  inertia << m, m * b * b / 3, m * a * a / 3;  // [kg], [kg m2]
  MatrixX H(4, 3);
  H << 1, -b, a, 1, -b, -a, 1, b, -a, 1, b, a;
  return bodies("dropped slab", inertia, H, -speed * VectorX::Unit(3, 0), e, e * speed * VectorX::Unit(3, 0));
}

// Two balls: v1 = (m1 - e m2) / (m1 + m2), v2 = m1 (1 + e) / (m1 + m2) for the first at 1 m/s.
inline StoredProblem ball_on_ball(double m1, double m2, double e) {
  VectorX m(2), after(2);
  m << m1, m2;
  after << (m1 - e * m2) / (m1 + m2), m1 * (1 + e) / (m1 + m2);
  MatrixX H(1, 2);
  H << -1, 1;
  return bodies("ball on ball", m, H, VectorX::Unit(2, 0), e, after);
}

// A heavy ball of mass `ratio` rests on a light one of 1 kg on the floor, e = 0, over a step of gravity impulse h g = 0.01.
inline StoredProblem stack(double ratio) {
  VectorX m(2);
  m << 1, ratio;
  MatrixX H(2, 2);
  H << 1, 0, -1, 1;
  return bodies("stack", m, H, VectorX::Constant(2, -0.01), 0, VectorX::Zero(2));
}

inline std::vector<StoredProblem> stored_problems() {
  return {mass_on_wall(2, -3, 0.65), mass_on_wall(2, 3, 0.65), mass_on_wall(2, 0, 0.65),
          newtons_cradle(2), newtons_cradle(3), newtons_cradle(10), dropped_slab(), ball_on_ball(1, 3, 0.6), ball_on_ball(1e6, 1, 0.5),
          ball_on_ball(1, 1e6, 0.5), ball_on_ball(1e10, 1, 0.5), ball_on_ball(1, 1e10, 0.5), stack(1), stack(10), stack(100)};
}

}  // namespace nsframe::test
