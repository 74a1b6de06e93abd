// Kinds of sections: what their keys mean, against tables of producers and closed forms.
#include <doctest/doctest.h>

#include <cmath>

#include "elements/catalogue.hpp"
#include "elements/fiber_cutting.hpp"
#include "elements/torsion.hpp"
#include "scene_text.hpp"

using namespace nsframe;
using test::error;
using test::scene;

namespace {

constexpr const char* materials =
    "[material.m]\nlaw = \"Elastic\"\nE = \"260 GPa\"\n[material.c]\nlaw = \"Elastic\"\nE = \"24 GPa\"\n"
    "[material.u]\nlaw = \"Elastic\"\nE = \"20 GPa\"\n";

SectionDescription section(const std::string& keys) {
  return scene(std::string(materials) + "[section.s]\n" + keys).model.sections.front();
}
const FiberSectionDescription& fibers(const SectionDescription& s) { return std::get<FiberSectionDescription>(s.kind); }
FiberSectionDescription fibers(const std::string& keys) { return fibers(section(keys)); }

double torsion_constant(const FiberSectionDescription& s) { return s.torsion_stiffness / 100e9; }  // E/(2 (1 + 0.3))

// A tabulated value has three digits, or four.
bool tabulated(double value, double table, int digits = 3) {
  const double last = std::pow(10, std::floor(std::log10(table) + 1e-9) - digits + 1);
  return std::abs(value - table) <= 0.51 * last;
}

}  // namespace

TEST_CASE("square and rectangular tubes have the areas and moments of EN 10210 and EN 10219") {
  struct Row {
    const char* keys;
    double A, Iz, Iy, J;  // [cm2], [cm4]
  };
  for (const Row& row : {Row{"tube = [\"100 mm\", \"100 mm\", \"5 mm\"]", 18.7, 279, 279, 439},
                         Row{"tube = [\"200 mm\", \"100 mm\", \"8 mm\"]", 44.8, 2234, 739, 1804},
                         Row{"tube = [\"300 mm\", \"200 mm\", \"10 mm\"]", 94.9, 11819, 6278, 12908},
                         Row{"tube = [\"100 mm\", \"100 mm\", \"5 mm\"]\nforming = \"cold\"", 18.4, 271, 271, 441},
                         Row{"tube = [\"200 mm\", \"100 mm\", \"8 mm\"]\nforming = \"cold\"", 43.2, 2091, 705, 1811}}) {
    CAPTURE(row.keys);
    const auto s = fibers(std::string(row.keys) + "\nmaterial = \"m\"");
    const AreaMoments m = moments(s.fibers);
    CHECK(tabulated(1e4 * m.area, row.A));
    CHECK(tabulated(1e8 * m.second(0, 0), row.Iz));
    CHECK(tabulated(1e8 * m.second(1, 1), row.Iy));
    CHECK(tabulated(1e8 * torsion_constant(s), row.J));
    CHECK(m.centroid.norm() < 1e-15);
    CHECK(std::abs(m.second(0, 1)) < 1e-14 * m.second(1, 1));
  }
}

TEST_CASE("tubes have the areas and moments of AISC's HSS, of the design thickness") {
  struct Row {
    const char* dimensions;
    double A, Ix, Iy, J;  // [in2], [in4]
  };
  const double in2 = 0.0254 * 0.0254, in4 = in2 * in2;
  for (const Row& row : {Row{"[\"6 in\", \"6 in\", \"0.349 in\"]", 7.58, 39.5, 39.5, 64.6},
                         Row{"[\"10 in\", \"6 in\", \"0.465 in\"]", 13.5, 171, 76.8, 176},
                         Row{"[\"20 in\", \"12 in\", \"0.581 in\"]", 35.0, 1880, 851, 1890}}) {
    CAPTURE(row.dimensions);
    const auto s = fibers("tube = " + std::string(row.dimensions) + "\nforming = \"hss\"\nmaterial = \"m\"");
    const AreaMoments m = moments(s.fibers);
    // the thickness has three digits
    CHECK(m.area / in2 == doctest::Approx(row.A).epsilon(0.004));
    CHECK(m.second(0, 0) / in4 == doctest::Approx(row.Ix).epsilon(0.004));
    CHECK(m.second(1, 1) / in4 == doctest::Approx(row.Iy).epsilon(0.004));
    CHECK(torsion_constant(s) / in4 == doctest::Approx(row.J).epsilon(0.02));  // AISC leaves out the wall's own part
  }
}

