// [[static]] tables: short forms, units, files of targets, errors by place, overrides, round trip.
#include <doctest/doctest.h>

#include "dump.hpp"
#include "scene_text.hpp"

using namespace nsframe;
using test::error;
using test::scene;

namespace {

const std::string stage = "[[static]]\n";

const StageDescription only(const std::string& text, const std::vector<std::string>& overrides = {}) {
  const Scene read = scene(text, overrides);
  REQUIRE(read.model.stages.size() == 1);
  return read.model.stages[0];
}

}  // namespace

TEST_CASE("a stage of loads under load control needs nothing else") {
  const StageDescription s = only(stage + "loads = [[\"a.2\", \"ux\", \"1 kN\"], { node = \"a.3\", dof = \"ry\", value = \"2 kN m\" }]");
  CHECK(s.name == "stage 1");
  REQUIRE(s.loads.size() == 2);
  CHECK(s.loads[0].node.name == "a.2");
  CHECK(s.loads[0].value == 1000);
  CHECK(s.loads[1].dof == 4);
  CHECK(s.loads[1].value == 2000);
  CHECK(s.options.control == "load");
  CHECK(s.options.targets == std::vector<double>{1});
  CHECK(s.options.steps == 20);
}

TEST_CASE("targets carry the unit of what is led on") {
  const std::string control = stage + "masses = \"y\"\ncontrol = \"displacement\"\n";
  const StageDescription s = only(control + "at = [\"a.9\", \"uy\"]\nto = [\"5 cm\", \"-5 cm\"]\nstep = \"1 mm\"");
  CHECK(s.masses == Vector3(0, 1, 0));
  CHECK(s.options.targets == std::vector<double>{0.05, -0.05});
  CHECK(s.options.step == doctest::Approx(1e-3));
  CHECK_FALSE(s.options.relative);
  CHECK(only(control + "at = [\"a.9\", \"rz\"]\nby = \"90 deg\"").options.targets[0] == doctest::Approx(pi / 2));
  CHECK(only(control + "at = [\"a.9\", \"rz\"]\nby = 1").options.relative);
  CHECK(error(control + "at = [\"a.9\", \"rz\"]\nto = \"5 cm\"") == "s.toml:5:6: error: to = \"5 cm\" is a length, must be an angle (rad)");
  CHECK(error(stage + "masses = \"y\"\nto = \"5 cm\"") == "s.toml:3:6: error: to = \"5 cm\" is a length, must be a plain number");
}

TEST_CASE("cycles go to and fro, each as often as it says") {
  const StageDescription s = only(stage + "mode = \"a.L1\"\ncontrol = \"displacement\"\nat = [\"a.9\", \"ux\"]\ncycles = [[\"1 cm\", 2], [0.02, 1]]");
  CHECK(s.options.targets == std::vector<double>{0.01, -0.01, 0.01, -0.01, 0.02, -0.02});
  CHECK(s.mode->name == "a.L1");
}

TEST_CASE("a file of targets is read relative to the scene, times its factor, and written for another directory") {
  const test::TemporaryFolder directory;
  directory.write("protocol.txt", "# a protocol\n0.5\n\n -1  # back\n+2e0\n");
  const std::string text = stage + "masses = \"x\"\ncontrol = \"displacement\"\nat = [\"a.9\", \"ux\"]\nfile = \"protocol.txt\"\nfactor = \"1 mm\"";
  Diagnostics diagnostics;
  const Scene read = parse_scene(text, "s.toml", directory.path(), {}, diagnostics);
  diagnostics.throw_if_any();
  const std::vector<double> expected{0.5e-3, -1e-3, 2e-3};
  CHECK(read.model.stages[0].options.targets == expected);
  const test::TemporaryFolder other;
  const Scene second = parse_scene(write_scene(read, other.path()), "t.toml", other.path(), {}, diagnostics);
  diagnostics.throw_if_any();
  CHECK(second.model.stages[0].options.targets == expected);
  directory.write("protocol.txt", "1\n  two\n");
  parse_scene(text, "s.toml", directory.path(), {}, diagnostics);
  REQUIRE(diagnostics.messages().size() == 1);
  CHECK(diagnostics.messages()[0].ends_with("protocol.txt:2:3: error: a line must be one number"));
}

