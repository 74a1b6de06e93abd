// Static stages in results.h5, summary.json, the terminal's table and ParaView frames.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <nlohmann/json.hpp>

#include "output/history_file.hpp"
#include "output/numerical_warnings.hpp"
#include "output/summary.hpp"
#include "tests/output/sample_pair.hpp"
#include "tests/support/files.hpp"
#include "tests/support/hdf5_contents.hpp"
#include "tests/support/hdf5_reader.hpp"
#include "tests/verification/two_story_model.hpp"
#ifdef NSFRAME_HAS_VTK
#include "output/stage_frames.hpp"
#endif

using namespace nsframe;
using namespace nsframe::test;

namespace {

// The left frame pushed at its roof, in two stages; a time history follows when the duration says so.
ModelDescription pushed_frame() {
  ModelDescription d;
  d.sections = {sample_section("HEA100"), sample_section("IPE200")};
  d.structures = {sample_frame("left", 0, 4600)};
  d.gravity.acceleration = Vector3(0, 0, -9.81);
  StageDescription push;
  push.name = "push";
  push.loads = {{{"left.21", {}}, 0, 1000}, {{"left.24", {}}, 0, 1000}};
  push.control_node = Reference{"left.21", {}};
  push.options.control = "displacement";
  push.options.targets = {0.01, -0.01};
  push.options.steps = 4;
  StageDescription release;
  release.name = "release";
  release.masses = Vector3::UnitX();
  release.options.targets = {1};
  release.options.steps = 3;
  d.stages = {push, release};
  return d;
}

AnalysisOptions analysis(double duration) {
  AnalysisOptions options;
  options.scheme = "moreau-jean";
  options.duration = duration;
  return options;
}

std::vector<double> numbers(const Hdf5Contents& contents, const std::string& name, std::size_t count) {
  const auto found = contents.find(name);
  REQUIRE_MESSAGE(found != contents.end(), name);
  std::vector<double> values(count);
  REQUIRE(found->second.size() > count * sizeof(double));
  std::memcpy(values.data(), found->second.data() + found->second.size() - count * sizeof(double), count * sizeof(double));
  return values;
}

}  // namespace

TEST_CASE("results.h5 has the curve and the histories of every static stage, alone or before a time history") {
  for (const double duration : {0.0, 0.01}) {
    Diagnostics diagnostics;
    const Model model = build_model(pushed_frame(), diagnostics);
    Simulation simulation(model, analysis(duration));
    const TemporaryFolder folder;
    OutputOptions output;
    output.history = {"nodes", "elements"};
    output.nodes = {"left.21"};
    HistoryFile file(folder.path() / "results.h5", output, "scene");
    const Summary summary = simulation.run({&file}, {}, {&file.stages()});
    REQUIRE(summary.completed);
    CHECK(summary.steps == (duration > 0 ? 10 : 0));
    file.close();
    const Hdf5Contents contents = hdf5_contents(folder.path() / "results.h5");
    const std::vector<double> factor = numbers(contents, "static/push/load_factor", 9);
    const std::vector<double> displacement = numbers(contents, "static/push/control_displacement", 9);
    const std::vector<double> node = numbers(contents, "static/push/nodes/displacement", 9 * 6);
    for (std::size_t i = 0; i < 9; ++i) {
      CHECK(factor[i] == summary.stages[0].points[i].load_factor);
      CHECK(displacement[i] == summary.stages[0].points[i].displacement);
      CHECK(node[6 * i] == doctest::Approx(displacement[i]).epsilon(1e-12));
    }
    CHECK(displacement.back() == doctest::Approx(-0.01).epsilon(1e-12));
    CHECK(contents.at("static/push@completed").size() > 0);
    CHECK(contents.contains("static/push/elements/elastic_beam/forces"));
    CHECK_FALSE(contents.contains("static/push/nodes/velocity"));
    CHECK(numbers(contents, "static/release/load_factor", 4).back() == 1);
    CHECK(contents.contains("time") == (duration > 0));
    double finished = 0;
    std::memcpy(&finished, contents.at(".@finished").data() + contents.at(".@finished").size() - sizeof finished, sizeof finished);
    CHECK(finished == 1);
  }
}

TEST_CASE("fibers of a static stage carry the force of their section") {
  const Scene scene = example_scene("section_shapes", {"static.to=3 mm"});
  const Model model = model_of(scene);
  Simulation simulation(model, scene.analysis);
  const TemporaryFolder folder;
  HistoryFile file(folder.path() / "results.h5", scene.output, "scene");
  simulation.run({&file}, {}, {&file.stages()});
  file.close();
  const Hdf5Reader results(folder.path() / "results.h5");
  const std::string base = "/static/push/fibers/force_beam/", sections = "/static/push/sections/force_beam/";
  const auto numbers_of = [&](const std::string& name) { return results.numbers(name.c_str()); };
  const std::vector<double> stress = numbers_of(base + "stress"), area = numbers_of(base + "area"), y = numbers_of(base + "y"), point = numbers_of(base + "point");
  const std::vector<double> force = numbers_of(sections + "force");
  const std::vector<std::string> element = results.texts((base + "element").c_str()), owner = results.texts((sections + "element").c_str());
  const std::size_t last = stress.size() - area.size(), row = force.size() - 3 * owner.size();
  REQUIRE(stress.size() == 7 * area.size());  // the start and six points
  double moment = 0;
  for (std::size_t i = 0; i < area.size(); ++i) {
    if (element[i] == "row.pipe" && point[i] == 1) moment -= stress[last + i] * area[i] * y[i];
  }
  const auto foot = static_cast<std::size_t>(std::find(owner.begin(), owner.end(), "row.pipe") - owner.begin());
  CHECK(std::abs(moment) > 1e3);
  CHECK(moment == doctest::Approx(force[row + 3 * foot + 1]).epsilon(1e-9));
}