TEST_CASE("a tube's fibers lie in its walls") {
  for (const char* radius : {"0", "\"8 mm\"", "\"12 mm\"", "\"50 mm\""}) {
    CAPTURE(radius);
    const auto s = section(std::string("tube = { depth = \"200 mm\", width = \"100 mm\", thickness = \"8 mm\", radius = ") +
                           radius + " }\nmaterial = \"m\"");
    double plastic = 0;
    for (const FiberDescription& f : fibers(s).fibers) {
      const bool in_flange = std::abs(f.y) > 0.0915 && std::abs(f.y) < 0.1, in_web = std::abs(f.z) > 0.0415 && std::abs(f.z) < 0.05;
      const double corner = std::hypot(std::max(std::abs(f.y) - 0.05, 0.0), std::max(std::abs(f.z), 0.0));
      if (std::string(radius) == "\"50 mm\"")
        CHECK((in_web || (corner > 0.0415 && corner < 0.05)));
      else
        CHECK((in_flange || in_web || std::hypot(f.y, f.z) > 0.09));
      plastic += f.area * std::abs(f.y);
    }
    if (std::string(radius) == "0") CHECK(plastic == doctest::Approx((0.1 * 0.04 - 0.084 * 0.184 * 0.184) / 4).epsilon(1e-3));
    CHECK(s.outline.size() == (std::string(radius) == "0" ? 4 : 16));
  }
}

TEST_CASE("pipes have the areas and moments of EN 10210 and AISC, bars those of a circle") {
  const auto chs = fibers("pipe = [\"139.7 mm\", \"5 mm\"]\nmaterial = \"m\"");
  CHECK(tabulated(1e4 * moments(chs.fibers).area, 21.2));
  CHECK(tabulated(1e8 * moments(chs.fibers).second(0, 0), 481));
  CHECK(tabulated(1e8 * torsion_constant(chs), 961));
  const auto large = fibers("pipe = [\"323.9 mm\", \"10 mm\"]\nmaterial = \"m\"");
  CHECK(tabulated(1e4 * moments(large.fibers).area, 98.6));
  CHECK(tabulated(1e8 * moments(large.fibers).second(1, 1), 12158, 5));
  const auto bar = fibers("pipe = [\"20 mm\", \"10 mm\"]\nmaterial = \"m\"\nsectors = 3\nrings = 1");
  CHECK(moments(bar.fibers).area == doctest::Approx(pi * 1e-4).epsilon(1e-14));
  CHECK(moments(bar.fibers).second(0, 0) == doctest::Approx(pi / 4 * 1e-8).epsilon(1e-13));
  CHECK(std::abs(moments(bar.fibers).second(0, 1)) < 1e-24);
  // the plastic modulus (D^3 - d^3)/6 to that of the sectors
  double plastic = 0;
  for (const FiberDescription& f : chs.fibers) plastic += f.area * std::abs(f.y);
  CHECK(plastic == doctest::Approx((std::pow(0.1397, 3) - std::pow(0.1297, 3)) / 6).epsilon(0.005));
}

TEST_CASE("angles have the areas and moments of EN 10056, turned to the principal axes if asked") {
  const std::string l100 = "angle = { depth = \"100 mm\", width = \"100 mm\", thickness = \"10 mm\", root = \"12 mm\" }\n";
  const auto plain = fibers(l100 + "material = \"m\"");
  const AreaMoments m = moments(plain.fibers);
  CHECK(tabulated(1e4 * m.area, 19.2));
  CHECK(tabulated(1e8 * m.second(0, 0), 177));
  CHECK(m.second(0, 0) == doctest::Approx(m.second(1, 1)).epsilon(1e-13));
  CHECK(m.centroid.norm() < 1e-15);
  const AreaMoments turned = moments(fibers(l100 + "material = \"m\"\nprincipal_axes = true").fibers);
  CHECK(tabulated(1e8 * turned.second(0, 0), 280));
  CHECK(tabulated(1e8 * turned.second(1, 1), 73.0));
  CHECK(std::abs(turned.second(0, 1)) < 1e-13 * turned.second(1, 1));
  // L 150 x 100 x 10: cy = 4.81 cm, cz = 2.34 cm from the heel; principal axes at tan = 0.438
  const auto unequal = section(
      "angle = { depth = \"150 mm\", width = \"100 mm\", thickness = \"10 mm\", root = \"12 mm\" }\nmaterial = \"m\"");
  const AreaMoments u = moments(fibers(unequal).fibers);
  CHECK(tabulated(1e4 * u.area, 24.2));
  CHECK(tabulated(1e8 * u.second(0, 0), 553));
  CHECK(tabulated(1e8 * u.second(1, 1), 198));
  CHECK(tabulated(-100 * unequal.outline[0].x(), 4.81));
  CHECK(tabulated(-100 * unequal.outline[0].y(), 2.34));
  CHECK(tabulated(std::tan(0.5 * std::atan2(-2 * u.second(0, 1), u.second(0, 0) - u.second(1, 1))), 0.438));
  // AISC L8X8X1
  const auto l8 = fibers("angle = [\"8 in\", \"8 in\", \"1 in\", \"0.62 in\", 0]\nmaterial = \"m\"");
  CHECK(torsion_constant(l8) / std::pow(0.0254, 4) == doctest::Approx(5.08).epsilon(0.04));
}

