// One test for each kind of error that reading reports; those of the assembled model belong to build_model().
#include <doctest/doctest.h>
#include <fmt/format.h>

#include "base/errors.hpp"
#include "models/model.hpp"
#include "scene/sections/sections.hpp"
#include "scene_text.hpp"

using namespace nsframe;
using test::error;
using test::errors;

TEST_CASE("text that is not TOML is an error at its place") {
  Diagnostics diagnostics;
  CHECK_THROWS_WITH_AS(parse_scene("title = \"a\"\ndt = = 1", "s.toml", {}, {}, diagnostics),
                       "s.toml:2:6: error: Error while parsing value: could not determine value type", InputError);
}

TEST_CASE("a scene that isn't there is an error") {
  Diagnostics diagnostics;
  CHECK_THROWS_WITH_AS(read_scene("/nowhere/s.toml", {}, diagnostics), "/nowhere/s.toml: error: cannot open the scene",
                       InputError);
}

TEST_CASE("a name given twice is an error") {
  Diagnostics diagnostics;
  CHECK_THROWS_AS(parse_scene("[material.a]\nlaw = \"Elastic\"\nE = 1\n[material.a]\n", "s.toml", {}, {}, diagnostics),
                  InputError);
}

TEST_CASE("an unknown key is an error at the key with the nearest known one") {
  CHECK(error("[analysis]\n  thtea = 1") == "s.toml:2:3: error: unknown key 'thtea'; did you mean 'theta'?");
  CHECK(error("titel = \"a\"") == "s.toml:1:1: error: unknown key 'titel'; did you mean 'title'?");
  CHECK(error("[structure.a]\nnode = []\nnodes = []") ==
        "s.toml:2:1: error: unknown key 'node'; did you mean 'nodes'?");
  CHECK(error("[structure.a]\nnodes = []\ndamping = { kin = \"modal\" }") ==
        "s.toml:3:13: error: unknown key 'kin'; did you mean 'kind'?");
}

TEST_CASE("a value outside its range is an error with the range") {
  CHECK(error("[[contact]]\nbetween = [\"a\", \"b\"]\nrestitution = 1.2") ==
        "s.toml:3:15: error: restitution = 1.2, must lie in [0, 1]");
  CHECK(error("[analysis]\ntheta = 0.4") == "s.toml:2:9: error: theta = 0.4, must lie in [0.5, 1]");
  CHECK(error("[analysis]\ndt = 0") == "s.toml:2:6: error: dt = 0, must be positive");
  CHECK(error("[analysis]\ndt = \"-1 ms\"") == "s.toml:2:6: error: dt = \"-1 ms\", must be positive");
  CHECK(error("[structure.a]\nnodes = []\npoints = 11") == "s.toml:3:10: error: points = 11, must lie in [2, 10]");
  CHECK(error("[structure.a]\nnodes = []\nmasses = [[1, \"-1 kg\"]]") ==
        "s.toml:3:15: error: mass = \"-1 kg\", must not be negative");
  CHECK(error("[material.a]\nlaw = \"Steel01\"\nfy = 1\nE = 2\nb = 1") == "s.toml:5:5: error: b = 1, must be below 1");
  CHECK(error("[section.a]\nshape = \"HEA100\"\nmaterial = \"a\"\npoisson = 0.6") ==
        "s.toml:4:11: error: poisson = 0.6, must lie in (-1, 0.5]");
}

TEST_CASE("a quantity of the wrong dimension is an error") {
  CHECK(error("[analysis]\ndt = \"5 cm\"") == "s.toml:2:6: error: dt = \"5 cm\" is a length, must be a time (s)");
  CHECK(error("[analysis]\ntheta = \"1 s\"") == "s.toml:2:9: error: theta = \"1 s\" is a time, must be a plain number");
}

TEST_CASE("an unknown unit is an error") {
  CHECK(error("[analysis]\ndt = \"5 mss\"") ==
        "s.toml:2:6: error: dt = \"5 mss\": unknown unit 'mss'; did you mean 'ms'?");
}

