// The examples that have a closed form, run from their scene files: the largest position error of the whole run is the
// number "closed_form/largest_error" of their expected.json.
#include <doctest/doctest.h>

#include <fstream>
#include <functional>
#include <nlohmann/json.hpp>

#include "integrators/simulation.hpp"
#include "scene/scene.hpp"
#include "tests/verification/closed_forms.hpp"
#include "tests/verification/pair_of_masses.hpp"

using namespace nsframe;
using namespace nsframe::test;

namespace {

std::filesystem::path example_folder(const std::string& example) {
  return std::filesystem::path(NSFRAME_SOURCE_DIR) / "examples" / example;
}

struct Expected {
  double value = 0, tolerance = 0;
};

Expected expected(const std::string& example, const std::string& path) {
  std::ifstream file(example_folder(example) / "expected.json");
  const nlohmann::json json = nlohmann::json::parse(file);
  for (const auto& entry : json["numbers"]) {
    if (entry["path"] == path) return {entry["value"].get<double>(), entry["tolerance"].get<double>()};
  }
  FAIL("expected.json of ", example, " has no ", path);
  return {};
}

// `exact`: the free DOFs at a time.
double largest_error(const std::string& example, const std::vector<std::string>& overrides,
                     const std::function<std::vector<double>(double)>& exact) {
  Diagnostics diagnostics;
  const Scene scene = read_scene(example_folder(example) / "scene.toml", overrides, diagnostics);
  const Model model = build_model(scene.model, diagnostics);
  diagnostics.throw_if_any();
  Simulation simulation(model, scene.analysis);
  Recorder recorder;
  simulation.run({&recorder});
  double error = 0;
  for (const State& state : recorder.states) {
    const std::vector<double> reference = exact(state.time);
    REQUIRE(state.displacement.size() == static_cast<Eigen::Index>(reference.size()));
    for (std::size_t i = 0; i < reference.size(); ++i) {
      error = std::max(error, std::abs(state.displacement[static_cast<Eigen::Index>(i)] - reference[i]));
    }
  }
  return error;
}

std::vector<double> ball(double t) { return {bouncing_ball_height(t) - 1}; }

std::vector<double> pair_of_masses(double t) {
  const std::array<double, 2> x = pull_back_exact(t);
  return {x[0], x[1]};
}

}  // namespace

TEST_CASE("the example bouncing_ball has the position error that its expected numbers say") {
  const Expected error = expected("bouncing_ball", "closed_form/largest_error");
  CHECK(std::abs(largest_error("bouncing_ball", {}, ball) - error.value) < error.tolerance);
  const Expected fine = expected("bouncing_ball", "closed_form/largest_error_at_0.1_ms");
  CHECK(std::abs(largest_error("bouncing_ball", {"analysis.dt=1e-4"}, ball) - fine.value) < fine.tolerance);
}

TEST_CASE("the example pull_back has the position errors that its expected numbers say, for both theta") {
  const Expected full = expected("pull_back", "closed_form/largest_error");
  CHECK(std::abs(largest_error("pull_back", {}, pair_of_masses) - full.value) < full.tolerance);
  const Expected half = expected("pull_back", "closed_form/largest_error_at_theta_0.5");
  CHECK(std::abs(largest_error("pull_back", {"analysis.theta=0.5"}, pair_of_masses) - half.value) < half.tolerance);
}
