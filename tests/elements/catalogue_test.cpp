// Rolled shapes: fibers against the tabulated properties, and against the section used with OpenSees.
#include "elements/catalogue.hpp"

#include <doctest/doctest.h>

#include <cmath>

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

double difference(double value, double reference) { return std::abs(value / reference - 1); }

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

TEST_CASE("fibers of every shape give its tabulated area and moments within 0.5 %") {
  const ShapeMesh fine{40, 4, 40, true};
  CHECK(shape_names().size() == 66);
  for (const std::string& name : shape_names()) {
    CAPTURE(name);
    const CatalogueShape& shape = *find_shape(name);
    const SectionSums s = sums(shape_fibers(shape, fine, {}));
    CHECK(difference(s.area, shape.A) < 0.005);
    CHECK(difference(s.strong, shape.I_strong) < 0.005);
    CHECK(difference(s.weak, shape.I_weak) < 0.005);
    // doubly symmetric: first moments and product vanish to rounding
    CHECK(std::abs(s.y) < 1e-14 * s.area);
    CHECK(std::abs(s.z) < 1e-14 * s.area);
    CHECK(std::abs(s.product) < 1e-14 * s.weak);
  }
}

TEST_CASE("the default mesh keeps area and strong axis within 0.5 %, and loses 1 % of the weak one") {
  for (const std::string& name : shape_names()) {
    CAPTURE(name);
    const CatalogueShape& shape = *find_shape(name);
    const SectionSums s = sums(shape_fibers(shape, {}, {}));
    CHECK(difference(s.area, shape.A) < 0.005);
    CHECK(difference(s.strong, shape.I_strong) < 0.005);
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
  // fillets of r = 12 mm: (1 - pi/4) r^2 at 0.2234 r from web and flange
  CHECK(difference(fibers[48].area, 3.0902e-5) < 1e-4);
  CHECK(fibers[48].y == doctest::Approx(0.058 - 0.2234 * 0.012).epsilon(1e-14));
  CHECK(fibers[48].z == doctest::Approx(0.00275 + 0.2234 * 0.012).epsilon(1e-14));
  CHECK(fibers[51].y == -fibers[48].y);
  CHECK(fibers[51].z == -fibers[48].z);
  CHECK(shape_fibers(*find_shape("HEA140"), {4, 1, 3, false}, {}).size() == 11);
}

TEST_CASE("shapes are found by name whatever the case and the blanks") {
  const CatalogueShape* shape = find_shape("HEA140");
  REQUIRE(shape != nullptr);
  CHECK(shape->h == 0.133);
  CHECK(shape->tf == 0.0085);
  CHECK(difference(shape->J, 8.13e-8) < 1e-15);
  for (const char* name : {"hea140", " HEA 140 ", "Hea\t140", "HE 140 A", "he140a"}) CHECK(find_shape(name) == shape);
  CHECK(find_shape("HEB1000")->h == 1.0);
  CHECK(find_shape("ipe 80")->b == 0.046);
  for (const char* name : {"", "HEA", "HEA141", "HE 140 C", "W14X90", "140"}) CHECK(find_shape(name) == nullptr);
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
    CHECK(difference(std::abs(twice_area) / 2, plain) < 1e-13);
  }
}

TEST_CASE("torsion constants are those of El Darwish and Johnston for the drawn shape") {
  for (const std::string& name : shape_names()) {
    CAPTURE(name);
    const CatalogueShape& s = *find_shape(name);
    const double diameter =
        ((s.r + s.tw / 2) * (s.r + s.tw / 2) + (s.r + s.tf) * (s.r + s.tf) - s.r * s.r) / (2 * s.r + s.tf);
    const double junction = s.tw / s.tf * (0.145 + 0.1 * s.r / s.tf);
    const double J = 2.0 / 3 * (s.b - 0.63 * s.tf) * s.tf * s.tf * s.tf + (s.h - 2 * s.tf) * s.tw * s.tw * s.tw / 3 +
                     2 * junction * std::pow(diameter, 4);
    CHECK(difference(s.J, J) < 0.0035);  // IPE80 is tabulated as 0.70 cm4
  }
}