TEST_CASE("numbers that are not finite are errors") {
  CHECK(error("[analysis]\ndt = nan") == "s.toml:2:6: error: dt = nan, must be a finite number");
  CHECK(error("[analysis]\ndt = inf") == "s.toml:2:6: error: dt = inf, must be a finite number");
  CHECK(error("[structure.a]\nnodes = [[1, 0, nan, 0]]") == "s.toml:2:17: error: y = nan, must be a finite number");
}

TEST_CASE("a value of the wrong type is an error") {
  CHECK(error("[analysis]\ndt = true") ==
        "s.toml:2:6: error: dt must be a number or a quantity as \"1 s\", not a boolean");
  CHECK(error("[analysis]\nthreads = 1.5") == "s.toml:2:11: error: threads = 1.5, must be a whole number");
  CHECK(error("[analysis]\nscheme = 1") == "s.toml:2:10: error: scheme must be a text, not a number");
  CHECK(error("[gravity]\nstatically_first = 1") ==
        "s.toml:2:20: error: statically_first must be true or false, not a number");
  CHECK(error("analysis = 1") == "s.toml:1:12: error: analysis must be a table, not a number");
  CHECK(error("material = 1") == "s.toml:1:12: error: material must be a table of tables, not a number");
  CHECK(error("[structure.a]\nnodes = 1") == "s.toml:2:9: error: nodes must be a list of tables or rows, not a number");
  CHECK(error("[structure.a]\nnodes = [1]") ==
        "s.toml:2:10: error: nodes must be a table or a row of values, not a number");
  CHECK(error("[structure.a]\nnodes = [[true, 0, 0, 0]]") ==
        "s.toml:2:11: error: id must be a name or a whole number, not a boolean");
}

TEST_CASE("an unknown choice is an error with the nearest known one") {
  CHECK(error("[structure.a]\nnodes = []\nelement = \"force\"") ==
        "s.toml:3:11: error: element = \"force\" is not known; known: elastic, displacement, force-based");
  CHECK(error("[structure.a]\nmodel = \"storyframe\"") ==
        "s.toml:2:9: error: model = \"storyframe\" is not known; did you mean 'story_frame'?");
  CHECK(error("[material.a]\nlaw = \"Steel2\"") ==
        "s.toml:2:7: error: law = \"Steel2\" is not known; did you mean 'Steel02'?");
  CHECK(error("[structure.a]\nnodes = []\nsupports = { 1 = \"fxed\" }") ==
        "s.toml:3:18: error: fixed = \"fxed\" is not known; did you mean 'fixed'?");
  CHECK(error("[structure.a]\nnodes = []\nsupports = { 1 = [\"ux\", \"uw\"] }") ==
        "s.toml:3:25: error: fixed = \"uw\" is not known; did you mean 'ux'?");
  CHECK(error("[gravity]\ndirection = \"down\"") ==
        "s.toml:2:13: error: direction = \"down\", must be x, -x, y, -y, z, -z or three numbers");
  CHECK(error("[gravity]\ndirection = [0, 0, 0]") == "s.toml:2:13: error: direction has no length");
  CHECK(error("[output]\nhistory = [\"node\"]") ==
        "s.toml:2:11: error: there is no history 'node'; did you mean 'nodes'?");
  CHECK(error("[output]\nhistory = [\"nodes\"]\nfibers = [\"a.1\"]") ==
        "s.toml:3:10: error: to keep fibers, history needs \"fibers\"");
  CHECK(error("[output]\nfloor_spectra = { nodes = [] }") ==
        "s.toml:2:27: error: floor spectra need nodes; \"floors\" stands for all floors");
  CHECK(error("[output]\nfloor_spectra = { damping = 1 }") == "s.toml:2:29: error: damping = 1, must lie in [0, 1)");
  CHECK(error("[output]\nfloor_spectra = { periods = [0.1, 0] }") == "s.toml:2:35: error: periods = 0, must be positive");
  CHECK(error("[output]\nfloor_spectra = [\"floors\", \"a.1\"]").starts_with("s.toml:2:17: error: there is no node 'a.1'"));
}

