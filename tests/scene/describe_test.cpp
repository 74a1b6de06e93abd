// What the short and long forms of a scene mean.
#include <doctest/doctest.h>

#include "dump.hpp"
#include "scene_text.hpp"

using namespace nsframe;
using test::dump;
using test::scene;

namespace {

StructureDescription structure(const std::string& keys) {
  return scene("[structure.a]\nnodes = [[1, 0, 0, 0], [2, 0, 0, 1], [3, 1, 0, 1], [4, 1, 1, 1], [5, 0, 1, 1]]\n" + keys)
      .model.structures.front();
}

ContactDescription contact(const std::string& keys) { return scene("[[contact]]\n" + keys).model.contacts.front(); }

}  // namespace

TEST_CASE("supports are fixed, pinned, or the DOFs listed") {
  const auto s = structure("supports = { 1 = \"fixed\", 2 = \"pinned\", 3 = [\"ux\", \"rz\"], 4 = \"uz\" }").supports;
  REQUIRE(s.size() == 4);
  CHECK(s[0].node.name == "1");
  CHECK(s[0].fixed == std::array{true, true, true, true, true, true});
  CHECK(s[1].fixed == std::array{true, true, true, false, false, false});
  CHECK(s[2].fixed == std::array{true, false, false, false, false, true});
  CHECK(s[3].fixed == std::array{false, false, true, false, false, false});
}

TEST_CASE("masses act in all three translations or by direction") {
  const auto rows = structure("masses = [[1, \"2 t\"], [2, 1, 2, 3]]").masses;
  CHECK(rows[0].mass == Vector3(2000, 2000, 2000));
  CHECK(rows[1].mass == Vector3(1, 2, 3));
  CHECK(rows[1].inertia == Vector3::Zero());
  const auto map = structure("masses = { 1 = \"2 t\", 2 = [1, 2, 3], 3 = { mass = 4, inertia = [5, 6, 7] } }").masses;
  CHECK(map[0].mass == rows[0].mass);
  CHECK(map[1].mass == rows[1].mass);
  CHECK(map[2].mass == Vector3(4, 4, 4));
  CHECK(map[2].inertia == Vector3(5, 6, 7));
}

TEST_CASE("beams take what they don't say from the structure") {
  const auto e =
      structure(
          "element = \"force-based\"\npoints = 7\ngeometry = \"p-delta\"\nbeams = [[1, 1, 2, \"c\"],"
          " { id = 2, nodes = [2, 3], section = \"b\", element = \"elastic\", geometry = \"linear\", points = 3 }]")
          .elements;
  REQUIRE(e.size() == 2);
  CHECK(e[0].kind == ElementKind::force_beam);
  CHECK(e[0].points == 7);
  CHECK(e[0].geometry == Geometry::p_delta);
  CHECK(e[0].node_j.name == "2");
  CHECK(e[0].section.at.line == 6);
  CHECK(e[1].kind == ElementKind::elastic_beam);
  CHECK(e[1].points == 3);
  CHECK(e[1].geometry == Geometry::linear);
}

TEST_CASE("integration, mass, releases and sections of a beam are its own or the structure's; elastic beams have no rule") {
  const auto e = structure(
                     "element = \"force-based\"\nintegration = \"legendre\"\nmember_mass = \"90 kg/m\"\n"
                     "beams = [[1, 1, 2, \"c\"], { id = 2, nodes = [2, 3], section = \"b\", element = \"elastic\", mass = 0,"
                     " releases = { i = [\"ry\"], j = [\"rz\", \"rx\"] } }, { id = 3, nodes = [3, 4], sections = [\"a\", \"b\", \"c\"],"
                     " integration = { rule = \"hinge-radau\", hinge_i = \"20 cm\", hinge_j = 0.1 },"
                     " mass = { density = \"7.85 t/m3\", consistent = true } }]")
                     .elements;
  REQUIRE(e.size() == 3);
  CHECK(e[0].integration.rule == "legendre");
  CHECK(e[0].mass.per_length == 90);
  CHECK_FALSE(e[0].mass.consistent);
  CHECK(e[1].integration == Integration{});
  CHECK_FALSE(e[1].mass.any());
  CHECK(e[1].releases.basic == std::array<bool, 6>{false, false, true, true, false, true});
  CHECK(e[2].integration.rule == "hinge-radau");
  CHECK(e[2].integration.hinge_i == 0.2);
  CHECK(e[2].section.name == "b");
  CHECK(test::names(e[2].sections) == "a b c ");
  CHECK(e[2].mass.density == doctest::Approx(7850));
  CHECK(e[2].mass.consistent);
}

