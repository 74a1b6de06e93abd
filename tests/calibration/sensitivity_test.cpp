// Analytic sensitivities of frequencies against differences of frequencies found anew.
#include "problems.hpp"

using namespace nsframe;
using namespace nsframe::test;

namespace {

// d ln f / d ln p by central differences of the eigenvalue problem.
MatrixX by_differences(const CalibrationProblem& problem, const VectorX& values, double step) {
  MatrixX out(static_cast<Eigen::Index>(problem.targets.size()), values.size());
  for (Eigen::Index j = 0; j < values.size(); ++j) {
    VectorX high = values, low = values;
    high[j] *= std::exp(step);
    low[j] *= std::exp(-step);
    out.col(j) = (frequencies(problem, high).array() / frequencies(problem, low).array()).log() / (2 * step);
  }
  return out;
}

void check_sensitivities(const CalibrationProblem& problem, double tolerance) {
  const VectorX values = starts(problem);
  const MatrixX analytic = frequency_sensitivity(problem, values, identify(problem, resting_model(problem.model(values))));
  const MatrixX difference = analytic - by_differences(problem, values, 1e-3);
  CHECK(analytic.cwiseAbs().maxCoeff() > 0.1);
  CHECK(difference.cwiseAbs().maxCoeff() < tolerance);
}

}  // namespace

TEST_CASE("sensitivities of the two-story frames' frequencies equal differences of frequencies found anew") {
  const Scene scene = calibration_scene();
  // central differences over 2e-3 of ln p: truncation of 1e-6 h^2 times a third derivative below 2
  check_sensitivities(example_problem(scene, "left"), 1e-6);
  check_sensitivities(example_problem(scene, "right"), 1e-6);
}

TEST_CASE("sensitivities hold where the stiffness depends on mass and height through gravity") {
  const Scene scene = calibration_scene({"structure.left.columns.geometry=p-delta", "structure.left.height=[2.5, 2.5]"});
  std::vector<SceneParameter> parameters(3);
  parameters[0] = {"mass", {"structure.left.floor_mass"}, false, 4600, 1000, 9000, "kg"};
  parameters[1] = {"height", {"structure.left.height[1]"}, false, 2.5, 2, 3, "m"};
  parameters[2] = {"gravity", {"gravity.acceleration"}, true, 1, 0.5, 2, ""};
  CalibrationProblem problem = example_problem(scene, "left");
  problem.parameters = {{"mass", 4600, 1000, 9000, "kg", ""}, {"height", 2.5, 2, 3, "m", ""}, {"gravity", 1, 0.5, 2, "", ""}};
  problem.model = ParametricModel(scene, parameters);
  const VectorX values = starts(problem);
  const MatrixX analytic = frequency_sensitivity(problem, values, identify(problem, resting_model(problem.model(values))));
  CHECK(std::abs(analytic(0, 2)) > 1e-3);  // gravity does soften L1
  check_sensitivities(problem, 2e-5);      // the height's third derivative is tens
}

TEST_CASE("an oscillator's frequency changes by half of its stiffness and minus half of its mass") {
  CalibrationProblem problem;
  problem.parameters = {{"k", 2e6, 1e5, 1e7, "N/m", ""}, {"m", 1000, 100, 1e4, "kg", ""}};
  problem.targets = {{{}, "a", "L1", 5, 1, {}}};
  problem.model = [](const VectorX& p) {
    ModelDescription d = masses_on_springs({p[0]});
    d.structures[0].masses[0] = mass("1", p[1]);
    return d;
  };
  const VectorX values = starts(problem);
  const MatrixX s = frequency_sensitivity(problem, values, identify(problem, resting_model(problem.model(values))));
  CHECK(s(0, 0) == doctest::Approx(0.5).epsilon(1e-10));
  CHECK(s(0, 1) == doctest::Approx(-0.5).epsilon(1e-10));
}

TEST_CASE("no error of parameters follows where frequencies see only their quotient, and the rest is the covariance in closed form") {
  MatrixX s(2, 3);
  s << 0.5, -0.5, 0,  //
      0, 0, 0.25;
  const Identifiability seen = identifiability(s, 0.01);
  CHECK(std::isinf(seen.error[0]));
  CHECK(std::isinf(seen.error[1]));
  CHECK(seen.error[2] == doctest::Approx(0.04).epsilon(1e-12));
  REQUIRE(seen.unseen.size() == 1);
  CHECK(seen.unseen[0][0] == doctest::Approx(seen.unseen[0][1]).epsilon(1e-12));
  CHECK(std::abs(seen.unseen[0][2]) < 1e-12);
  MatrixX two(2, 2);
  two << 1, 1,  //
      0, 0.1;
  const Identifiability pair = identifiability(two, 0.01);
  const MatrixX covariance = 1e-4 * (two.transpose() * two).inverse();
  CHECK(pair.error[0] == doctest::Approx(std::sqrt(covariance(0, 0))).epsilon(1e-10));
  CHECK(pair.correlation(0, 1) == doctest::Approx(covariance(0, 1) / std::sqrt(covariance(0, 0) * covariance(1, 1))).epsilon(1e-10));
  CHECK(pair.unseen.empty());
}