TEST_CASE("a missing key is an error at its table") {
  CHECK(error("[material.a]\nlaw = \"Steel01\"\nE = 1") == "s.toml:1:11: error: missing key 'fy'");
  CHECK(error("[material.a]\nE = 1") ==
        fmt::format("s.toml:1:11: error: missing key 'law'; known: {}", fmt::join(law_names(), ", ")));
  CHECK(error("[structure.a]\nnodes = [[1, 0, 0]]") == "s.toml:2:10: error: missing key 'z'");
}

TEST_CASE("what a beam says of its sections, integration, mass, releases and loads must fit together") {
  const auto beam = [](const std::string& keys) {
    return error("[structure.a]\nnodes = []\nbeams = [{ id = 1, nodes = [1, 2]," + keys + " }]");
  };
  CHECK(beam("points = 4") == "s.toml:3:10: error: missing key 'section'");
  CHECK(beam("section = \"s\", sections = [\"s\"]") == "s.toml:3:61: error: a beam has either section or sections");
  CHECK(beam("section = \"s\", inner_iteration = true") ==
        "s.toml:3:50: error: unknown key 'inner_iteration'; did you mean 'inner_iterations'?");
  CHECK(beam("section = \"s\", inner_iterations = 20") == "s.toml:3:69: error: inner_iterations must be true or false, not a number");
  CHECK(beam("section = \"s\", integration = \"legendr\"") ==
        "s.toml:3:64: error: there is no integration rule 'legendr'; did you mean 'legendre'?");
  CHECK(beam("section = \"s\", mass = { per_length = 1, density = 2 }") ==
        "s.toml:3:85: error: a mass has either per_length or density");
  CHECK(beam("section = \"s\", mass = { consistent = true }") ==
        "s.toml:3:57: error: a mass needs per_length or density");
  CHECK(beam("section = \"s\", releases = { i = [\"uy\"] }") ==
        "s.toml:3:67: error: an end of a beam can release ux, rx, ry and rz, not a shear force");
  const auto load = [](const std::string& keys) {
    return error("[structure.a]\nnodes = []\nloads = [{ beams = 1, " + keys + " }]");
  };
  CHECK(load("axes = \"local\"") == "s.toml:3:10: error: a load needs uniform or force");
  CHECK(load("uniform = [0, 0, 1], position = 0.5") == "s.toml:3:55: error: a position is that of a force, and there is none");
  CHECK(load("uniform = [0, 0, \"1 kN\"]") == "s.toml:3:40: error: uniform = \"1 kN\" is a force, must be a stiffness (N/m)");
}

TEST_CASE("an empty name is an error") {
  CHECK(error("[structure.a]\nnodes = []\nsupports = { \"\" = \"fixed\" }") ==
        "s.toml:3:14: error: node is empty, must be a name");
  CHECK(error("[section.a]\nshape = \"HEA100\"\nmaterial = \"\"") ==
        "s.toml:3:12: error: material is empty, must be a name");
}

TEST_CASE("a table's name that is none is an error") {
  Diagnostics diagnostics;
  CHECK_THROWS_AS(parse_scene("[=ection.a]\n", "s.toml", {}, {}, diagnostics), InputError);
}

TEST_CASE("a row of too many values is an error") {
  CHECK(error("[structure.a]\nnodes = [[1, 0, 0, 0, 0]]") ==
        "s.toml:2:10: error: a row of nodes has at most 4 values, not 5");
  CHECK(error("[structure.a]\nnodes = []\nmasses = [[1, 2, 3]]") ==
        "s.toml:3:15: error: mass has 2 values, must have 1 or 3");
  CHECK(error("[structure.a]\nnodes = []\nbeams = [{ id = 1, nodes = [1, 2, 3], section = \"c\" }]") ==
        "s.toml:3:28: error: nodes has 3 values, must have 2");
}

