// Blocks of sections: areas and moments against closed forms.
#include "elements/fiber_cutting.hpp"

#include <doctest/doctest.h>

#include <cmath>

#include "elements/torsion.hpp"
#include "tests/support/numbers.hpp"

using namespace nsframe;

namespace {

double sum_area(const Fibers& fibers) { return moments(fibers).area; }

}  // namespace

TEST_CASE("n strips at their middles lose 1/n^2 of a rectangle's second moment, exact ones nothing") {
  for (int n = 2; n <= 21; ++n) {
    CAPTURE(n);
    for (const Spacing spacing : {Spacing::midpoints, Spacing::exact}) {
      Fibers fibers;
      add_rectangle(fibers, {{0.1, 0.5}, {-0.3, -0.1}}, n, n, {}, spacing);
      const AreaMoments m = moments(fibers);
      const double lost = spacing == Spacing::exact ? 0 : 1.0 / (n * n);
      CHECK(relative_difference(m.area, 0.08) < 1e-13);
      CHECK(relative_difference(m.second(0, 0), (1 - lost) * 0.2 * 0.064 / 12) < 1e-12);
      CHECK(relative_difference(m.second(1, 1), (1 - lost) * 0.4 * 0.008 / 12) < 1e-12);
      CHECK(std::abs(m.second(0, 1)) < 1e-16);
      CHECK((m.centroid - Vector2(0.3, -0.2)).norm() < 1e-14);
      // the plastic moment b h^2/4
      double plastic = 0;
      for (const FiberDescription& f : fibers) {
        plastic += f.area * std::abs(f.y - 0.3);
        CHECK(std::abs(f.y - 0.3) < 0.2);
      }
      if (n % 2 == 0 && n > 2) CHECK(relative_difference(plastic, 0.2 * 0.16 / 4) < 1e-12);
    }
  }
  Fibers one;
  add_rectangle(one, {{0, 1}, {0, 1}}, 1, 1, {}, Spacing::exact);
  CHECK(one[0].y == 0.5);
}

TEST_CASE("cells of a quadrilateral fill it, each at its centroid") {
  const Quadrilateral trapeze{Vector2(0, 0), Vector2(2, 0), Vector2(1.5, 1), Vector2(0.5, 1)};
  REQUIRE(is_convex(trapeze));
  for (const int n : {1, 3, 8}) {
    Fibers fibers;
    add_quadrilateral(fibers, trapeze, n, n + 1, {});
    REQUIRE(int(fibers.size()) == n * (n + 1));
    CHECK(sum_area(fibers) == doctest::Approx(1.5).epsilon(1e-14));
    // (a + 2 b)/(3 (a + b)) of the height from side a
    CHECK((moments(fibers).centroid - Vector2(1, (2 + 2.0) / 9)).norm() < 1e-14);
  }
  // second moment about the base: h^3 (a + 3 b)/12, its loss falls with n^2
  const auto about_base = [&](int n) {
    Fibers fibers;
    add_quadrilateral(fibers, trapeze, n, n, {});
    double sum = 0;
    for (const FiberDescription& f : fibers) sum += f.area * f.z * f.z;
    return 5.0 / 12 - sum;
  };
  CHECK(about_base(20) > 0);
  CHECK(relative_difference(about_base(20), about_base(40) * 4) < 0.01);
  // the same going round the other way, and not for a folded or hollow one
  CHECK(is_convex({trapeze[3], trapeze[2], trapeze[1], trapeze[0]}));
  CHECK_FALSE(is_convex({trapeze[0], trapeze[2], trapeze[1], trapeze[3]}));
  CHECK_FALSE(is_convex({Vector2(0, 0), Vector2(2, 0), Vector2(0.4, 0.3), Vector2(0, 2)}));
  CHECK_FALSE(is_convex({Vector2(0, 0), Vector2(1, 0), Vector2(2, 0), Vector2(3, 0)}));
}

TEST_CASE("a ring's sectors have its area, and its centroids") {
  Fibers ring;
  add_ring(ring, {{0.1, 0.2}, 0.3, 0.5}, 3, 7, {});
  CHECK(ring.size() == 21);
  CHECK(relative_difference(sum_area(ring), pi * 0.16) < 1e-14);
  CHECK((moments(ring).centroid - Vector2(0.1, 0.2)).norm() < 1e-15);
  Fibers half;
  add_ring(half, {{0, 0}, 0, 1, 0, pi}, 5, 1, {});
  CHECK(relative_difference(moments(half).centroid.y(), 4 / (3 * pi)) < 1e-14);
  Fibers fine;
  add_ring(fine, {{0, 0}, 0, 1}, 200, 400, {});
  CHECK(relative_difference(moments(fine).second(0, 0), pi / 4) < 1e-4);
}

