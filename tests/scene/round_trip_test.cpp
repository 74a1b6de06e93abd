#include <doctest/doctest.h>

#include "dump.hpp"
#include "scene_text.hpp"

using namespace nsframe;
using test::difference;
using test::dump;
using test::scene;

namespace {

constexpr const char* examples[] = {"two_story", "two_story_elastic", "bouncing_ball", "pull_back", "plane_frame", "pushover"};

Scene example(const std::string& name) {
  Diagnostics diagnostics;
  Scene out = read_scene(NSFRAME_SOURCE_DIR "/examples/" + name + "/scene.toml", {}, diagnostics);
  diagnostics.throw_if_any();
  return out;
}

Scene reread(const std::string& text, const std::filesystem::path& directory) {
  Diagnostics diagnostics;
  Scene out = parse_scene(text, "written.toml", directory, {}, diagnostics);
  diagnostics.throw_if_any();
  return out;
}

// Every kind of table that a scene may have.
constexpr const char* everything = R"(
title = "quote \" and é"
[material.linear]
law = "Elastic"
E = "210 GPa"
[material.plastic]
law = "ElasticPP"
E = "210 GPa"
epsyP = 1e-3
[material.concrete1]
law = "Concrete01"
fpc = "-30 MPa"
epsc0 = -0.002
fpcu = "-6 MPa"
epsU = -0.006
[material.concrete2]
law = "Concrete02"
fpc = "-30 MPa"
epsc0 = -0.002
fpcu = "-6 MPa"
epsU = -0.006
ft = "2.5 MPa"
[material.concrete4]
law = "Concrete04"
fc = "-30 MPa"
ec = -0.002
ecu = -0.006
Ec = "25 GPa"
fct = "2 MPa"
et = 0.001
[material.pinched]
law = "Hysteretic"
s1p = "200 MPa"
e1p = 0.001
s2p = "260 MPa"
e2p = 0.01
s3p = "210 MPa"
e3p = 0.03
s1n = "-200 MPa"
e1n = -0.001
s2n = "-260 MPa"
e2n = -0.01
pinchX = 0.7
pinchY = 0.3
damage1 = 0.01
[material.smooth]
law = "BoucWen"
alpha = 0.1
ko = "200 GPa"
n = 2
gamma = 1e5
beta = 1e5
[material.deteriorating]
law = "IMKBilin"
Ke = "200 GPa"
dp_pos = 0.01
dpc_pos = 0.02
du_pos = 0.1
Fy_pos = "200 MPa"
FmaxFy_pos = 1.1
FresFy_pos = 0.3
dp_neg = 0.01
dpc_neg = 0.02
du_neg = 0.1
Fy_neg = "200 MPa"
FmaxFy_neg = 1.1
FresFy_neg = 0.3
Lamda_S = 1
Lamda_C = 1
Lamda_K = 0
[material."steel 1"]
law = "Steel01"
fy = "235 MPa"
E = "210 GPa"
[material.hardened]
law = "Steel01"
fy = "235 MPa"
E = "210 GPa"
a3 = 0.02
[material.soft]
law = "Elastic"
E = 2e9
Eneg = 1e9
[material.gap]
law = "ElasticPPGap"
E = 2e9
Fy = -1e6
gap = -0.01
damage = true
[material.rubber]
law = "ENT"
E = 2e9
[material.metal]
law = "Hardening"
E = 2e11
sigmaY = 2e8
H_iso = 1e9
H_kin = 1e9
[material.both]
law = "Parallel"
materials = ["plastic", "shifted"]
factors = [0.5, 1]
[material.shifted]
law = "InitStrain"
material = "metal"
epsInit = 1e-4
[material.stressed]
law = "InitStress"
material = "steel 1"
sigInit = "20 MPa"
[material.chain]
law = "Series"
materials = "soft"
[material.brittle]
law = "MinMax"
material = "both"
max = 0.05
[material.tired]
law = "Fatigue"
material = "brittle"
min = -0.1
[section.shape]
shape = "HEA 140"
material = "steel 1"
web = 4
exact_moments = true
fillets = false
G = "80 GPa"
J = "8.13 cm4"
[section.constants]
E = "30 GPa"
G = "12 GPa"
A = 0.1
Iz = 1e-3
Iy = 1e-4
J = 1e-4
Ay = 0.08
Az = 0.07
depth = 0.3
width = 0.2
[section.fibers]
patches = [{ material = "plastic", y = [-0.1, 0.1], z = ["-5 cm", "5 cm"], ny = 4, nz = 2 }]
fibers = [[0.08, 0, "2 cm2", "linear"], { y = -0.08, z = 0, area = 2e-4, material = "linear" }]
quads = [{ material = "plastic", corners = [[0, 0], [0.1, 0], ["12 cm", 0.1], [0, 0.1]], n_ij = 3 }]
rings = [{ material = "linear", center = [0.1, 0.2], radius = [0, "5 cm"], angle = [0, "90 deg"], rings = 2, sectors = 3 }]
layers = [{ material = "linear", from = [0, 0], to = [0, 1], count = 3, diameter = "20 mm" }]
arcs = [{ material = "linear", radius = 0.1, count = 5, area = "1 cm2" }]
GJ = 1e5
centred = true
[section.tube]
tube = ["200 mm", "100 mm", "8 mm"]
forming = "cold"
material = "plastic"
[section.pipe]
pipe = ["139.7 mm", "5 mm"]
material = "plastic"
poisson = 0.25
[section.angle]
angle = ["150 mm", "100 mm", "10 mm", "12 mm", "4 mm"]
principal_axes = true
material = "plastic"
[section.rectangle]
rectangle = [0.5, 0.4]
core = "plastic"
cover_material = "linear"
cover = "4 cm"
steel = "steel 1"
top = [3, "20 mm"]
sides = { count = 2, area = "2 cm2" }
displaced = true
[section.circle]
circle = 0.5
core = "plastic"
steel = "steel 1"
bar_depth = "5 cm"
bars = [8, "20 mm"]
first_bar = "22.5 deg"
[structure.a]
element = "displacement"
points = 4
geometry = "p-delta"
integration = "legendre"
member_mass = { density = 7850, rotary_inertia = true }
nodes = [[1, 0, 0, 0], ["top", 0, 0, "3 m"], { id = 3, x = 1, y = 0, z = 3 }, [4, 1, 1, 3], [5, 0, 1, 3], [6, 0.5, 0.5, 3], [7, 1, 0, 0]]
supports = { 1 = "fixed", 3 = "pinned", 4 = ["ux", "rz"] }
masses = { top = "1 t", 3 = [1, 2, 3], 4 = { mass = 5, inertia = [0, 0, "7 kg m2"] } }
beams = [
  [1, 1, "top", "shape"],
  { id = "b", nodes = ["top", 3], section = "constants", element = "elastic", geometry = "linear", orientation = [0, 1, 1] },
  { id = 3, nodes = [3, 4], section = "fibers", element = "force-based", points = 7, mass = "20 kg/m" },
  { id = 4, nodes = [3, 5], section = "shape", geometry = "corotational", offset_i = ["20 cm", 0, -0.1], offset_j = [-0.2, 0, 0] },
  { id = "h", nodes = [1, 5], sections = ["shape", "constants", "fibers"], element = "force-based", inner_iterations = true, integration = { rule = "hinge-radau", hinge_i = "30 cm", hinge_j = 0.2 }, releases = { i = ["rx", "ry"], j = ["rz"] }, mass = { per_length = 3, consistent = true } },
  { id = "u", nodes = [4, 5], section = "shape", releases = { i = "ux", j = ["ry", "rz"] }, integration = { rule = "user", positions = [0, 0.4, 1], weights = [0.2, 0.5, 0.3] } },
]
loads = [
  ["b", [0, 0, "-5 kN/m"]],
  [[1, 3], [1, 2, 3]],
  { beams = "h", axes = "local", force = [0, "-2 kN", 0], position = 0.3 },
  { beams = ["u"], uniform = [0, 0, 1], force = [1, 0, 0] },
]
walls = [
  { id = "k", nodes = [1, "top"], direction = "y", length = "2 m", thickness = "20 cm", E = "30 GPa", poisson = 0.15, attached = 5, mass = { density = 2500 } },
  { id = "l", nodes = [7, 3], direction = [1, -1, 0], length = 0.3, section = "constants", element = "force-based", points = 3, geometry = "linear" },
]
trusses = [["t", 1, 3, "linear", "1 cm2"]]
cables = [{ id = "c", nodes = [1, 4], material = "linear", area = 1e-4, pretension = "2 kN", geometry = "linear" }]
springs = [
  { id = "s1", nodes = 1, stiffness = [1, 2, 3, 4, 5, 6] },
  { id = "s2", nodes = [3, 4], stiffness = { ry = "3 kN m/rad" }, damping = { ux = "2 N s/m", rz = 1 }, law = { uz = "linear" } },
  { id = "s3", nodes = 4, stiffness = { ux = 1 }, orient = [[1, 1, 0], [0, 0, 1]] },
]
links = [
  { id = "l1", nodes = [3, 4], stiffness = { ux = 1, uy = 2 }, law = { rz = "linear" }, shear_distance = [0.2, 0.7] },
  { id = "l2", nodes = ["top", 4], damping = { ux = 3 }, in_plane = [0, 0, 1], p_delta = [0.1, 0.2, 0.5, 0.5] },
]
rigid_links = [["top", 5], { master = 3, slaves = [4] }]
diaphragms = [[3, 4, 5], { master = "top", slaves = [3], normal = "x" }, { master = 5, slaves = [4], normal = [1, 2, 3] }]
infills = [
  { id = "w1", nodes = [1, 4], thickness = "20 cm", E = "5 GPa", column_EI = "30 MN m2", height = 2.5, length = 4 },
  { id = "w2", nodes = [2, 3], thickness = "20 cm", E = "5 GPa", column_EI = "30 MN m2", height = 2.5, length = 4, column_height = 3, fm = "6 MPa", residual = 0.1, ultimate_strain = 0.01 },
]
equal_dof = [["top", 3, ["ux", "uy"]], [4, 5, ["rx"]]]
slabs = [
  { id = 1, corners = ["top", 3, 4, 5], center = 6, kind = "diaphragm", thickness = "20 cm" },
  { id = 2, corners = ["top", 3, 4], center = 6, nodes = [5], kind = "rigid", rigid_contact = false },
  { id = 3, corners = ["top", 3, 4] },
]
initial_displacement = [["top", "ux", "-2.4 cm"], ["top", "ry", "1 deg"]]
initial_velocity = [["top", "uy", "1 m/s"]]
damping = { kind = "rayleigh", frequencies = ["1 Hz", "5 Hz"], ratios = "0.5 %" }
[structure.b]
model = "story_frame"
stories = 3
height = ["4 m", 3, 3]
plan = [["3 m", "4 m"], 5]
bays = [1, 2]
origin = [20, 0, 0]
columns = { section = ["shape", "shape", "fibers"], element = "force-based", points = 4, geometry = "p-delta", depth = "y", end_section = "shape", releases = { j = ["rz"] }, rigid_ends = [0, "20 cm"] }
beams = { section = "constants", load = ["10 kN/m", 0, 2], mass = { density = 2500, consistent = true } }
slab = { kind = "diaphragm" }
braces = { planes = ["-x", "+y"], kind = "cable", material = "linear", area = [3e-4, 2e-4, 1e-4], pretension = "1 kN" }
base = "pinned"
floor_mass = ["20 t", "20 t", "15 t"]
centre_share = 0.5
damping = { kind = "modal", ratios = [0.01, 0.02] }
[structure.c]
may_move_freely = true
nodes = [[1, 0, 0, 9]]
damping = { kind = "rayleigh", mass_factor = 0.1, stiffness_factor = "1 ms" }
[[contact]]
between = ["a", "b"]
gap = [["1 cm", "2 cm"], ["3 cm", "4 cm"]]
[[contact]]
name = "floor"
between = ["c.1", "ground"]
direction = "-z"
gap = 9
restitution = 0.3
[[contact]]
kind = "nodes"
a = "a.3"
b = "c.1"
direction = [1, 1, 0]
[[contact]]
between = ["a.3", "c.1"]
law = "jankowski"
hertz_stiffness = 6e7
damping_ratio = 0.4
effective_mass = "2000 kg"
[[contact]]
between = ["a.3", "c.1"]
law = "hertz"
hertz_stiffness = 6e7
[[contact]]
between = ["a.3", "c.1"]
law = "linear-viscoelastic"
stiffness = "5 kN/mm"
[[contact]]
between = ["a.3", "c.1"]
law = "anagnostopoulos"
stiffness_ratio = 0.5
restitution = 0.65
[gravity]
acceleration = "1 g"
direction = [1, 0, -3]
statically_first = false
[analysis]
contact_solver = "gauss-seidel"
projection = true
threads = 2
[output]
nodes = ["a.top", "b.101"]
history = ["nodes", "fibers"]
fibers = ["a.3", "a.3:7"]
floor_spectra = { nodes = ["floors", "a.top"], periods = [0.1, "200 ms"], damping = "2 %" }
)";

}  // namespace