TEST_CASE("the summary tells of the stages, and of steps where an algorithm failed") {
  Diagnostics diagnostics;
  const Model model = build_model(pushed_frame(), diagnostics);
  Simulation simulation(model, analysis(0));
  Summary summary = simulation.run({});
  summary.stages[0].ladder = {{"push", 3, 0.5, {{"newton", 30, false, 7, ""}, {"krylov", 7, true, 0.5, ""}}}};
  const auto json = nlohmann::json::parse(summary_json(summary));
  REQUIRE(json["stages"].size() == 2);
  CHECK(json["stages"][0]["stage"] == "push");
  CHECK(json["stages"][0]["at"] == "left.21 ux");
  CHECK(json["stages"][0]["points"] == 8);
  CHECK(json["stages"][0]["control_displacement"].get<double>() == doctest::Approx(-0.01));
  CHECK(json["stages"][0]["displacement_at_largest"].get<double>() == doctest::Approx(0.01));
  CHECK(json["stages"][0]["ladder"][0]["attempts"][1]["algorithm"] == "krylov");
  CHECK(json["stages"][1]["load_factor"] == 1);
  const std::string text = summary_text(summary);
  CHECK(text.find("Static stage 'push' by displacement: 8 points") != std::string::npos);
  CHECK(text.find("after point 3: newton failed (30 iterations), krylov converged in 7") != std::string::npos);
  CHECK(text.find("Energy") == std::string::npos);
  CHECK(numerical_warnings(summary).empty());
  summary.stages[1].least_gap = -2e-3;
  REQUIRE(numerical_warnings(summary).size() == 1);
  CHECK(numerical_warnings(summary)[0].starts_with("static stage 'release' closes a contact by 2 mm"));
}

TEST_CASE("a load that jumps while a displacement is led on by small steps is told") {
  Summary summary;
  StageResult stage;
  stage.name = "push";
  stage.control = "displacement";
  stage.at = "left.9 ux";
  for (int k = 0; k <= 30; ++k) stage.points.push_back({100.0 * k, 1e-3 * k, 2, 1e-9});
  summary.stages = {stage};
  CHECK(numerical_warnings(summary).empty());
  summary.stages[0].points[7].load_factor = -2500;
  const auto warnings = numerical_warnings(summary);
  REQUIRE(warnings.size() == 1);
  CHECK(warnings[0] ==
        "static stage 'push': from point 7 to the next, at 0.008 of left.9 ux, the load factor jumps from -2500 to 800: the path may have gone over to another "
        "equilibrium; a smaller step, or control = \"arc-length\", tells");
  summary.stages[0].control = "load";
  CHECK(numerical_warnings(summary).empty());
}

TEST_CASE("a stage that pushes one structure into another knows how far") {
  ModelDescription d = sample_description();
  d.motions.clear();
  StageDescription push;
  push.name = "push";
  push.loads = {{{"left.22", {}}, 0, 1000}, {{"left.23", {}}, 0, 1000}};
  push.control_node = Reference{"left.22", {}};
  push.options.control = "displacement";
  push.options.targets = {0.06, 0.01};
  d.stages = {push};
  Diagnostics diagnostics;
  const Model model = build_model(d, diagnostics);
  Simulation simulation(model, analysis(0));
  const Summary summary = simulation.run({});
  REQUIRE(summary.stages.size() == 1);
  CHECK(summary.stages[0].least_gap == doctest::Approx(sample_gap[0] - 0.06).epsilon(1e-9));  // the lower corner of the roof
}

#ifdef NSFRAME_HAS_VTK
TEST_CASE("every point of a stage is a frame of its own collection") {
  Diagnostics diagnostics;
  const Model model = build_model(pushed_frame(), diagnostics);
  Simulation simulation(model, analysis(0));
  const TemporaryFolder folder;
  StageFrames frames(folder.path(), {});
  simulation.run({}, {}, {&frames});
  for (const auto& [stage, count] : {std::pair{"push", 9}, {"release", 4}}) {
    CHECK(std::filesystem::exists(folder.path() / stage / "frames.pvd"));
    int files = 0;
    for (const auto& entry : std::filesystem::directory_iterator(folder.path() / stage / "frames")) files += entry.is_regular_file();
    CHECK(files == count);
  }
}
#endif

TEST_CASE("a run that goes on from a checkpoint after static stages leaves the same results.h5") {
  Diagnostics diagnostics;
  const Model model = build_model(pushed_frame(), diagnostics);
  const TemporaryFolder folder;
  OutputOptions output;
  output.history = {"nodes", "elements", "energy"};
  {
    Simulation simulation(model, analysis(0.02));
    HistoryFile file(folder.path() / "whole.h5", output, "scene");
    CHECK(simulation.run({&file}, {}, {&file.stages()}).completed);
  }
  Snapshot kept;
  {
    Simulation simulation(model, analysis(0.01));
    HistoryFile file(folder.path() / "parts.h5", output, "scene");
    RunControl control;
    control.keep_snapshot = [&](const Snapshot& snapshot) { kept = snapshot; };
    CHECK(simulation.run({&file}, control, {&file.stages()}).completed);
  }
  {
    Simulation simulation(model, analysis(0.02));
    HistoryFile file(folder.path() / "parts.h5", output, "scene");
    RunControl control;
    control.resume = &kept;
    CHECK(simulation.run({&file}, control).completed);
  }
  check_same_contents(folder.path() / "whole.h5", folder.path() / "parts.h5");
}
