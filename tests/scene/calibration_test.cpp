// Numbers of a scene by their keys, and what [calibration] accepts.
#include <doctest/doctest.h>

#include "base/errors.hpp"
#include "scene/calibration.hpp"
#include "scene/scene_keys.hpp"
#include "scene/tables.hpp"
#include "scene_text.hpp"

using namespace nsframe;
using test::error;
using test::errors;
using test::scene;

namespace {

constexpr const char* keyed = R"(
[material.S235]
law = "Elastic"
E = "210 GPa"
[section."my beam"]
E = "210 GPa"
poisson = 0.3
A = 5e-3
Iz = 1e-4
Iy = 2e-5
J = 1e-6
[section.column]
shape = "HEA100"
material = "S235"
[structure.left]
model = "story_frame"
stories = 2
height = 2.5
plan = [3.2, 2.2]
columns = { section = "column" }
beams = { section = "my beam" }
braces = { planes = ["-x"], material = "S235", area = [1e-4, 2e-4] }
base = { kind = "spring", stiffness = 1e7 }
floor_mass = 4600
[structure.a]
nodes = [[1, 9, 0, 0], [top, 9, 0, 1]]
supports = { 1 = "fixed", top = ["uy", "uz", "rx", "ry", "rz"] }
masses = { top = [100, 100, 100] }
springs = [{ id = "k1", nodes = "top", stiffness = { ux = 1e5 } }]
[gravity]
)";

// The scene above, with `top` quoted as TOML wants it.
std::string keyed_text(const std::string& more = "") {
  std::string text = keyed;
  const std::size_t bare = text.find("[top,");
  text.replace(bare, 5, "[\"top\",");
  return text + more;
}

std::string number_error(const std::string& key) {
  Scene s = scene(keyed_text());
  try {
    find_numbers(s.tables, key);
  } catch (const SceneKeyError& fault) {
    return fault.what();
  }
  return "no error";
}

std::vector<double> numbers(const std::string& key) {
  Scene s = scene(keyed_text());
  std::vector<double> out;
  for (const double* value : find_numbers(s.tables, key).values) out.push_back(*value);
  return out;
}

std::string with_calibration(const std::string& lines) {
  return keyed_text("[calibration]\ntargets = [[\"left\", \"L1\", 2.1]]\n" + lines);
}

}  // namespace

TEST_CASE("a key finds the numbers of a scene, in lists, in members of lists and where the file leaves the default") {
  CHECK(numbers("material.S235.E") == std::vector<double>{210e9});
  CHECK(numbers("section.\"my beam\".Iz") == std::vector<double>{1e-4});
  CHECK(numbers("section.column.poisson") == std::vector<double>{0.3});
  CHECK(numbers("structure.left.braces.area[2]") == std::vector<double>{2e-4});
  CHECK(numbers("structure.left.braces.area") == std::vector<double>{1e-4, 2e-4});
  CHECK(numbers("structure.left.base.stiffness") == std::vector<double>{1e7});
  CHECK(numbers("structure.left.centre_share") == std::vector<double>{2.0 / 3});
  CHECK(numbers("structure.left.plan[2][1]") == std::vector<double>{2.2});
  CHECK(numbers("structure.a.springs.k1.stiffness.ux") == std::vector<double>{1e5});
  CHECK(numbers("structure.a.masses.top.mass[3]") == std::vector<double>{100});
  CHECK(numbers("gravity.acceleration") == std::vector<double>{9.81});
  Scene s = scene(keyed_text());
  const SceneNumbers area = find_numbers(s.tables, "structure.left.braces.area[1]");
  CHECK(area.dimension == dimension::area);
  CHECK_FALSE(area.range.contains(0));
}

