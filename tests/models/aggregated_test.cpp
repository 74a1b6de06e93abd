// Sections with laws of torsion and shear beside their fibers: against OpenSees' Aggregator, Timoshenko's beam, errors.
#include <doctest/doctest.h>

#include "integrators/static_analysis.hpp"
#include "tests/support/displacement_control.hpp"
#include "tests/support/reference_data.hpp"
#include "tests/support/small_models.hpp"

using namespace nsframe;
using namespace nsframe::test;

namespace {

// The column of tests/reference/aggregator.py.
ModelDescription aggregated_column(ElementKind kind, bool shear) {
  ModelDescription d;
  d.materials = {{"steel", {}, Steel01{235e6, 210e9, 0.01}},
                 {"y", {}, Steel01{40e3, 5e6, 0.03}},
                 {"z", {}, Steel01{12e3, 2e6, 0.05}},
                 {"twist", {}, Steel01{250, 6566, 0.02}}};
  FiberSectionDescription section;
  for (const auto& row : read_reference("hea140_fibers")) section.fibers.push_back({row[0], row[1], row[2], {"steel", {}}});
  section.torsion = Reference{"twist", {}};
  if (shear) {
    section.shear_y = Reference{"y", {}};
    section.shear_z = Reference{"z", {}};
  }
  d.sections.resize(1);
  d.sections[0].name = "s";
  d.sections[0].kind = section;
  StructureDescription s;
  s.name = "a";
  s.nodes = {node("1", 0, 0, 0), node("2", 0, 0, 2.5)};
  s.supports = {fixed("1")};
  s.elements = {beam("e", "1", "2", "s", kind)};
  d.structures = {s};
  return d;
}

VectorX tip_load(const Model& model, const Vector6& force) {
  VectorX load = VectorX::Zero(model.dofs.full);
  load.segment<6>(full_dof(model, "a.2", 0)) = force;
  return model.dofs.transformation_transposed * load;
}

}  // namespace

TEST_CASE("members with laws of shear and torsion follow OpenSees' section Aggregator") {
  const std::tuple<const char*, ElementKind, bool> cases[] = {{"force", ElementKind::force_beam, true},
                                                              {"torsion_force", ElementKind::force_beam, false},
                                                              {"torsion_disp", ElementKind::displacement_beam, false}};
  for (const auto& [name, kind, shear] : cases) {
    CAPTURE(std::string(name));
    const Model model = build(aggregated_column(kind, shear));
    System system(model, 1);
    State state = virgin_state(system);
    const VectorX pattern = tip_load(model, (Vector6() << 2e3, 0.5e3, 0, 0, 0, 30).finished());
    DisplacementControl control(system, VectorX::Zero(model.dofs.size()), 0, pattern);
    double worst_u = 0, worst_r = 0, worst_factor = 0, peak = 0;
    for (const auto& row : read_reference(std::string("aggregator_") + name)) {
      control.reach(row[0], state);
      worst_u = std::max(worst_u, std::abs(state.displacement[1] - row[1]));
      worst_r = std::max(worst_r, std::abs(state.displacement[5] - row[2]));
      worst_factor = std::max(worst_factor, std::abs(control.factor - row[3]));
      peak = std::max(peak, std::abs(row[3]));
    }
    CHECK(worst_u < 1e-9 * 0.08);
    CHECK(worst_r < 1e-9 * 0.08);
    CHECK(worst_factor < 1e-9 * peak);
  }
}

