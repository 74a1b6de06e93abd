// The examples that have a closed form, run from their scene files: the largest position error of the whole run is the
// number "closed_form/largest_error" of their expected.json; of langlade_2021, the one that its results.json has.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <cmath>
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
                     const std::function<std::vector<double>(double)>& exact, const std::string& file = "scene.toml") {
  Diagnostics diagnostics;
  const Scene scene = read_scene(example_folder(example) / file, overrides, diagnostics);
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

namespace {

nlohmann::json paper_results() {
  std::ifstream file(example_folder("langlade_2021") / "results.json");
  return nlohmann::json::parse(file);
}

// Four digits are kept there.
constexpr double kept_digits = 1e-3;

std::vector<std::string> stepping(double theta, double dt, double gamma = 1.5) {
  return {fmt::format("analysis.theta={}", theta), fmt::format("analysis.dt={}", dt), fmt::format("analysis.gamma={}", gamma)};
}

}  // namespace

TEST_CASE("the page of the paper has the errors of the ball: by impacts, and by penalty laws of the best stiffness") {
  const auto results = paper_results()["ball"];
  REQUIRE(results["nscd"].size() == 8);
  for (const auto& run : results["nscd"]) {
    CAPTURE(run.dump());
    const double error = largest_error("langlade_2021", stepping(run["theta"], run["dt"], run["gamma"]), ball, "bouncing_ball.toml");
    CHECK(error == doctest::Approx(run["error"].get<double>()).epsilon(kept_digits));
  }
  for (const auto& series : results["penalty"]) {
    if (series["theta"] != 0.5 || series["dt"] != 1e-3) continue;
    CAPTURE(series["law"].dump());
    const bool linear = series["law"] == "LVE";
    // a stiffness that the step resolves: where it does not, the error hangs on the last digits
    const std::size_t resolved = 6;
    const double stiffness = results["stiffnesses"][resolved];
    auto overrides = stepping(0.5, 1e-3);
    overrides.push_back(linear ? "contact.law=linear-viscoelastic" : "contact.law=jankowski");
    overrides.push_back(fmt::format("contact.{}={}", linear ? "stiffness" : "hertz_stiffness", stiffness));
    const double error = largest_error("langlade_2021", overrides, ball, "bouncing_ball.toml");
    CHECK(error == doctest::Approx(series["errors"][resolved].get<double>()).epsilon(kept_digits));
  }
}

TEST_CASE("the page of the paper has the errors of the pull-back against its closed form, for every e") {
  const std::array<double, 2> m{4600, 3500}, k{m[0] * std::pow(2 * M_PI * 3.50, 2), m[1] * std::pow(2 * M_PI * 6.55, 2)};
  const auto results = paper_results()["pull_back"];
  for (const auto& item : results["restitutions"].items()) {
    const std::string e = item.key();
    const auto& runs = item.value();
    const auto impacts = two_oscillator_impacts(m, k, 0.005, 0.02, -0.024, std::stod(e), 1.5);
    const auto exact = [&](double t) {
      const FreeOscillator left{std::sqrt(k[0] / m[0]), 0.005}, right{std::sqrt(k[1] / m[1]), 0.005};
      ExactImpact last{0, 0, {-0.024, 0}, {0, 0}};
      for (const auto& impact : impacts) {
        if (impact.time <= t) last = impact;
      }
      return std::vector<double>{left.at(last.x[0], last.v[0], t - last.time)[0], right.at(last.x[1], last.v[1], t - last.time)[0]};
    };
    const std::string restitution = "contact.restitution=" + e;
    CAPTURE(e);
    CHECK(runs["exact"]["poundings"] == impacts.size());
    for (std::size_t i = 0; i < impacts.size(); ++i) {
      CHECK(std::abs(runs["exact"]["at"][i].get<double>() - impacts[i].time) < 1e-5);  // five decimals are kept
    }
    const double paper = largest_error("langlade_2021", {restitution}, exact, "pull_back.toml");
    CHECK(paper == doctest::Approx(runs["paper"]["error"].get<double>()).epsilon(kept_digits));
  }
}