TEST_CASE("a key that finds no number says why, with the nearest name") {
  CHECK(number_error("structure.left.braces.aera") == "there is no key 'aera'; did you mean 'area'?");
  CHECK(number_error("structure.lefd.braces.area") == "there is no structure 'lefd'; did you mean 'left'?");
  CHECK(number_error("section.column.material") == "'material' is not a number that can be fitted");
  CHECK(number_error("structure.left.braces.area[3]") == "'area' has 2 values, there is no [3]");
  CHECK(number_error("structure.left.braces.area[0]").find("is not a place in a list: [1] is the first") != std::string::npos);
  CHECK(number_error("structure.left.base.stiffness[1]") == "'stiffness' is not a list of numbers");
  CHECK(number_error("structure.left.base") == "'base' is a table: name a number in it");
  CHECK(number_error("structure.left.base.stiffness.x") == "'stiffness' is a number, it has no key 'x'");
  CHECK(number_error("structure.left.centre_inertia") == "'centre_inertia' has no value in the scene");
  CHECK(number_error("structure.a.springs.k2.stiffness.ux") == "'springs' has no 'k2'; did you mean 'k1'?");
  CHECK(number_error("analysis.dt").find("'analysis' cannot be fitted") == 0);
  CHECK(number_error("structure..left") == "not a dotted key, as section.beam.Iz");
  CHECK(number_error("gravity.direction") == "'direction' is not a number that can be fitted");
}

