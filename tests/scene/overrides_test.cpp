#include <doctest/doctest.h>

#include "scene_text.hpp"

using namespace nsframe;
using test::error;
using test::scene;

namespace {

constexpr const char* pair = R"(
[structure.left]
model = "story_frame"
plan = [3, 2]
columns = { section = "c" }
[structure.right]
nodes = [[1, 0, 0, 0]]
[[contact]]
between = ["left", "right"]
restitution = 0.5
[[contact]]
between = ["left.1", "right.1"]
)";

}  // namespace

TEST_CASE("an override changes or adds a value") {
  const Scene s = scene(
      pair, {"analysis.dt=1e-4", "analysis.theta = 0.5", "analysis.scheme=moreau-jean", "analysis.duration=5 s",
             "title=A pair", "output.frames=\"50 Hz\"", "output.history=[\"nodes\"]", "structure.left.stories=3"});
  CHECK(s.analysis.dt == 1e-4);
  CHECK(s.analysis.theta == 0.5);
  CHECK(s.analysis.scheme == "moreau-jean");
  CHECK(s.analysis.duration == 5);
  CHECK(s.title == "A pair");
  CHECK(s.output.frames == 50);
  CHECK(s.output.history == std::vector<std::string>{"nodes"});
  CHECK(s.model.structures[0].slabs.size() == 3);
}

TEST_CASE("an override of the contact reaches all contacts") {
  const Scene s = scene(pair, {"contact.restitution=0.9"});
  CHECK(s.model.contacts[0].restitution == 0.9);
  CHECK(s.model.contacts[1].restitution == 0.9);
}

TEST_CASE("overrides of the motion reach all motions, and may make one") {
  const test::TemporaryFolder directory;
  directory.write("a.txt", "0\n0.5\n-1\n");
  const std::vector<std::string> overrides{"motion.file=a.txt", "motion.pga=0.25 g", "motion.dt=0.1",
                                           "motion.unit=m/s2", "motion.direction=y"};
  for (const std::string text :
       {"", "[motion]\nfile = \"b.txt\"\n", "[[motion]]\nfile = \"b\"\n[[motion]]\nfile = \"c\"\n"}) {
    Diagnostics diagnostics;
    const Scene s = parse_scene(text, "s.toml", directory.path(), overrides, diagnostics);
    CHECK(diagnostics.messages().empty());
    REQUIRE(s.model.motions.size() == (text.find("[[") == std::string::npos ? 1 : 2));
    CHECK(s.model.motions.back().acceleration[2] == doctest::Approx(-0.25 * 9.80665).epsilon(1e-15));
    CHECK(s.model.motions.back().direction == Vector3::UnitY());
  }
}

TEST_CASE("a record named by an override is found from the scene or from the current directory") {
  const test::TemporaryFolder here, there;
  here.write("here.txt", "1\n");
  there.write("there.txt", "2\n");
  const auto before = std::filesystem::current_path();
  std::filesystem::current_path(here.path());
  for (const char* file : {"here.txt", "there.txt"}) {
    Diagnostics diagnostics;
    const Scene s = parse_scene("", "s.toml", there.path(),
                                {std::string("motion.file=") + file, "motion.dt=1", "motion.unit=m/s2"}, diagnostics);
    CHECK(diagnostics.messages().empty());
    CHECK(s.model.motions.size() == 1);
  }
  std::filesystem::current_path(before);
}

TEST_CASE("errors in overrides are shown at the override") {
  CHECK(error(pair, {"analysis.dt=0"}) == "--set analysis.dt: error: dt = 0, must be positive");
  CHECK(error(pair, {"analysis.tehta=1"}) == "--set analysis.tehta: error: unknown key 'tehta'; did you mean 'theta'?");
  CHECK(error(pair, {"analyses.dt=1"}) == "--set analyses.dt: error: unknown key 'analyses'; did you mean 'analysis'?");
  CHECK(error(pair, {"structure.lef.stories=1"}) ==
        "--set structure.lef.stories: error: there is no structure 'lef'; did you mean 'left'?");
  CHECK(error("", {"contact.restitution=1"}) == "--set contact.restitution: error: the scene has no contact");
  CHECK(error(pair, {"structure.left.plan.x=1"}) ==
        "--set structure.left.plan.x: error: 'plan' is a value, it has no keys");
  CHECK(error(pair, {"analysis.dt"}) == "--set analysis.dt: error: must be written as key=value");
  CHECK(error(pair, {"=1"}) == "--set =1: error: must be written as key=value");
  CHECK(error(pair, {"a b=1"}) == "--set a b: error: not a key of a scene");
}

TEST_CASE("an override is one value, whatever lines it holds") {
  CHECK(scene("", {"title=a\nb"}).title == "a\nb");
  CHECK(scene("", {"title=say \"a\\b\""}).title == "say \"a\\b\"");
}

TEST_CASE("options of Moreau-Jean without a scheme ask for it, also on the command line; a named scheme stays") {
  const auto analysis = [](const std::string& text, const std::vector<std::string>& set) {
    Diagnostics diagnostics;
    return parse_scene("[structure.a]\nnodes = [[1, 0, 0, 0]]\n" + text, "s.toml", {}, set, diagnostics).analysis;
  };
  CHECK(analysis("", {}).scheme == "auto");
  CHECK(analysis("[analysis]\ndt = 0.01", {}).scheme == "auto");
  for (const char* option : {"theta = 0.5", "gamma = 1.5", "newton_tolerance = 1e-9", "max_newton = 20", "max_halvings = 3",
                             "contact_solver = \"gauss-seidel\"", "projection = true"}) {
    CAPTURE(option);
    const AnalysisOptions a = analysis(std::string("[analysis]\n") + option, {});
    CHECK(a.scheme == "moreau-jean");
    CHECK(a.scheme_reason.find(std::string("analysis.") + std::string(option).substr(0, 5)) == 0);
  }
  CHECK(analysis("", {"analysis.theta=0.5"}).scheme == "moreau-jean");
  const AnalysisOptions named = analysis("[analysis]\ntheta = 0.5\nscheme = \"exact\"", {});
  CHECK(named.scheme == "exact");
  CHECK(named.scheme_at.line == 5);
}