TEST_CASE("a force-based member with elastic laws of shear is Timoshenko's beam") {
  const double E = 210e9, G = 81e9, A = 3e-3, Iz = 1e-5, Iy = 4e-6, Ay = 8e-4, Az = 1.1e-3;
  ModelDescription elastic = column();
  elastic.sections = {elastic_section("c", {E, G, A, Iz, Iy, 8e-8, Ay, Az})};
  ModelDescription fibers = elastic;
  FiberSectionDescription section;
  const double y = std::sqrt(Iz / A), z = std::sqrt(Iy / A);
  for (const double sy : {-y, y})
    for (const double sz : {-z, z}) section.fibers.push_back({sy, sz, A / 4, {"m", {}}});
  section.torsion_stiffness = G * 8e-8;
  section.shear_y = Reference{"gy", {}};
  section.shear_z = Reference{"gz", {}};
  fibers.materials = {{"m", {}, Elastic{E}}, {"gy", {}, Elastic{G * Ay}}, {"gz", {}, Elastic{G * Az}}};
  fibers.sections[0].kind = section;
  fibers.structures[0].elements[0].kind = ElementKind::force_beam;
  const auto tip = [](const ModelDescription& d) {
    const Model model = build(d);
    System system(model, 1);
    State state = virgin_state(system);
    solve_static(system, tip_load(model, (Vector6() << 9e3, 7e3, -2e4, 300, -500, 90).finished()), StaticOptions{}, state);
    return state.displacement;
  };
  const VectorX expected = tip(elastic);
  CHECK((tip(fibers) - expected).norm() < 1e-9 * expected.norm());
  // the same with the elastic beam of the fiber section: its constants come from the laws
  fibers.structures[0].elements[0].kind = ElementKind::elastic_beam;
  CHECK((tip(fibers) - expected).norm() < 1e-9 * expected.norm());
}

TEST_CASE("laws of shear and torsion that are missing or have no stiffness are errors, shear in displacement-based members too") {
  ModelDescription d = aggregated_column(ElementKind::force_beam, true);
  auto& section = std::get<FiberSectionDescription>(d.sections[0].kind);
  section.torsion = Reference{"twitst", at(4)};
  CHECK(error_of(d) == "s.toml:4:3: error: material 'twitst' is not defined; did you mean 'twist'?");
  section.torsion = Reference{"twist", {}};
  section.shear_y = Reference{"dashpot", at(5)};
  d.materials.push_back({"dashpot", {}, Viscous{1e3, 1}});
  CHECK(error_of(d) == "s.toml:5:3: error: section 's': material 'dashpot' has no stiffness at rest, which torsion and shear need");
  section.shear_y.reset();
  d.structures[0].elements[0].kind = ElementKind::displacement_beam;
  CHECK(error_of(d).find("section 's' deforms in shear") != std::string::npos);
}

TEST_CASE("sections tell the shear forces, torsion and strains of the laws beside their fibers") {
  const Model model = build(aggregated_column(ElementKind::force_beam, true));
  System system(model, 1);
  State state = virgin_state(system);
  solve_static(system, tip_load(model, (Vector6() << 900, 400, 0, 0, 0, 30).finished()), StaticOptions{}, state);
  const std::vector<SectionResult> sections = model.groups[0]->sections(0, model.dofs.expand(state.displacement), state.history.data());
  REQUIRE(sections.size() > 2);
  const Vector3 slope = (sections.back().force - sections.front().force) / 2.5;
  for (const SectionResult& section : sections) {
    REQUIRE(section.with_shear);
    CHECK(section.shear_force.head<2>().norm() == doctest::Approx(std::hypot(900, 400)).epsilon(1e-9));
    CHECK(section.shear_force[0] == doctest::Approx(slope[1]).epsilon(1e-9));
    CHECK(section.shear_force[1] == doctest::Approx(slope[2]).epsilon(1e-9));
    CHECK(std::abs(section.shear_force[2]) == doctest::Approx(30).epsilon(1e-9));
    CHECK(section.shear_deformation[0] == doctest::Approx(section.shear_force[0] / 5e6).epsilon(1e-9));
    CHECK(section.shear_deformation[1] == doctest::Approx(section.shear_force[1] / 2e6).epsilon(1e-9));
    CHECK(section.shear_deformation[2] == doctest::Approx(section.shear_force[2] / 6566).epsilon(1e-9));
  }
  const Model torsion = build(aggregated_column(ElementKind::displacement_beam, false));
  System other(torsion, 1);
  const State rest = virgin_state(other);
  for (const SectionResult& section : torsion.groups[0]->sections(0, VectorX::Zero(12), rest.history.data())) CHECK_FALSE(section.with_shear);
}