TEST_CASE("parameters set or scale numbers, and leave the rest of the scene as it is") {
  const Scene s = scene(with_calibration(R"([calibration.parameters]
area = { sets = "structure.left.braces.area", bounds = ["0.5 cm2", "4 cm2"], start = "1 cm2" }
steel = { scales = ["material.S235.E", "section.\"my beam\".E"], bounds = [0.5, 2] }
base = { sets = "structure.left.base.stiffness", bounds = ["1e6 N m/rad", 1e9] }
)"));
  Diagnostics diagnostics;
  const std::vector<SceneParameter> parameters = calibration_parameters(s, diagnostics);
  REQUIRE(diagnostics.empty());
  REQUIRE(parameters.size() == 3);
  CHECK(parameters[0].start == doctest::Approx(1e-4));
  CHECK(parameters[0].unit == "m2");
  CHECK(parameters[1].start == 1);
  CHECK(parameters[1].unit == "");
  CHECK(parameters[2].start == 1e7);
  CHECK(parameters[2].lower == 1e6);
  SceneTables tables = s.tables;
  set_parameters(parameters, Vector3(3e-4, 1.1, 2e7), tables);
  Scene moved = s;
  moved.tables = tables;
  const auto value = [&](const char* key) { return *find_numbers(moved.tables, key).values.front(); };
  CHECK(value("structure.left.braces.area[1]") == 3e-4);
  CHECK(value("structure.left.braces.area[2]") == 3e-4);
  CHECK(value("material.S235.E") == doctest::Approx(231e9));
  CHECK(value("section.\"my beam\".E") == doctest::Approx(231e9));
  CHECK(value("structure.left.base.stiffness") == 2e7);
  CHECK(value("section.\"my beam\".Iz") == 1e-4);
  const ModelDescription model = ParametricModel(s, parameters)(Vector3(3e-4, 1.1, 2e7));
  CHECK(model.structures.size() == 2);
}

TEST_CASE("values that no section can have are an error of the model, not a model") {
  const std::string tube = "[section.tube]\ntube = [0.1, 0.1, 0.005]\nmaterial = \"S235\"\n";
  const Scene s = scene(with_calibration("parameters = [[\"wall\", \"section.tube.tube.thickness\", 0.001, 0.08]]\n" + tube));
  Diagnostics diagnostics;
  const ParametricModel model(s, calibration_parameters(s, diagnostics));
  REQUIRE(diagnostics.empty());
  CHECK(model(VectorX::Constant(1, 0.01)).structures.size() == 2);
  CHECK_THROWS_AS(model(VectorX::Constant(1, 0.07)), InputError);
}

TEST_CASE("a calibration is written with the scene and reads back") {
  const Scene s = scene(with_calibration(R"(accuracy = "2 %"
parameters = [["base", "structure.left.base.stiffness", "1e6 N m/rad", 1e9, 2e7]]
)"));
  const std::string text = write_scene(s);
  const Scene again = scene(text);
  CHECK(write_scene(again) == text);
  CHECK(again.tables.calibration->accuracy == 0.02);
  CHECK(again.tables.calibration->parameters[0].start->number == 2e7);
  CHECK(again.tables.calibration->targets[0].mode->name == "L1");
}

TEST_CASE("a faulty calibration is reported by every command at its place") {
  const auto parameter = [](const std::string& line) { return error(with_calibration("[calibration.parameters]\n" + line)); };
  const std::string place = "s.toml:34:";
  CHECK(parameter("b = { sets = \"structure.left.base.stifness\", bounds = [1e6, 1e9] }") ==
        place + "14: error: structure.left.base.stifness: there is no key 'stifness'; did you mean 'stiffness'?");
  CHECK(parameter("b = { sets = \"structure.left.base.stiffness\", bounds = [\"1e6 N/m\", 1e9] }") ==
        place + "57: error: bounds = \"1e6 N/m\" is a stiffness, must be a rotational stiffness (N m/rad)");
  CHECK(parameter("b = { sets = \"structure.left.base.stiffness\", bounds = [1e9, 1e6] }") ==
        place + "57: error: bounds of 'b' are [1e+09, 1e+06], must be positive and rise");
  CHECK(parameter("b = { sets = \"structure.left.base.stiffness\", bounds = [1e8, 1e9] }") ==
        place + "57: error: 'b' starts at 1e+07, the scene's value, outside its bounds [1e+08, 1e+09]");
  CHECK(parameter("b = { sets = \"section.column.poisson\", bounds = [0.1, 0.6] }") ==
        place + "55: error: at this bound of 'b' section.column.poisson = 0.6, must lie in (-1, 0.5]");
  CHECK(parameter("b = { sets = \"structure.left.braces.area\", bounds = [1e-5, 1e-3] }") ==
        place + "1: error: the keys of 'b' have several values in the scene: give its start");
  CHECK(parameter("b = { sets = \"structure.left.base.stiffness\", bounds = [1e6, 1e9] }\nc = { scales = "
                  "\"structure.left.base.stiffness\", bounds = [0.5, 2] }") ==
        "s.toml:35:16: error: 'structure.left.base.stiffness' is set by parameter 'b' already");
  CHECK(parameter("b = { sets = [\"structure.left.base.stiffness\", \"material.S235.E\"], bounds = [1e6, 1e9] }")
            .find("the parameter's other keys are a rotational stiffness") != std::string::npos);
  CHECK(parameter("b = { bounds = [1e6, 1e9] }").find("a parameter has either sets or scales") != std::string::npos);
  CHECK(parameter("b = { sets = \"structure.left.base.stiffness\", bound = [1e6, 1e9] }")
            .find("unknown key 'bound'; did you mean 'bounds'?") != std::string::npos);
  const auto target = [](const std::string& row) {
    return error(keyed_text("[calibration]\nparameters = [[\"b\", \"structure.left.base.stiffness\", 1e6, 1e9]]\ntargets = [" + row + "]"));
  };
  CHECK(target("[\"lefft\", \"L1\", 2]") == "s.toml:33:13: error: there is no structure 'lefft'; did you mean 'left'?");
  CHECK(target("[\"left\", \"X1\", 2]") == "s.toml:33:21: error: 'X1' is not the name of a mode: L, T, R or V and its number");
  CHECK(target("[\"left\", \"L1\", 0]") == "s.toml:33:27: error: frequency = 0, must be positive");
  CHECK(target("[\"left\", \"L1\", 2], [\"left\", \"L1\", 3]").find("mode L1 of 'left' is measured twice") != std::string::npos);
  CHECK(target("{ structure = \"left\", frequency = 2 }").find("a target needs a mode or a shape") != std::string::npos);
  CHECK(target("{ structure = \"left\", frequency = 2, shape = [[\"99\", \"ux\", 1]] }").find("structure 'left' has no node '99'") !=
        std::string::npos);
  CHECK(target("").find("a calibration needs targets") != std::string::npos);
}
