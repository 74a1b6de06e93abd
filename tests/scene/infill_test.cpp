// Infills: the width of their struts, what they become, and a frame that they stiffen on one side only.
#include <doctest/doctest.h>

#include <cmath>

#include "elements/infill.hpp"
#include "scene_text.hpp"

using namespace nsframe;
using test::displaced;
using test::error;
using test::scene;

namespace {

// Two hinged columns and a beam with a panel; the top pushed along x by `force` [kN].
std::string portal(const std::string& infill, double force) {
  return R"(
[section.c]
E = "30 GPa"
G = "12 GPa"
A = 0.09
Iz = 6.75e-4
Iy = 6.75e-4
J = 1e-3
[structure.a]
nodes = [[1, 0, 0, 0], [2, 5, 0, 0], [3, 0, 0, 3], [4, 5, 0, 3]]
supports = { 1 = ["ux", "uy", "uz", "rx", "rz"], 2 = ["ux", "uy", "uz", "rx", "rz"], 3 = ["uy", "rx", "rz"], 4 = ["uy", "rx", "rz"] }
beams = [["l", 1, 3, "c"], ["r", 2, 4, "c"], ["b", 3, 4, "c"]]
masses = { 3 = 1000, 4 = 1000 }
)" + infill + R"(
[[static]]
loads = [["a.3", "ux", ")" + std::to_string(force) + R"( kN"]]
)";
}

double top(const std::string& text) { return displaced(text)[6 * 2]; }

const std::string panel =
    R"(thickness = "20 cm", E = "5 GPa", column_EI = "20.25 MN m2", height = "2.7 m", length = "4.7 m")";

}  // namespace

TEST_CASE("the width of a strut is that of FEMA 356, equation 7-14") {
  // in inches and ksi: t = 8, E = 700, E I = 3600 * 3000, h = 110, L = 180, column 120
  const double t = 8, E = 700, EI = 3600.0 * 3000, h = 110, L = 180, column = 120;
  const double sine = 2 * (h / std::hypot(h, L)) * (L / std::hypot(h, L));  // of twice the angle
  const double lambda = std::sqrt(std::sqrt(E * t * sine / (4 * EI * h)));
  const double a = 0.175 / std::pow(lambda * column, 0.4) * std::sqrt(h * h + L * L);
  constexpr double inch = 0.0254, ksi = 6894757.293168361;
  const InfillPanel p{t * inch, E * ksi, EI * ksi * std::pow(inch, 4), h * inch, L * inch, column * inch};
  CHECK(relative_stiffness(p) == doctest::Approx(lambda * column).epsilon(1e-12));
  CHECK(strut_width(p) / inch == doctest::Approx(a).epsilon(1e-12));
  CHECK(lambda * column == doctest::Approx(3.8).epsilon(0.02));  // by slide rule
  CHECK(a == doctest::Approx(21.6).epsilon(0.01));
}

TEST_CASE("an infill is a truss without tension of that width, elastic or crushing") {
  const Scene s = scene(portal("infills = [{ id = \"w\", nodes = [1, 4], " + panel + " }, { id = \"v\", nodes = [2, 3], fm = \"6 MPa\", " +
                                   panel + " }]", 1));
  const StructureDescription& structure = s.model.structures[0];
  const ElementDescription& strut = structure.elements[3];
  CHECK(strut.kind == ElementKind::truss);
  CHECK(strut.area == doctest::Approx(0.2 * strut_width({0.2, 5e9, 20.25e6, 2.7, 4.7, 3})).epsilon(1e-14));
  const auto law = [&s](const std::string& name) {
    for (const MaterialDescription& m : s.model.materials)
      if (m.name == name) return m.law;
    throw std::out_of_range(name);
  };
  CHECK(std::get<ENT>(law("a.w")).E == 5e9);
  const auto crushing = std::get<Concrete01>(law("a.v"));
  CHECK(crushing.fpc == -6e6);
  CHECK(crushing.fpcu == -1.2e6);
  CHECK(initial_tangent(crushing) == doctest::Approx(5e9).epsilon(1e-14));
  CHECK(crushing.epsU == doctest::Approx(10 * -6e6 / 5e9).epsilon(1e-14));
}

TEST_CASE("an infill stiffens its frame against the push that shortens it, as a brace of the same area does") {
  const std::string infill = "infills = [{ id = \"w\", nodes = [1, 4], " + panel + " }]";
  const double area = 0.2 * strut_width({0.2, 5e9, 20.25e6, 2.7, 4.7, 3});
  const std::string brace = "trusses = [[\"w\", 1, 4, \"m\", " + std::to_string(area) + "]]\n[material.m]\nlaw = \"Elastic\"\nE = \"5 GPa\"";
  const double bare = top(portal("", 100));
  CHECK(bare > 0);
  // the diagonal from 1 up to 4 is stretched by a push along x, pressed by one against it
  CHECK(top(portal(infill, 100)) == doctest::Approx(bare).epsilon(1e-9));
  const double pressed = top(portal(infill, -100));
  CHECK(pressed == doctest::Approx(top(portal(brace, -100))).epsilon(1e-5));  // six digits of the area
  CHECK(-pressed < 0.2 * bare);
}

TEST_CASE("an infill whose strength contradicts its strains is an error") {
  CHECK(error(portal("infills = [{ id = \"w\", nodes = [1, 4], fm = \"6 MPa\", ultimate_strain = 0.001, " + panel + " }]", 1))
            .find("ultimate_strain must lie beyond that of the strength, 2 fm/E") != std::string::npos);
  CHECK(error(portal("infills = [{ id = \"w\", nodes = [1, 4], ultimate_strain = 0.001, " + panel + " }]", 1))
            .find("ultimate_strain belongs to a strength fm") != std::string::npos);
}
