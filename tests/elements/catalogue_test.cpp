// Rolled shapes: fibers against the tabulated properties, and against the section used with OpenSees.
#include "elements/catalogue.hpp"

#include <doctest/doctest.h>

#include <cmath>

#include "tests/support/numbers.hpp"

using namespace nsframe;

namespace {

struct SectionSums {
  double area = 0, strong = 0, weak = 0, y = 0, z = 0, product = 0;
};

SectionSums sums(const std::vector<FiberDescription>& fibers) {
  SectionSums s;
  for (const FiberDescription& f : fibers) {
    s.area += f.area;
    s.strong += f.area * f.y * f.y;
    s.weak += f.area * f.z * f.z;
    s.y += f.area * f.y;
    s.z += f.area * f.z;
    s.product += f.area * f.y * f.z;
  }
  return s;
}

// y, z [m], area [m2] of the flanges and the web of HEA140 as given to OpenSees (tests/reference/README.md).
constexpr double hea140[48][3] = {
    {0.060125, -0.063, 5.95e-05},  {0.060125, -0.049, 5.95e-05},  {0.060125, -0.035, 5.95e-05},
    {0.060125, -0.021, 5.95e-05},  {0.060125, -0.007, 5.95e-05},  {0.060125, 0.007, 5.95e-05},
    {0.060125, 0.021, 5.95e-05},   {0.060125, 0.035, 5.95e-05},   {0.060125, 0.049, 5.95e-05},
    {0.060125, 0.063, 5.95e-05},   {0.064375, -0.063, 5.95e-05},  {0.064375, -0.049, 5.95e-05},
    {0.064375, -0.035, 5.95e-05},  {0.064375, -0.021, 5.95e-05},  {0.064375, -0.007, 5.95e-05},
    {0.064375, 0.007, 5.95e-05},   {0.064375, 0.021, 5.95e-05},   {0.064375, 0.035, 5.95e-05},
    {0.064375, 0.049, 5.95e-05},   {0.064375, 0.063, 5.95e-05},   {-0.060125, -0.063, 5.95e-05},
    {-0.060125, -0.049, 5.95e-05}, {-0.060125, -0.035, 5.95e-05}, {-0.060125, -0.021, 5.95e-05},
    {-0.060125, -0.007, 5.95e-05}, {-0.060125, 0.007, 5.95e-05},  {-0.060125, 0.021, 5.95e-05},
    {-0.060125, 0.035, 5.95e-05},  {-0.060125, 0.049, 5.95e-05},  {-0.060125, 0.063, 5.95e-05},
    {-0.064375, -0.063, 5.95e-05}, {-0.064375, -0.049, 5.95e-05}, {-0.064375, -0.035, 5.95e-05},
    {-0.064375, -0.021, 5.95e-05}, {-0.064375, -0.007, 5.95e-05}, {-0.064375, 0.007, 5.95e-05},
    {-0.064375, 0.021, 5.95e-05},  {-0.064375, 0.035, 5.95e-05},  {-0.064375, 0.049, 5.95e-05},
    {-0.064375, 0.063, 5.95e-05},  {-0.05075, 0, 7.975e-05},      {-0.03625, 0, 7.975e-05},
    {-0.02175, 0, 7.975e-05},      {-0.00725, 0, 7.975e-05},      {0.00725, 0, 7.975e-05},
    {0.02175, 0, 7.975e-05},       {0.03625, 0, 7.975e-05},       {0.05075, 0, 7.975e-05},
};

}  // namespace

TEST_CASE("fibers of every European shape give its tabulated area and moments within 0.5 %") {
  const ShapeMesh fine{40, 4, 40, true};
  CHECK(european_shapes().size() == 90);
  for (const CatalogueShape& shape : european_shapes()) {
    CAPTURE(shape.name);
    const SectionSums s = sums(shape_fibers(shape, fine, {}));
    CHECK(relative_difference(s.area, shape.A) < 0.005);
    CHECK(relative_difference(s.strong, shape.I_strong) < 0.005);
    CHECK(relative_difference(s.weak, shape.I_weak) < 0.005);
  }
}