TEST_CASE("stages that contradict themselves are errors at the key") {
  const std::string base = stage + "masses = \"x\"\n", control = base + "control = \"displacement\"\n";
  CHECK(error(stage + "name = \"a\"") == "s.toml:1:1: error: a stage needs loads, masses or a mode");
  CHECK(error(base + "mode = \"a.L1\"") == "s.toml:3:8: error: a stage has either a mode, or loads and masses");
  CHECK(error(stage + "mode = \"L1\"") == "s.toml:2:8: error: 'L1' is not a mode, written as \"structure.L1\"");
  CHECK(error(base + "name = \"a/b\"") == "s.toml:3:8: error: the name of a stage has no '/' and begins with no '.'");
  CHECK(error(control + "to = 1") == "s.toml:3:11: error: this control needs a node and a DOF: at = [\"structure.node\", \"ux\"]");
  CHECK(error(control + "at = [\"a.1\", \"ux\"]") == "s.toml:1:1: error: a stage has one of to, by, cycles and file");
  CHECK(error(base + "to = 1\ncycles = [[1, 1]]") == "s.toml:3:6: error: a stage has one of to, by, cycles and file");
  CHECK(error(base + "by = 1") == "s.toml:3:6: error: control by load goes `to` a load factor");
  CHECK(error(base + "cycles = [[1, 1.5]]") == "s.toml:3:10: error: cycles are rows [amplitude, count] with a whole count, not 1.5");
  CHECK(error(base + "factor = 2") == "s.toml:3:10: error: factor belongs to a file");
  CHECK(error(base + "step = 0.1\nsteps = 3") == "s.toml:4:9: error: a stage has either step or steps");
  CHECK(error(base + "arc = \"spherical\"") == "s.toml:3:7: error: arc belongs to control = \"arc-length\"");
  CHECK(error(base + "max_points = 3") == "s.toml:3:14: error: max_points belongs to control = \"arc-length\"");
  CHECK(error(base + "file = \"nowhere.txt\"") == "s.toml:3:8: error: cannot open 'nowhere.txt'");
  CHECK(error("", {"static.step=1"}) == "--set static.step: error: the scene has no static");
}

TEST_CASE("--set reaches the keys of every stage") {
  const Scene s = scene(stage + "masses = \"x\"\n" + stage + "masses = \"y\"\nsteps = 5", {"static.steps=7", "analysis.algorithm=krylov"});
  REQUIRE(s.model.stages.size() == 2);
  CHECK(s.model.stages[0].options.steps == 7);
  CHECK(s.model.stages[1].options.steps == 7);
  CHECK(s.analysis.algorithm == std::vector<std::string>{"krylov"});
}

TEST_CASE("every key of a stage survives writing") {
  const std::string text = stage + "name = \"push\"\nloads = [[\"a.2\", \"ux\", 1]]\nmasses = [0, 1, 1]\ncontrol = \"arc-length\"\n"
                           "at = [\"a.9\", \"ux\"]\nby = 0.1\nstep = 0.01\narc = \"cylindrical\"\nmax_points = 77\ntolerance = 1e-8\n"
                           "max_iterations = 12\n" + stage + "mode = \"a.T2\"\ncycles = [[2, 3]]\nsteps = 9\n[analysis]\nalgorithm = [\"newton\", \"broyden\"]";
  const Scene first = scene(text), second = scene(write_scene(first));
  CHECK(write_scene(first) == write_scene(second));
  CHECK(test::difference(test::dump(first.model), test::dump(second.model)) == "");
  const StageOptions& options = second.model.stages[0].options;
  CHECK(options.control == "arc-length");
  CHECK(options.arc == ArcKind::cylindrical);
  CHECK(options.max_points == 77);
  CHECK(options.tolerance == 1e-8);
  CHECK(options.max_iterations == 12);
  CHECK(options.relative);
  CHECK(second.model.stages[1].options.targets.size() == 6);
  CHECK(second.model.stages[1].options.steps == 9);
  CHECK(second.analysis.algorithm == std::vector<std::string>{"newton", "broyden"});
}

TEST_CASE("the stiffness of rayleigh damping is read, written, and refused elsewhere") {
  const std::string damped = "[structure.a]\nnodes = []\ndamping = { kind = \"rayleigh\", stiffness_factor = 0.1, stiffness = \"committed\" }";
  const Scene first = scene(damped), second = scene(write_scene(first));
  CHECK(first.model.structures[0].damping.stiffness == DampingStiffness::committed);
  CHECK(second.model.structures[0].damping.stiffness == DampingStiffness::committed);
  CHECK(error("[structure.a]\nnodes = []\ndamping = { kind = \"modal\", ratios = 0.1, stiffness = \"current\" }") ==
        "s.toml:3:55: error: stiffness belongs to rayleigh damping");
}
