// Sections built from every fiber block, bent by OpenSees and by nsframe (tests/reference/README.md).
#include <doctest/doctest.h>

#include "elements/section_analysis.hpp"
#include "models/build_elements.hpp"
#include "scene/scene.hpp"
#include "tests/support/reference_data.hpp"

using namespace nsframe;

namespace {

constexpr const char* blocks = R"(
[material.bent]
law = "Steel02"
fy = "355 MPa"
E = "205 GPa"
b = 0.02
R0 = 18.5
[material.sharp]
law = "Steel01"
fy = "235 MPa"
E = "210 GPa"
b = 0.01
[material.plastic]
law = "ElasticPP"
E = "30 GPa"
epsyP = 1e-3
[section.s]
GJ = 1e6
centred = true
quads = [{ material = "bent", corners = [[-0.20, -0.15], [0.18, -0.10], [0.22, 0.12], [-0.16, 0.15]], n_ij = 4, n_jk = 3 }]
patches = [{ material = "plastic", y = [0.20, 0.28], z = [-0.15, 0.15], ny = 3, nz = 5 }]
rings = [{ material = "sharp", center = [-0.05, 0.02], radius = [0.03, 0.08], angle = ["30 deg", "210 deg"], sectors = 5, rings = 2 }]
layers = [
  { material = "bent", count = 3, area = 3.14e-4, from = [-0.15, -0.10], to = [-0.15, 0.10] },
  { material = "bent", count = 1, area = 2e-4, from = [0.10, -0.05], to = [0.10, 0.09] },
]
arcs = [
  { material = "sharp", count = 8, area = 2.01e-4, center = [0.02, -0.01], radius = 0.09 },
  { material = "sharp", count = 4, area = 1.13e-4, radius = 0.12, angle = ["-45 deg", "60 deg"] },
]
fibers = [[0.05, -0.12, 5e-4, "plastic"]]
)";

AnalysedSection read_section(const std::string& text) {
  Diagnostics diagnostics;
  const Scene scene = parse_scene(text, "s.toml", {}, {}, diagnostics);
  const Library library = build_library(scene.model, diagnostics);
  diagnostics.throw_if_any();
  return analysed_section("s", std::get<FiberSectionDescription>(scene.model.sections.front().kind), library.materials);
}

// Largest difference of the moments, over the largest moment, and of the axial strains, over the largest strain.
struct Differences {
  double moment = 0, across = 0, strain = 0;
};

Differences differences(const MomentCurvature& curve, const test::Table& reference, bool about_y) {
  double moment = 0, strain = 0;
  for (const auto& row : reference) {
    moment = std::max(moment, std::abs(row[1]));
    strain = std::max(strain, std::abs(row[2]));
  }
  Differences out;
  REQUIRE(curve.states.size() == reference.size());
  for (std::size_t i = 0; i < reference.size(); ++i) {
    const BendingState& s = curve.states[i];
    CHECK(s.curvature == doctest::Approx(reference[i][0]).epsilon(1e-11).scale(0.01));
    out.moment = std::max(out.moment, std::abs(s.moment - reference[i][1]) / moment);
    out.across = std::max(out.across, std::abs(s.force[about_y ? 1 : 2] - reference[i][4]) / moment);
    out.strain = std::max(out.strain, std::abs(s.deformation[0] - reference[i][2]) / strain);
  }
  return out;
}

}  // namespace

TEST_CASE("a section of every fiber block bends as in OpenSees, about both axes, forth and back") {
  const AnalysedSection section = read_section(blocks);
  CHECK(section.fibers.fibers == 12 + 15 + 10 + 3 + 1 + 8 + 4 + 1);
  const auto about_z = differences(moment_curvature(section, {-300e3, 0, {0.05, -0.05, 0}, 25, false}),
                                   test::read_reference("section_blocks_z"), false);
  const auto about_y = differences(moment_curvature(section, {-300e3, pi / 2, {0.05}, 25, false}),
                                   test::read_reference("section_blocks_y"), true);
  // OpenSees' own tolerance is 1e-6 N; twelve digits are kept
  for (const Differences& d : {about_z, about_y}) {
    CHECK(d.moment < 1e-9);
    CHECK(d.across < 1e-9);
    CHECK(d.strain < 1e-9);
  }
}