TEST_CASE("inner iterations are a beam's own or the structure's, of its force-based beams alone") {
  const auto e = structure(
                     "element = \"force-based\"\ninner_iterations = true\n"
                     "beams = [[1, 1, 2, \"c\"], { id = 2, nodes = [2, 3], section = \"b\", element = \"elastic\" },"
                     " { id = 3, nodes = [3, 4], section = \"c\", inner_iterations = false }]")
                     .elements;
  REQUIRE(e.size() == 3);
  CHECK(e[0].inner_iterations);
  CHECK_FALSE(e[1].inner_iterations);
  CHECK_FALSE(e[2].inner_iterations);
  CHECK_FALSE(structure("element = \"force-based\"\nbeams = [[1, 1, 2, \"c\"]]").elements[0].inner_iterations);
}

TEST_CASE("loads on beams are in global axes unless they say local, a force acts at midspan unless it says where") {
  const auto loads = structure(
                         "loads = [[1, [0, 0, \"-5 kN/m\"]], { beams = [1, 2], axes = \"local\", force = [0, \"-2 kN\", 0] },"
                         " { beams = 2, force = [1, 2, 3], position = 0.25 }]")
                         .loads;
  REQUIRE(loads.size() == 3);
  CHECK(loads[0].uniform == Vector3(0, 0, -5000));
  CHECK_FALSE(loads[0].local);
  CHECK(test::names(loads[1].elements) == "1 2 ");
  CHECK(loads[1].local);
  CHECK(loads[1].force == Vector3(0, -2000, 0));
  CHECK(loads[1].position == 0.5);
  CHECK(loads[2].position == 0.25);
}

TEST_CASE("a rigid slab or diaphragm ties its corners to its center") {
  const auto rigid =
      structure("slabs = [{ id = \"s\", corners = [2, 3, 4], center = 5, nodes = [1], kind = \"rigid\" }]");
  REQUIRE(rigid.constraints.size() == 1);
  CHECK(rigid.constraints[0].kind == ConstraintKind::rigid_body);
  CHECK(rigid.constraints[0].master.name == "5");
  CHECK(test::names(rigid.constraints[0].slaves) == "2 3 4 1 ");
  CHECK(rigid.slabs[0].rigid);
  const auto plane = structure("slabs = [{ id = \"s\", corners = [2, 3, 4], center = 5, kind = \"diaphragm\" }]");
  CHECK(plane.constraints[0].kind == ConstraintKind::diaphragm);
  const auto links = structure("slabs = [{ id = \"s\", corners = [2, 3, 4], center = 5 }]");
  CHECK(links.constraints.empty());
  CHECK_FALSE(links.slabs[0].rigid);
}

TEST_CASE("springs go to the ground or between two nodes, by stiffness, dashpot or law") {
  const auto s = structure(
                     "springs = [{ id = 1, nodes = 1, stiffness = { ux = \"2.11e6 N/m\", rx = \"3 kN m/rad\" } },"
                     " { id = 2, nodes = [2, 3], damping = { uy = 4 }, law = { uz = \"gap\" } }]")
                     .springs;
  CHECK_FALSE(s[0].node_j);
  CHECK(s[0].stiffness == (Vector6() << 2.11e6, 0, 0, 3000, 0, 0).finished());
  CHECK(s[1].node_j->name == "3");
  CHECK(s[1].damping[1] == 4);
  CHECK(s[1].law[2]->name == "gap");
  CHECK_FALSE(s[1].law[0]);
}

TEST_CASE("initial values know their direction") {
  const auto s =
      structure("initial_displacement = [[2, \"ry\", \"90 deg\"]]\ninitial_velocity = [[2, \"uz\", \"3 km/s\"]]");
  CHECK(s.initial_displacements[0].dof == 4);
  CHECK(s.initial_displacements[0].value == doctest::Approx(pi / 2).epsilon(1e-15));
  CHECK(s.initial_velocities[0].dof == 2);
  CHECK(s.initial_velocities[0].value == 3000);
  CHECK(test::error("[structure.a]\nnodes = []\ninitial_displacement = [[2, \"ry\", \"9 cm\"]]") ==
        "s.toml:3:35: error: value = \"9 cm\" is a length, must be an angle (rad)");
}