TEST_CASE("reinforced concrete has core, cover and bars where its keys say") {
  const auto s = section(
      "rectangle = [\"50 cm\", \"40 cm\"]\ncore = \"c\"\ncover_material = \"u\"\ncover = \"4 cm\"\nsteel = \"m\"\n"
      "top = [3, \"16 mm\"]\nbottom = { count = 4, area = \"3 cm2\" }\nsides = [2, \"12 mm\"]\nny = 6\nnz = 5\ncover_layers = 1");
  const auto& all = fibers(s).fibers;
  REQUIRE(all.size() == 30 + 2 * 5 + 2 * 6 + 3 + 4 + 4);
  double core = 0, cover = 0, steel = 0;
  for (const FiberDescription& f : all)
    (f.material.name == "c" ? core : f.material.name == "u" ? cover : steel) += f.area;
  CHECK(core == doctest::Approx(0.42 * 0.32).epsilon(1e-13));
  CHECK(core + cover == doctest::Approx(0.2).epsilon(1e-13));
  CHECK(steel == doctest::Approx(12e-4 + pi / 4 * (3 * 2.56e-4 + 4 * 1.44e-4)).epsilon(1e-13));
  const auto bar = [&](std::size_t i) { return Vector2(all[52 + i].y, all[52 + i].z); };
  CHECK((bar(0) - Vector2(0.21, -0.16)).norm() < 1e-15);
  CHECK((bar(1) - Vector2(0.21, 0)).norm() < 1e-15);
  CHECK((bar(6) - Vector2(-0.21, 0.16)).norm() < 1e-15);
  CHECK((bar(7) - Vector2(-0.07, -0.16)).norm() < 1e-15);
  CHECK((bar(10) - Vector2(0.07, 0.16)).norm() < 1e-15);
  CHECK(fibers(s).torsion_stiffness == doctest::Approx(10e9 * rectangle_torsion(0.5, 0.4)).epsilon(1e-14));
  CHECK(s.outline.size() == 4);
}

TEST_CASE("displaced concrete is taken out under each bar") {
  const std::string keys = "rectangle = [0.5, 0.4]\ncore = \"c\"\nsteel = \"m\"\nbar_depth = 0.05\ntop = [2, 0.02]\n";
  const auto with = fibers(keys), without = fibers(keys + "displaced = true");
  REQUIRE(without.fibers.size() == with.fibers.size() + 2);
  CHECK(without.fibers.back().displaced);
  CHECK(without.fibers.back().material.name == "c");
  CHECK(moments(without.fibers).area == doctest::Approx(0.2).epsilon(1e-14));
  // bars outside the core displace the cover
  const auto outside = fibers(keys + "cover = 0.06\ncover_material = \"u\"\ndisplaced = true");
  CHECK(outside.fibers.back().material.name == "u");
}

TEST_CASE("a circular column has its bars around, and a hole if it is hollow") {
  const std::string keys =
      "circle = \"60 cm\"\ncore = \"c\"\ncover_material = \"u\"\ncover = \"5 cm\"\nsteel = \"m\"\nbars = [8, \"20 mm\"]\n";
  const auto s = fibers(keys + "sectors = 12\nrings = 4\ncover_layers = 1");
  REQUIRE(s.fibers.size() == 12 * 5 + 8);
  CHECK(moments(s.fibers).area == doctest::Approx(pi * 0.09 + 8 * pi * 1e-4).epsilon(1e-13));
  CHECK((Vector2(s.fibers[62].y, s.fibers[62].z) - Vector2(0, 0.25)).norm() < 1e-15);
  const auto hollow = fibers(keys + "hole = \"20 cm\"\nfirst_bar = \"90 deg\"");
  CHECK(moments(hollow.fibers).area == doctest::Approx(pi * 0.08 + 8 * pi * 1e-4).epsilon(1e-13));
  CHECK(hollow.torsion_stiffness == doctest::Approx(10e9 * pi / 2 * (0.0081 - 0.0001)).epsilon(1e-13));
  CHECK(std::abs(hollow.fibers[hollow.fibers.size() - 8].y) < 1e-15);
}