TEST_CASE("a material whose parameters contradict each other is an error at the parameter") {
  CHECK(error("[material.a]\nlaw = \"ElasticPP\"\nE = 1\nepsyP = 1e-3\nepsyN = 1e-3") ==
        "s.toml:5:9: error: epsyN = 0.001, must be at most 0");
}

TEST_CASE("an unknown key of laws that share a name is an error") {
  CHECK(error("[material.a]\nlaw = \"Steel01\"\nfy = 1\nE = 2\na9 = 1") ==
        "s.toml:5:1: error: unknown key 'a9'; did you mean 'a1'?");
}

TEST_CASE("sections that can't be made are errors") {
  CHECK(error("[section.a]\nshape = \"HEA105\"\nmaterial = \"m\"") ==
        "s.toml:2:9: error: shape 'HEA105' is not in the catalogue; did you mean 'HEA100'?");
  CHECK(error("[section.a]\nE = 1\nG = 1\npoisson = 0.3\nA = 1\nIz = 1\nIy = 1\nJ = 1") ==
        "s.toml:3:5: error: a section of constants needs either G or poisson");
  CHECK(error("[section.a]\npatches = [{ material = \"m\", y = [0, 1], z = [1, 1] }]\nGJ = 1") ==
        "s.toml:2:11: error: a patch has no area");
  CHECK(error("[section.a]\nfibers = [[0, 0, 1, \"m\"]]") ==
        "s.toml:1:10: error: a fiber section needs either GJ, or G and J, or torsion_law");
  CHECK(error("[section.a]\ndepth = 1") ==
        "s.toml:1:10: error: a section needs one of: " + section_choices());
}

TEST_CASE("a support that names no node is reported once, for its type") {
  Diagnostics diagnostics;
  const Scene scene = parse_scene("[structure.a]\nnodes = [[1, 0, 0, 0]]\nmasses = [[1, 1]]\nmay_move_freely = true\nsupports = [\"1\"]\n", "s.toml", {}, {}, diagnostics);
  CHECK_THROWS_AS(build_model(scene.model, diagnostics), InputError);
  REQUIRE(diagnostics.messages().size() == 1);
  CHECK(diagnostics.messages()[0] == "s.toml:5:13: error: supports must be a table or a row of values, not a text");
}

TEST_CASE("an error in a material or a section is reported once, whatever is built of it") {
  const std::string frame = "[structure.a]\nelement = \"displacement\"\nnodes = [[1, 0, 0, 0], [2, 0, 0, 2]]\n"
                            "supports = { 1 = \"fixed\" }\nmasses = [[2, 100]]\nbeams = [[1, 1, 2, \"c\"]]\n";
  const auto all = [&](const std::string& material, const std::string& section) {
    Diagnostics diagnostics;
    const Scene scene = parse_scene(frame + "[material.m]\nlaw = \"Steel01\"\nfy = 1\n" + material + "[section.c]\nmaterial = \"m\"\n" + section,
                                    "s.toml", {}, {}, diagnostics);
    try {
      build_model(scene.model, diagnostics);
    } catch (const InputError&) {
    }
    std::string text;
    for (const std::string& message : diagnostics.messages()) text += message + "\n";
    return text;
  };
  CHECK(all("b = 0.01\n", "shape = \"HEA100\"") == "s.toml:7:11: error: missing key 'E'\n");
  CHECK(all("E = 1\nb = 0.01\n", "shape = \"HEA101\"") ==
        "s.toml:14:9: error: shape 'HEA101' is not in the catalogue; did you mean 'HEA100'?\n");
  CHECK(all("E = 1\nb = 0.01\n[material.w]\nlaw = \"MinMax\"\nmaterial = \"x\"\nmax = 1\n", "shape = \"HEA100\"") ==
        "s.toml:14:12: error: material 'x' is not defined; known: m, w\n");
}