TEST_CASE("damping is modal by list or name, or Rayleigh by factors or frequencies") {
  const auto list = structure("damping = { kind = \"modal\", ratios = [0.01, \"2 %\"] }").damping;
  CHECK(list.ratios == std::vector<double>{0.01, 0.02});
  const auto named = structure("damping = { kind = \"modal\", ratios = { T1 = 0.01, L1 = 0.02 } }").damping;
  REQUIRE(named.named_ratios.size() == 2);
  CHECK(named.named_ratios[0].first.name == "T1");
  CHECK(named.named_ratios[1].second == 0.02);
  const auto rayleigh =
      structure("damping = { kind = \"rayleigh\", frequencies = [1, 5], ratios = [0.01, 0.02] }").damping;
  CHECK(*rayleigh.frequencies == std::array{1.0, 5.0});
  CHECK(rayleigh.frequency_ratios == std::array{0.01, 0.02});
  const auto factors =
      structure("damping = { kind = \"rayleigh\", mass_factor = 1, stiffness_factor = \"2 ms\" }").damping;
  CHECK_FALSE(factors.frequencies);
  CHECK(factors.stiffness_factor == 0.002);
}

TEST_CASE("the names of a contact's sides tell its kind") {
  CHECK(contact("between = [\"a\", \"b\"]").kind == ContactKind::slab_corners);
  CHECK(contact("between = [\"a.1\", \"b.1\"]").kind == ContactKind::nodes);
  CHECK(contact("between = [\"a.1\", \"ground\"]\ngap = 1").kind == ContactKind::nodes);
  CHECK_FALSE(contact("between = [\"a.1\", \"ground\"]\ngap = 1").b);
  const ContactDescription long_form = contact("kind = \"nodes\"\na = \"a.1\"\nb = \"b.1\"\ndirection = \"-y\"");
  CHECK(long_form.b->name == "b.1");
  CHECK(long_form.direction == -Vector3::UnitY());
}

TEST_CASE("structures in a row meet each the next, and the last of them the ground") {
  const auto row = scene("[[contact]]\nbetween = [\"a\", \"b\", \"c\", \"ground\"]\nwall = [\"12 m\", 0, 0]\nrestitution = 0.3").model.contacts;
  REQUIRE(row.size() == 3);
  CHECK(row[1].a.name + row[1].b->name == "bc");
  CHECK(row[1].kind == ContactKind::slab_corners);
  CHECK(row[2].kind == ContactKind::wall);
  CHECK_FALSE(row[2].b);
  CHECK(*row[2].wall == Vector3(12, 0, 0));
  CHECK(row[2].restitution == 0.3);
  CHECK(test::error("[[contact]]\nbetween = [\"a\", \"ground\", \"b\"]\ngap = 1") ==
        "s.toml:2:11: error: the ground must be the last side of a contact");
  CHECK(test::error("[[contact]]\nbetween = [\"a\", \"b\"]\nwall = [1, 2, 3]") ==
        "s.toml:3:8: error: a wall belongs to a contact with \"ground\"");
  CHECK(test::error("[[contact]]\nkind = \"wall\"\nbetween = [\"a\", \"b\"]") ==
        "s.toml:3:11: error: a wall is between a structure and \"ground\", not 'b'");
}

TEST_CASE("kinds, restitution by pair and the tolerances of a contact are read") {
  const ContactDescription c = contact("kind = \"facing\"\nbetween = [\"a\", \"b\"]\nrestitution = [[0.2, 0.3], [0.4, 0.5]]\n"
                                       "reach = \"2 m\"\ngap_tolerance = \"10 cm\"\nsliding_error = \"3 mm\"");
  CHECK(c.kind == ContactKind::facing);
  CHECK(c.restitutions == std::vector<double>{0.2, 0.3, 0.4, 0.5});
  CHECK(c.reach == 2);
  CHECK(c.gap_tolerance == doctest::Approx(0.1).epsilon(1e-15));
  CHECK(c.sliding_error == doctest::Approx(0.003).epsilon(1e-15));
  CHECK(contact("kind = \"slab-edges\"\nbetween = [\"a\", \"b\"]").kind == ContactKind::slab_edges);
  CHECK(contact("kind = \"slab-columns\"\nbetween = [\"a\", \"b\"]").kind == ContactKind::slab_columns);
}

TEST_CASE("gaps are one for all, one a corner, or one a corner and floor") {
  const std::string sides = "between = [\"a\", \"b\"]\n";
  CHECK(contact(sides).gap.empty());
  CHECK(contact(sides + "gap = \"5 cm\"").gap == std::vector<double>{0.05});
  CHECK(contact(sides + "gap = [\"5 cm\", \"5.5 cm\"]").gap == std::vector<double>{0.05, 0.055});
  CHECK(contact(sides + "gap = [[1, 2], [3, 4]]").gap == std::vector<double>{1, 2, 3, 4});
}

TEST_CASE("gravity acts where its table is, downwards with 9.81 m/s2") {
  CHECK(scene("").model.gravity.acceleration == Vector3::Zero());
  CHECK(scene("[gravity]").model.gravity.acceleration == Vector3(0, 0, -9.81));
  CHECK(scene("[gravity]").model.gravity.statically_first);
}

