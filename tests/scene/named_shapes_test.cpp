// Shapes by the names of AISC: channels, hollow sections and angles, against the tables of the Manual.
#include <doctest/doctest.h>

#include "elements/aisc_names.hpp"
#include "elements/channel.hpp"
#include "scene_text.hpp"

using namespace nsframe;
using test::error;
using test::scene;

namespace {

constexpr double inch = 0.0254, in2 = inch * inch, in4 = in2 * in2;

SectionDescription section(const std::string& name, const std::string& keys = "") {
  return scene("[material.m]\nlaw = \"Elastic\"\nE = \"260 GPa\"\n[section.s]\nmaterial = \"m\"\nshape = \"" + name + "\"\n" + keys)
      .model.sections.front();
}
const FiberSectionDescription& fibers(const SectionDescription& s) { return std::get<FiberSectionDescription>(s.kind); }

}  // namespace

TEST_CASE("hollow sections by name have the area and moments of the Manual, of the design thickness") {
  struct Row {
    const char* name;
    double A, Ix, Iy, J;  // [in2], [in4]
  };
  for (const Row& row : {Row{"HSS6X6X1/4", 5.24, 28.6, 28.6, 45.6}, Row{"HSS6X6X3/8", 7.58, 39.5, 39.5, 64.6},
                         Row{"HSS10X6X1/2", 13.5, 171, 76.8, 176}, Row{"hss 4x4x1/4", 3.37, 7.80, 7.80, 12.8},
                         Row{"HSS8X4X1/4", 5.24, 42.5, 14.4, 35.3}, Row{"HSS20X12X5/8", 35.0, 1880, 851, 1890},
                         Row{"HSS5.000X0.250", 3.49, 9.94, 9.94, 19.9}}) {
    CAPTURE(row.name);
    const SectionDescription s = section(row.name);
    const AreaMoments m = moments(fibers(s).fibers);
    CHECK(m.area / in2 == doctest::Approx(row.A).epsilon(0.005));
    CHECK(m.second(0, 0) / in4 == doctest::Approx(row.Ix).epsilon(0.005));
    CHECK(m.second(1, 1) / in4 == doctest::Approx(row.Iy).epsilon(0.005));
    CHECK(fibers(s).torsion_stiffness / 100e9 / in4 == doctest::Approx(row.J).epsilon(0.02));
    CHECK_FALSE(s.outline.empty());
  }
  CHECK(hollow_dimensions("HSS5-1/2X5-1/2X3/16")->depth == doctest::Approx(5.5 * inch).epsilon(1e-14));
  CHECK(hollow_dimensions("HSS5-1/2X5-1/2X3/16")->thickness == doctest::Approx(0.174 * inch).epsilon(1e-14));
  CHECK(hollow_dimensions("HSS6X6X1/4")->thickness == doctest::Approx(0.233 * inch).epsilon(1e-14));
  for (const char* name : {"HSS", "HSS6", "HSS6X", "HSS6X6X1/0", "HSS6X-6X1", "HSS6X6X6X6", "HSS1-2X2X1", "HSS1E3X2X1", "L4X4"})
    CHECK_FALSE(hollow_dimensions(name));
}

TEST_CASE("angles by name have the area and moments of the Manual") {
  struct Row {
    const char* name;
    double A, Ix, Iy, x, y;  // [in2], [in4], [in]
  };
  for (const Row& row : {Row{"L4X4X1/2", 3.75, 5.52, 5.52, 1.18, 1.18}, Row{"L6X4X1/2", 4.75, 17.3, 6.22, 0.981, 1.98},
                         Row{"L8X8X1", 15.1, 89.1, 89.1, 2.36, 2.36}, Row{"L3X3X1/4", 1.44, 1.23, 1.23, 0.836, 0.836}}) {
    CAPTURE(row.name);
    const SectionDescription s = section(row.name);
    const AreaMoments m = moments(fibers(s).fibers);
    CHECK(m.area / in2 == doctest::Approx(row.A).epsilon(0.01));
    CHECK(m.second(0, 0) / in4 == doctest::Approx(row.Ix).epsilon(0.01));
    CHECK(m.second(1, 1) / in4 == doctest::Approx(row.Iy).epsilon(0.012));
    CHECK(m.centroid.norm() < 1e-15);
    CHECK(-s.outline[0].x() / inch == doctest::Approx(row.y).epsilon(0.012));
    CHECK(-s.outline[0].y() / inch == doctest::Approx(row.x).epsilon(0.012));
  }
  const AreaMoments turned = moments(fibers(section("L6X4X1/2", "principal_axes = true")).fibers);
  CHECK(std::abs(turned.second(0, 1)) < 1e-12 * turned.second(1, 1));
  CHECK(turned.second(1, 1) / in2 / in2 / turned.area * in2 == doctest::Approx(0.864 * 0.864).epsilon(0.02));  // r_z
}

TEST_CASE("channels have the tabulated area and moments exactly, from fibers inside their outline") {
  CHECK(channels().size() == 29);
  for (const ChannelShape& shape : channels()) {
    CAPTURE(shape.name);
    const Fibers all = channel_fibers(shape, {}, {});
    const AreaMoments m = moments(all);
    CHECK(m.area == doctest::Approx(shape.A).epsilon(1e-12));
    CHECK(m.second(0, 0) == doctest::Approx(shape.I_strong).epsilon(1e-11));
    CHECK(m.second(1, 1) == doctest::Approx(shape.I_weak).epsilon(1e-11));
    CHECK(m.centroid.norm() < 1e-12 * shape.h);
    const double weight = std::stod(std::string(shape.name.substr(shape.name.find('X') + 1)));  // [lb/ft], steel of 490 lb/ft3
    CHECK(shape.A / in2 * 490 / 144 == doctest::Approx(weight).epsilon(0.01));
    double drawn = 0;  // the outline's area, without fillets
    const SectionOutline outline = channel_outline(shape);
    for (std::size_t i = 0; i < outline.size(); ++i) {
      const Vector2 &a = outline[i], &b = outline[(i + 1) % outline.size()];
      drawn += (a.x() * b.y() - a.y() * b.x()) / 2;
    }
    CHECK(std::abs(drawn) == doctest::Approx(shape.A).epsilon(0.013));
    for (const FiberDescription& fiber : all) {
      CHECK(fiber.area > 0);
      CHECK(std::abs(fiber.y) < shape.h / 2);
      CHECK(fiber.z + shape.z > 0);
      CHECK(fiber.z + shape.z < shape.b);
    }
  }
  const SectionDescription s = section("c 10x20");
  CHECK(moments(fibers(s).fibers).area / in2 == doctest::Approx(5.87).epsilon(1e-12));
  CHECK(fibers(s).torsion_stiffness / 100e9 / in4 == doctest::Approx(0.368).epsilon(1e-12));
}

TEST_CASE("names of shapes that don't exist are errors with the nearest name") {
  const auto fault = [](const std::string& keys) { return error("[section.s]\nmaterial = \"m\"\n" + keys); };
  CHECK(fault("shape = \"C10X21\"").starts_with("s.toml:3:9: error: shape 'C10X21' is not in the catalogue; did you mean 'C10X2"));
  CHECK(fault("shape = \"HSS6X6\"").starts_with("s.toml:3:9: error: the wall of the pipe"));
  CHECK(fault("shape = \"L4X4X5\"") == "s.toml:3:9: error: the legs of the angle are thicker than long");
  CHECK(fault("shape = \"HEA140\"\nprincipal_axes = true") == "s.toml:4:18: error: principal_axes belongs to angles (L)");
}