TEST_CASE("damping that doesn't fit its kind is an error") {
  const std::string head = "[structure.a]\nnodes = []\n";
  CHECK(error(head + "damping = { kind = \"modal\" }") == "s.toml:3:11: error: modal damping needs ratios");
  CHECK(error(head + "damping = { ratios = [0.01] }") == "s.toml:3:22: error: ratios is given, but no kind of damping");
  CHECK(error(head + "damping = { kind = \"rayleigh\", ratios = { L1 = 0.01 } }") ==
        "s.toml:3:41: error: the ratios of rayleigh damping are a list, not names of modes");
  CHECK(error(head + "damping = { kind = \"rayleigh\", frequencies = [1, 1], ratios = 0.01 }") ==
        "s.toml:3:46: error: rayleigh damping needs two different frequencies");
  CHECK(error(head + "damping = { kind = \"rayleigh\", frequencies = [1, 2] }") ==
        "s.toml:3:11: error: rayleigh damping by frequencies needs one ratio, or two");
  CHECK(error(head + "damping = { kind = \"modal\", ratios = { L1 = -0.01 } }") ==
        "s.toml:3:45: error: L1 = -0.01, must not be negative");
}

TEST_CASE("a ratio for no mode is an error") {
  CHECK(error("[structure.a]\nnodes = []\ndamping = { kind = \"modal\", ratios = { L1 = 0.01, X1 = 0.01 } }") ==
        "s.toml:3:51: error: 'X1' is not the name of a mode: L, T, R or V and its number");
}

TEST_CASE("a parametric structure that doesn't name its model is an error") {
  CHECK(error("[structure.a]\nstories = 2\nplan = [3, 2]") ==
        "s.toml:1:12: error: 'stories' needs model = \"story_frame\"; an explicit structure has nodes");
}

TEST_CASE("a frame of more nodes than any memory holds is an error") {
  CHECK(error("[structure.a]\nmodel = \"story_frame\"\nplan = [3, 2]\ncolumns = { section = \"c\" }\n"
              "stories = 999\nbays = [999, 999]") ==
        "s.toml:5:11: error: stories and bays make 1000000000 nodes, at most 1000000 are allowed");
}

TEST_CASE("a node to keep that isn't in the scene is an error") {
  CHECK(error("[structure.left]\nnodes = [[1, 0, 0, 0], [2, 0, 0, 1]]\n[output]\nnodes = [\"left.1\", \"lef.2\"]") ==
        "s.toml:4:9: error: there is no node 'lef.2'; did you mean 'left.2'?");
}

TEST_CASE("keys that do not go with a law of contact are errors at their values") {
  const auto contact = [](const std::string& keys) { return error("[[contact]]\nbetween = [\"a.1\", \"b.1\"]\n" + keys); };
  CHECK(contact("law = \"jankovski\"\nhertz_stiffness = 1") == "s.toml:3:7: error: contact law 'jankovski' is not known; did you mean 'jankowski'?");
  CHECK(contact("law = \"hertz\"") == "s.toml:1:1: error: law 'hertz' needs hertz_stiffness");
  CHECK(contact("law = \"hertz\"\nhertz_stiffness = 1e8\nrestitution = 0.6") == "s.toml:5:15: error: law 'hertz' is elastic: it has no restitution");
  CHECK(contact("stiffness = 1e6") == "s.toml:3:13: error: law 'newton' has no stiffness");
  CHECK(contact("law = \"khatami\"\nhertz_stiffness = 1e8\ndamping_ratio = 0.3\nrestitution = 0.6") ==
        "s.toml:5:17: error: law 'khatami' has either restitution or damping_ratio");
  CHECK(contact("law = \"linear-viscoelastic\"\nstiffness = -1") == "s.toml:4:13: error: stiffness = -1, must be positive");
  CHECK(contact("law = \"hertz-damped\"\nhertz_stiffness = 1e8\nrestitution = 0").find("needs at least 1e-06") != std::string::npos);
  CHECK(contact("law = \"hertz\"\nhertz_stiffness = \"1e8 N/m\"").find("s.toml:4:19: error: ") == 0);
}