TEST_CASE("patches are cut into fibers of equal size") {
  const auto s = scene("[section.a]\npatches = [{ material = \"m\", y = [0, 2], z = [0, 1], ny = 2, nz = 1 }]\nGJ = 3")
                     .model.sections.front();
  const auto& fibers = std::get<FiberSectionDescription>(s.kind);
  REQUIRE(fibers.fibers.size() == 2);
  CHECK(fibers.fibers[0].y == 0.5);
  CHECK(fibers.fibers[1].y == 1.5);
  CHECK(fibers.fibers[1].z == 0.5);
  CHECK(fibers.fibers[1].area == 1);
  CHECK(fibers.torsion_stiffness == 3);
  CHECK(s.outline == SectionOutline{{0, 0}, {2, 0}, {2, 1}, {0, 1}});
}

TEST_CASE("a rolled shape has the catalogue's fibers and its torsion constant") {
  const auto s =
      scene("[material.m]\nlaw = \"Elastic\"\nE = \"208 GPa\"\n[section.a]\nshape = \"HEA100\"\nmaterial = \"m\"")
          .model.sections.front();
  const auto& fibers = std::get<FiberSectionDescription>(s.kind);
  CHECK(fibers.fibers.size() == 52);
  CHECK(fibers.torsion_stiffness == doctest::Approx(80e9 * 5.24e-8).epsilon(1e-3));  // J is tabulated by three digits
  CHECK(fibers.fibers[0].material.at.line == 6);
}

TEST_CASE("the scene of the README's sketch is read as it stands") {
  const test::TemporaryFolder directory;
  directory.write("el_centro_1940_ns.at2", "NPTS= 2, DT= .02 SEC\n 0 1\n");
  Diagnostics diagnostics;
  const Scene s = parse_scene(R"(
[material.S235]
law = "Steel02"
fy = "235 MPa"
E = "210 GPa"
b = 0.01
[section.column]
shape = "HEA100"
material = "S235"
[structure.left]
model = "story_frame"
stories = 2
height = "2.5 m"
plan = ["3.2 m", "2.2 m"]
columns = { section = "column", element = "force-based", points = 5 }
floor_mass = "4600 kg"
damping = { kind = "modal", ratios = { L1 = 0.007, L2 = 0.002, T1 = 0.013, T2 = 0.013, R1 = 0.02, R2 = 0.02 } }
[structure.wall]
nodes = [[1, 3.25, 0, 0], [2, 3.25, 0, 2.5]]
supports = { 1 = "fixed" }
beams = [[1, 1, 2, "column"]]
[[contact]]
kind = "slab-corners"
between = ["left", "right"]
gap = ["5 cm", "5.5 cm"]
restitution = 0.6
[motion]
file = "el_centro_1940_ns.at2"
pga = "0.30 g"
direction = "x"
[analysis]
scheme = "moreau-jean"
theta = 1.0
dt = "1 ms"
duration = "20 s"
[output]
frames = "100 Hz"
history = ["nodes", "contacts"]
)",
                              "s.toml", directory.path(), {}, diagnostics);
  CHECK(diagnostics.messages().empty());
  CHECK(s.model.structures.size() == 2);
  CHECK(s.model.structures[0].nodes.size() == 14);
  CHECK(s.model.motions[0].acceleration[1] == doctest::Approx(0.3 * 9.80665).epsilon(1e-15));
  CHECK(s.places.at("analysis.scheme").line == 32);
}

TEST_CASE("of laws that share a name a material is the first that knows its keys") {
  const std::string steel = "[material.a]\nlaw = \"Steel01\"\nfy = 1\nE = 2\n";
  CHECK(std::holds_alternative<Steel01>(scene(steel).model.materials.front().law));
  const UniaxialLaw law = scene(steel + "a1 = 0.1").model.materials.front().law;
  REQUIRE(std::holds_alternative<Steel01Isotropic>(law));
  CHECK(std::get<Steel01Isotropic>(law).a1 == 0.1);
}

TEST_CASE("wrappers hold the laws that they name") {
  const Scene s = scene(R"(
[material.outer]
law = "MinMax"
material = "pair"
max = "2 %"
[material.pair]
law = "Parallel"
materials = ["steel", "steel"]
factors = [0.25, 0.5]
[material.steel]
law = "Elastic"
E = "200 GPa"
[section.box]
patches = [{ material = "outer", y = [-0.1, 0.1], z = [-0.1, 0.1] }]
G = "80 GPa"
J = 1e-4
)");
  REQUIRE(s.model.materials.size() == 3);
  CHECK(initial_tangent(s.model.materials[0].law) == doctest::Approx(150e9));
  CHECK(std::get<MinMax>(s.model.materials[0].law).max == 0.02);
}