TEST_CASE("area and moments of every W shape lie where the rounding of its dimensions allows") {
  CHECK(w_shapes().size() == 289);
  for (const CatalogueShape& shape : w_shapes()) {
    CAPTURE(shape.name);
    // all are published with three digits in inches
    const auto half_digit = [](double value) { return 0.5 * std::pow(10, std::floor(std::log10(value) + 1e-9) - 2); };
    const double in = 0.0254;
    const auto bound = [&](double side) {
      CatalogueShape s = shape;
      for (double* dimension : {&s.h, &s.b, &s.tw, &s.tf}) *dimension += side * in * half_digit(*dimension / in);
      s.r = std::max(0.0, s.r + side * in * (half_digit((shape.r + shape.tf) / in) + half_digit(shape.tf / in)));
      return shape_moments(s, true);
    };
    const AreaMoments low = bound(-1), high = bound(1);
    const auto inside = [](double tabulated, double digit, double least, double most, double slack) {
      return tabulated + digit >= (1 - slack) * least && tabulated - digit <= (1 + slack) * most;
    };
    const double in2 = in * in, in4 = in2 * in2;
    // W30X99 and W18X192 are tabulated with 0.2 % less area than any shape of their dimensions has
    CHECK(inside(shape.A, in2 * half_digit(shape.A / in2), low.area, high.area, 0.0025));
    CHECK(inside(shape.I_strong, in4 * half_digit(shape.I_strong / in4), low.second(0, 0), high.second(0, 0), 0));
    CHECK(inside(shape.I_weak, in4 * half_digit(shape.I_weak / in4), low.second(1, 1), high.second(1, 1), 0));
    // steel of 490 lb/ft3; names round the weight to a pound, W6X8.5 to a half
    const double weight = shape.A / in2 * 490.0 / 144;
    const double nominal = std::stod(std::string(shape.name.substr(shape.name.find('X') + 1)));
    CHECK(std::abs(weight - nominal) < 0.5 + 0.014 * nominal);
  }
}

TEST_CASE("fibers are centred on the axes of symmetry") {
  for (const std::string& name : shape_names()) {
    CAPTURE(name);
    for (const bool exact : {false, true}) {
      const SectionSums s = sums(shape_fibers(*find_shape(name), {10, 2, 8, true, exact}, {}));
      CHECK(std::abs(s.y) < 1e-14 * s.area);
      CHECK(std::abs(s.z) < 1e-14 * s.area);
      CHECK(std::abs(s.product) < 1e-14 * s.weak);
    }
  }
}

TEST_CASE("fibers with exact moments keep area, both second moments and the plastic moments of the drawn shape") {
  for (const std::string& name : shape_names()) {
    CAPTURE(name);
    const CatalogueShape& shape = *find_shape(name);
    for (const bool fillets : {true, false}) {
      const auto fibers = shape_fibers(shape, {10, 2, 8, fillets, true}, {});
      const SectionSums s = sums(fibers);
      const AreaMoments exact = shape_moments(shape, fillets);
      CHECK(relative_difference(s.area, exact.area) < 1e-13);
      CHECK(relative_difference(s.strong, exact.second(0, 0)) < 1e-13);
      CHECK(relative_difference(s.weak, exact.second(1, 1)) < 1e-13);
      if (fillets) continue;
      double strong = 0, weak = 0;
      for (const FiberDescription& f : fibers) {
        strong += f.area * std::abs(f.y);
        weak += f.area * std::abs(f.z);
      }
      const double web = shape.h - 2 * shape.tf, b = shape.b;
      CHECK(relative_difference(strong, b * shape.tf * (shape.h - shape.tf) + shape.tw * web * web / 4) < 1e-12);
      // the web lies on the axis; its second moment goes into the flanges, which are spread by half of its share
      CHECK(relative_difference(weak, b * b * shape.tf / 2) < 0.01);
    }
  }
}

TEST_CASE("exact moments of a shape are those of a fine mesh") {
  for (const char* name : {"HEA100", "HEM500", "IPE600", "W14X90", "W44X408"}) {
    CAPTURE(name);
    const CatalogueShape& shape = *find_shape(name);
    const SectionSums s = sums(shape_fibers(shape, {2000, 200, 2000, false}, {}));
    const AreaMoments exact = shape_moments(shape, false);
    // strips lose 1/n^2; the web is one fiber thick
    const double web = (shape.h - 2 * shape.tf) * std::pow(shape.tw, 3) / 12;
    CHECK(relative_difference(s.area, exact.area) < 1e-9);  // rounding of a sum of 800 000
    CHECK(relative_difference(s.strong, exact.second(0, 0)) < 1e-6);
    CHECK(relative_difference(s.weak + web, exact.second(1, 1)) < 1e-6);
  }
}

TEST_CASE("the default mesh keeps area and strong axis within 0.5 %, and loses 1 % of the weak one") {
  for (const CatalogueShape& shape : european_shapes()) {
    CAPTURE(shape.name);
    const SectionSums s = sums(shape_fibers(shape, {}, {}));
    CHECK(relative_difference(s.area, shape.A) < 0.005);
    CHECK(relative_difference(s.strong, shape.I_strong) < 0.005);
    // n equal strips lack 1/n^2 of a rectangle's moment about its middle: 1/100 of the flanges' with ten fibers across,
    // all of the web's with one; the rest, the fillets' own, is below 0.1 %
    const double web = (shape.h - 2 * shape.tf) * shape.tw * shape.tw * shape.tw / 12;
    const double lost = (shape.tf * shape.b * shape.b * shape.b / 600 + web) / shape.I_weak;
    CHECK(std::abs(1 - s.weak / shape.I_weak - lost) < 0.001);
    CHECK(lost < 0.014);
  }
}

