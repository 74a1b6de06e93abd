#include <doctest/doctest.h>

#include "elements/catalogue.hpp"
#include "output/polygon.hpp"

using namespace nsframe;

namespace {

double area_of_triangles(const std::vector<Vector2>& polygon) {
  double area = 0;
  for (const auto& [a, b, c] : triangulate(polygon)) {
    const auto at = [&](int i) { return polygon[static_cast<std::size_t>(i)]; };
    const double part = signed_area({at(a), at(b), at(c)});
    CHECK(part >= 0);
    area += part;
  }
  return area;
}

}  // namespace

TEST_CASE("the triangles of a non-convex polygon cover its area once") {
  const std::vector<Vector2> square{{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  CHECK(triangulate(square).size() == 2);
  CHECK(area_of_triangles(square) == doctest::Approx(1).epsilon(1e-14));
  const std::vector<Vector2> angle{{0, 0}, {3, 0}, {3, 1}, {1, 1}, {1, 2}, {0, 2}};
  CHECK(triangulate(angle).size() == 4);
  CHECK(area_of_triangles(angle) == doctest::Approx(4).epsilon(1e-14));
}

TEST_CASE("the end of an I shape is closed without covering the space beside its web") {
  for (const char* name : {"HEA100", "HEB300", "IPE200"}) {
    std::vector<Vector2> outline = shape_outline(*find_shape(name));
    if (signed_area(outline) < 0) outline = {outline.rbegin(), outline.rend()};
    CHECK(triangulate(outline).size() == outline.size() - 2);
    CHECK(area_of_triangles(outline) == doctest::Approx(signed_area(outline)).epsilon(1e-12));
    CHECK(signed_area(outline) == doctest::Approx(find_shape(name)->A).epsilon(0.1));  // fillets may not be drawn
  }
}

TEST_CASE("a polygon with corners on one line still ends in n - 2 triangles") {
  const std::vector<Vector2> flat{{0, 0}, {1, 0}, {2, 0}, {2, 1}, {1, 1}, {0, 1}};
  CHECK(triangulate(flat).size() == 4);
  CHECK(triangulate({{0, 0}, {1, 0}, {2, 0}}).size() == 1);
}