TEST_CASE("fibers keep their coordinates, or take axes through the centroid of their areas") {
  const std::string keys = "patches = [{ material = \"m\", y = [0, 1], z = [0, 2], ny = 2 }]\nfibers = [[3, 1, 2, \"c\"]]\nGJ = 1\n";
  CHECK(moments(fibers(keys).fibers).centroid == Vector2(1.75, 1));
  const auto centred = section(keys + "centred = true");
  CHECK(moments(fibers(centred).fibers).centroid.norm() < 1e-15);
  CHECK(fibers(centred).fibers.back().y == 1.25);
  CHECK(centred.outline.front() == Vector2(-1.75, -1));
}

TEST_CASE("exact moments are an option of rolled shapes") {
  const std::string keys = "shape = \"HEA140\"\nmaterial = \"m\"\n";
  const AreaMoments drawn = shape_moments(*find_shape("HEA140"), true);
  CHECK(moments(fibers(keys + "exact_moments = true").fibers).second(1, 1) ==
        doctest::Approx(drawn.second(1, 1)).epsilon(1e-13));
  CHECK(moments(fibers(keys).fibers).second(1, 1) == doctest::Approx(0.989 * drawn.second(1, 1)).epsilon(1e-3));
}

TEST_CASE("sections whose dimensions contradict each other are errors") {
  const auto fault = [](const std::string& keys) { return error("[section.s]\nmaterial = \"m\"\n" + keys); };
  CHECK(fault("tube = [0.1, 0.1, 0.05]") == "s.toml:3:8: error: the walls of the tube are thicker than half of it");
  CHECK(fault("tube = [0.1, 0.1, 0.03]") ==
        "s.toml:3:8: error: the walls of the tube are too thick for its inner corners");
  CHECK(fault("tube = [0.1, 0.1, 0.01, 0.005]") ==
        "s.toml:3:8: error: the tube's outer corner radius must be 0, or lie between its thickness and half its width");
  CHECK(fault("pipe = [0.1, 0.06]") == "s.toml:3:8: error: the wall of the pipe is thicker than half its diameter");
  CHECK(fault("angle = [0.1, 0.1, 0.1]") == "s.toml:3:9: error: the legs of the angle are thicker than long");
  CHECK(fault("angle = [0.1, 0.1, 0.01, 0.1]") == "s.toml:3:9: error: the angle's root radius exceeds its legs");
  CHECK(fault("angle = [0.1, 0.1, 0.01, 0.05]") == "s.toml:3:9: error: the angle's toe radius exceeds its thickness");
  const auto concrete = [](const std::string& keys) {
    return error("[section.s]\ncore = \"c\"\nsteel = \"m\"\n" + keys);
  };
  const std::string bars = "\ntop = [2, 0.02]";
  CHECK(concrete("rectangle = [1, 1]\ncover = 0.5\nbar_depth = 0.1" + bars) == "s.toml:5:9: error: the cover leaves no core");
  CHECK(concrete("rectangle = [1, 1]" + bars) == "s.toml:1:10: error: bars need a bar_depth or a cover");
  CHECK(concrete("rectangle = [1, 1]\nbar_depth = 0.6" + bars) ==
        "s.toml:5:13: error: the bars lie beyond the middle of the section");
  CHECK(concrete("rectangle = [1, 1]\ncover = 0.1") ==
        "s.toml:4:13: error: a reinforced-concrete section needs bars: top, bottom or sides");
  CHECK(concrete("rectangle = [1, 1]\ncover_material = \"u\"\nbar_depth = 0.1" + bars) ==
        "s.toml:5:18: error: cover_material is given, but no cover");
  CHECK(concrete("circle = 1\ncover = 0.1\nbars = [6, 0.02]\nhole = 0.8") ==
        "s.toml:7:8: error: the hole reaches the cover or the bars");
  CHECK(concrete("circle = 1\ncover = 0.1\nbars = { count = 6 }") ==
        "s.toml:6:8: error: bars need either a diameter or an area");
  const auto block = [](const std::string& keys) { return error("[section.s]\nGJ = 1\n" + keys); };
  CHECK(block("quads = [{ material = \"m\", corners = [[0, 0], [1, 1], [1, 0], [0, 1]] }]") ==
        "s.toml:3:38: error: corners must go around a convex area");
  CHECK(block("rings = [{ material = \"m\", radius = [1, 1], sectors = 4 }]") ==
        "s.toml:3:37: error: the outer radius must exceed the inner one");
  CHECK(block("rings = [{ material = \"m\", radius = [0, 1], sectors = 4, angle = [0, \"400 deg\"] }]") ==
        "s.toml:3:66: error: angle must rise, by a full circle at most");
  CHECK(block("arcs = [{ material = \"m\", radius = 1, count = 4 }]") ==
        "s.toml:3:9: error: bars need either a diameter or an area");
}