TEST_CASE("fibers of HEA140 are those of the reference model in order and place") {
  const auto fibers = shape_fibers(*find_shape("HEA140"), {}, {"steel", {}});
  REQUIRE(fibers.size() == 52);
  for (std::size_t i = 0; i < 48; ++i) {
    CAPTURE(i);
    // the reference has twelve digits
    CHECK(std::abs(fibers[i].y - hea140[i][0]) < 1e-14);
    CHECK(std::abs(fibers[i].z - hea140[i][1]) < 1e-14);
    CHECK(std::abs(fibers[i].area - hea140[i][2]) < 1e-16);
    CHECK(fibers[i].material.name == "steel");
  }
  // fillets of r = 12 mm: (1 - pi/4) r^2 at (10 - 3 pi)/(12 - 3 pi) r from web and flange
  CHECK(relative_difference(fibers[48].area, 3.0902e-5) < 1e-4);
  const double place = (10 - 3 * pi) / (12 - 3 * pi) * 0.012;
  CHECK(fibers[48].y == doctest::Approx(0.058 - place).epsilon(1e-12));
  CHECK(fibers[48].z == doctest::Approx(0.00275 + place).epsilon(1e-12));
  CHECK(fibers[51].y == -fibers[48].y);
  CHECK(fibers[51].z == -fibers[48].z);
  CHECK(shape_fibers(*find_shape("HEA140"), {4, 1, 3, false}, {}).size() == 11);
}

TEST_CASE("shapes are found by name whatever the case and the blanks") {
  const CatalogueShape* shape = find_shape("HEA140");
  REQUIRE(shape != nullptr);
  CHECK(shape->h == 0.133);
  CHECK(shape->tf == 0.0085);
  CHECK(relative_difference(shape->J, 8.13e-8) < 1e-15);
  for (const char* name : {"hea140", " HEA 140 ", "Hea\t140", "HE 140 A", "he140a"}) CHECK(find_shape(name) == shape);
  CHECK(find_shape("HEB1000")->h == 1.0);
  CHECK(find_shape("ipe 80")->b == 0.046);
  CHECK(find_shape("he 300 m") == find_shape("HEM300"));
  CHECK(find_shape("w14x90")->h == 14 * 0.0254);
  CHECK(find_shape("W6x8.5") != nullptr);
  for (const char* name : {"", "HEA", "HEA141", "HE 140 C", "W14X91", "140"}) CHECK(find_shape(name) == nullptr);
}

TEST_CASE("the outline encloses the area without fillets") {
  for (const std::string& name : shape_names()) {
    CAPTURE(name);
    const CatalogueShape& s = *find_shape(name);
    const SectionOutline outline = shape_outline(s);
    REQUIRE(outline.size() == 12);
    double twice_area = 0;
    for (std::size_t i = 0; i < 12; ++i) {
      const Vector2 &a = outline[i], &b = outline[(i + 1) % 12];
      CHECK(((a - b).array() == 0).any());  // edges run along y or z
      twice_area += a.x() * b.y() - a.y() * b.x();
    }
    const double plain = 2 * s.b * s.tf + (s.h - 2 * s.tf) * s.tw;
    CHECK(relative_difference(std::abs(twice_area) / 2, plain) < 1e-13);
  }
}

TEST_CASE("torsion constants are those of El Darwish and Johnston for the drawn shape") {
  const auto formula = [](const CatalogueShape& s) {
    const double diameter =
        ((s.r + s.tw / 2) * (s.r + s.tw / 2) + (s.r + s.tf) * (s.r + s.tf) - s.r * s.r) / (2 * s.r + s.tf);
    const double junction = s.tw / s.tf * (0.145 + 0.1 * s.r / s.tf);
    return 2.0 / 3 * (s.b - 0.63 * s.tf) * s.tf * s.tf * s.tf + (s.h - 2 * s.tf) * s.tw * s.tw * s.tw / 3 +
           2 * junction * std::pow(diameter, 4);
  };
  for (const CatalogueShape& s : european_shapes()) {
    CAPTURE(s.name);
    CHECK(relative_difference(s.J, formula(s)) < 0.0035);  // IPE80 is tabulated as 0.70 cm4
  }
  for (const CatalogueShape& s : w_shapes()) {
    CAPTURE(s.name);
    CHECK(relative_difference(s.J, formula(s)) < 0.08);  // AISC's values are lower for thin flanges
  }
}