TEST_CASE("a scene written back and read again is the same scene") {
  for (const char* name : examples) {
    CAPTURE(name);
    const Scene first = example(name);
    const Scene second = reread(write_scene(first), first.directory);
    CHECK(difference(dump(first.model), dump(second.model)) == "");
    CHECK(difference(write_scene(first), write_scene(second)) == "");
  }
  const Scene first = scene(everything), second = scene(write_scene(first));
  CHECK(difference(dump(first.model), dump(second.model)) == "");
  CHECK(difference(write_scene(first), write_scene(second)) == "");
}

TEST_CASE("empty lists, empty texts and negative zeros survive writing") {
  const Scene first =
      scene("[structure.a]\nnodes = []\n[structure.b]\nnodes = [[1, -0.0, 0, 0]]\n[analysis]\nscheme = \"\"");
  const Scene second = scene(write_scene(first));
  CHECK(difference(dump(first.model), dump(second.model)) == "");
  CHECK(difference(write_scene(first), write_scene(second)) == "");
  CHECK(second.analysis.scheme.empty());
}

TEST_CASE("a scene expanded to explicit nodes and elements describes the same model") {
  for (const char* name : examples) {
    CAPTURE(name);
    const Scene first = example(name);
    const std::string expanded = write_expanded_scene(first);
    CHECK(expanded.find("story_frame") == std::string::npos);
    CHECK(difference(dump(first.model), dump(reread(expanded, first.directory).model)) == "");
  }
  const Scene first = scene(everything);
  CHECK(difference(dump(first.model), dump(scene(write_expanded_scene(first)).model)) == "");
}

TEST_CASE("a scene written for another directory still finds its records") {
  const Scene first = example("two_story");
  const test::TemporaryFolder directory;
  const Scene second = reread(write_scene(first, directory.path()), directory.path());
  REQUIRE(second.model.motions.size() == 1);
  CHECK(second.model.motions[0].acceleration == first.model.motions[0].acceleration);
}

TEST_CASE("the written scene has every default that was used") {
  const std::string text = write_scene(scene(""));
  for (const char* line : {"theta = 1\n", "gamma = 1.5\n", "dt = 0.001\n", "max_newton = 30\n", "amplification = 1\n"})
    CHECK(text.find(line) != std::string::npos);
}