TEST_CASE("bars lie on lines and arcs with both ends, once around without a double") {
  Fibers line;
  add_bars(line, {0, 0}, {2, 4}, 3, 1e-4, {});
  CHECK(line[1].y == 1);
  CHECK(line[2].z == 4);
  Fibers one;
  add_bars(one, {0, 0}, {2, 4}, 1, 1e-4, {});
  CHECK(one[0].z == 2);
  Fibers circle;
  add_bars(circle, Vector2(1, 1), 2, 0, 2 * pi, 4, 1e-4, {});
  CHECK(circle[2].y == doctest::Approx(-1).epsilon(1e-15));
  CHECK(circle[3].z == doctest::Approx(-1).epsilon(1e-15));
  Fibers arc;
  add_bars(arc, Vector2(0, 0), 1, 0, pi / 2, 3, 1e-4, {});
  CHECK(arc[1].y == doctest::Approx(std::sqrt(0.5)));
  CHECK(arc[2].z == doctest::Approx(1));
}

TEST_CASE("moments are matched by moving fibers as little as needed") {
  Fibers fibers;
  add_rectangle(fibers, {{0, 0.2}, {0, 0.1}}, 3, 2, {});
  AreaMoments target{0.021, {0.3, -0.1}, {}};
  target.second << 8e-5, -1e-5, -1e-5, 2e-5;
  match_moments(fibers, target);
  const AreaMoments m = moments(fibers);
  CHECK(relative_difference(m.area, target.area) < 1e-14);
  CHECK((m.centroid - target.centroid).norm() < 1e-15);
  CHECK((m.second - target.second).norm() < 1e-13 * target.second.norm());
  // already there: nothing moves
  const Fibers before = fibers;
  match_moments(fibers, target);
  for (std::size_t i = 0; i < fibers.size(); ++i) CHECK(std::abs(fibers[i].y - before[i].y) < 1e-14);
}

TEST_CASE("the spandrel of a fillet is the limit of its strips") {
  const double r = 0.02;
  const AreaMoments exact = spandrel(r, {0.1, 0.2}, {-1, 1});
  Fibers strips;
  const int n = 4000;
  for (int i = 0; i < n; ++i) {
    const double x = (i + 0.5) * r / n, height = r - std::sqrt(r * r - (r - x) * (r - x));
    for (int j = 0; j < 8; ++j) strips.push_back({0.1 - x, 0.2 + (j + 0.5) * height / 8, r / n * height / 8, {}});
  }
  const AreaMoments m = moments(strips);
  CHECK(relative_difference(m.area, exact.area) < 1e-5);
  CHECK((m.centroid - exact.centroid).norm() < 1e-5 * r);
  CHECK(relative_difference(m.second(0, 0), exact.second(0, 0)) < 1e-4);
  CHECK(relative_difference(m.second(0, 1), exact.second(0, 1)) < 1e-4);
  CHECK(relative_difference(m.second(1, 1), exact.second(1, 1)) < 0.02);  // eight strips of its height
  CHECK(relative_difference(exact.second(0, 0), exact.second(1, 1)) < 1e-14);
}

TEST_CASE("torsion constants of rectangles and tubes are those of the handbooks") {
  // Timoshenko and Goodier (1970), table of k1: J = k1 a b^3
  CHECK(rectangle_torsion(1, 1) == doctest::Approx(0.1406).epsilon(4e-4));
  CHECK(rectangle_torsion(2, 1) == doctest::Approx(2 * 0.229).epsilon(2e-3));
  CHECK(rectangle_torsion(1, 10) == doctest::Approx(10 * 0.312).epsilon(2e-3));
  CHECK(rectangle_torsion(1, 1000) == doctest::Approx(1000.0 / 3).epsilon(1e-3));
  // EN 10210-2: 200 x 100 x 8 and 100 x 100 x 5, hot finished
  CHECK(tube_torsion(0.2, 0.1, 0.008, 0.010) == doctest::Approx(1804e-8).epsilon(1e-3));
  CHECK(tube_torsion(0.1, 0.1, 0.005, 0.00625) == doctest::Approx(439e-8).epsilon(1e-3));
  // a thin round tube drawn square by corners: 2 pi r^3 t
  CHECK(tube_torsion(1, 1, 1e-3, 0.4995) == doctest::Approx(2 * pi * std::pow(0.4995, 3) * 1e-3).epsilon(1e-5));
  // two thin legs: (h + b) t^3/3 without the corner counted twice
  CHECK(angle_torsion(0.3, 0.2, 1e-4, 0) == doctest::Approx(0.4999 * 1e-12 / 3).epsilon(1e-3));
}

TEST_CASE("the convex outline goes around its points") {
  const SectionOutline hull = convex_outline({{0, 0}, {2, 0}, {1, 0.5}, {2, 1}, {0, 1}, {0, 1}, {1, 1}});
  CHECK(hull == SectionOutline{{0, 0}, {2, 0}, {2, 1}, {0, 1}});
  CHECK(convex_outline({{0, 0}, {1, 1}}).empty());
  CHECK(convex_outline({{0, 0}, {1, 1}, {2, 2}}).size() < 3);
}