TEST_CASE("a contact without two sides is an error") {
  CHECK(error("[[contact]]\nbetween = [\"a\"]") ==
        "s.toml:2:11: error: a contact needs two sides: between = [first, second], or more in a row");
  CHECK(error("[[contact]]\na = \"a.1\"") == "s.toml:2:5: error: a contact needs a and b");
  CHECK(error("[[contact]]\nbetween = [\"ground\", \"a.1\"]") ==
        "s.toml:2:11: error: the ground must be the last side of a contact");
  CHECK(error("[[contact]]\nbetween = [\"a.1\", \"ground\"]") ==
        "s.toml:2:11: error: contact with the ground needs a gap, or a wall");
  CHECK(error("[[contact]]\nkind = \"nodes\"\nbetween = [\"a.1\", \"b\"]\n") ==
        "s.toml:3:11: error: 'b' is not a node, written as \"structure.node\"");
  CHECK(error("[[contact]]\nkind = \"slab-corners\"\nbetween = [\"a\", \"ground\"]\ngap = 1") ==
        "s.toml:2:8: error: contact with the ground is of kind \"nodes\" or \"wall\"");
}

TEST_CASE("a rigid slab without a center is an error") {
  CHECK(error("[structure.a]\nnodes = []\nslabs = [{ id = 1, corners = [1, 2, 3, 4], kind = \"rigid\" }]") ==
        "s.toml:3:51: error: a rigid slab or diaphragm needs a center");
}

TEST_CASE("a story frame with lists of another length than its stories is an error") {
  const std::string head = "[structure.a]\nmodel = \"story_frame\"\nstories = 3\ncolumns = { section = \"c\" }\n";
  CHECK(error(head + "plan = [3, 2]\nheight = [3, 3]") ==
        "s.toml:6:10: error: height has 2 values, must have one, or one for each of the 3 stories");
  CHECK(error(head + "plan = [3, 2]\nslab = { kind = \"links\" }") ==
        "s.toml:6:8: error: slab of links needs a section");
  CHECK(error(head + "plan = [3]") == "s.toml:5:8: error: plan has 1 values, must have 2");
  CHECK(error(head) == "s.toml:1:12: error: missing key 'plan'");
}

TEST_CASE("all errors of a scene are reported at once, in the order of their places") {
  const std::string text =
      "[analysis]\ntheta = 2\ndt = -1\n[material.a]\nlaw = \"Elastic\"\nE = \"1 m\"\n[[contact]]\n";
  CHECK(errors(text).size() == 4);
  Diagnostics diagnostics;
  parse_scene(text, "s.toml", {}, {}, diagnostics);
  CHECK_THROWS_WITH_AS(diagnostics.throw_if_any(),
                       "s.toml:2:9: error: theta = 2, must lie in [0.5, 1]\n"
                       "s.toml:3:6: error: dt = -1, must be positive\n"
                       "s.toml:6:5: error: E = \"1 m\" is a length, must be a stress (Pa)\n"
                       "s.toml:7:1: error: a contact needs two sides: between = [first, second], or more in a row",
                       InputError);
}

TEST_CASE("floor spectra of a scene can be switched off from the command line") {
  constexpr const char* text = "[output]\nfloor_spectra = \"floors\"\n";
  Diagnostics diagnostics;
  CHECK(parse_scene(text, "s.toml", ".", {}, diagnostics).output.floor_spectra);
  CHECK_FALSE(parse_scene(text, "s.toml", ".", {"output.floor_spectra=none"}, diagnostics).output.floor_spectra);
  CHECK(diagnostics.empty());
}
