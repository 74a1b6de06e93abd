// Fits whose result is known: in closed form, from frequencies made with known parameters, or by another method.
#include "calibration/least_squares.hpp"
#include "calibration/report.hpp"
#include "problems.hpp"

using namespace nsframe;
using namespace nsframe::test;

namespace {

bool says(const Calibration& calibration, const std::string& words) {
  for (const std::string& remark : calibration_remarks(calibration))
    if (remark.find(words) != std::string::npos) return true;
  return false;
}

CalibrationProblem oscillator(double measured, double lower, double upper) {
  CalibrationProblem problem;
  problem.parameters = {{"k", 2e6, lower, upper, "N/m", "the spring"}};
  problem.targets = {{{}, "a", "L1", measured, 1, {}}};
  problem.model = [](const VectorX& p) { return masses_on_springs({p[0]}); };
  return problem;
}

}  // namespace

TEST_CASE("the stiffness of an oscillator follows from its frequency, and stops at a bound that it would pass") {
  const double k = stiffness_of(10);
  const Calibration free = calibrate(oscillator(10, 1e5, 1e8));
  CHECK(free.converged);
  CHECK(free.parameters[0].fitted == doctest::Approx(k).epsilon(1e-8));
  CHECK(free.parameters[0].bound == Bound::none);
  CHECK(free.frequencies[0].start == doctest::Approx(frequency_of(2e6)).epsilon(1e-10));
  CHECK(free.parameters[0].error == doctest::Approx(0.02).epsilon(1e-8));  // 1 % in f is 2 % in k
  const Calibration held = calibrate(oscillator(10, 1e5, 3e6));
  CHECK(held.converged);
  CHECK(held.parameters[0].fitted == 3e6);
  CHECK(held.parameters[0].bound == Bound::upper);
  CHECK(held.frequencies[0].fitted == doctest::Approx(frequency_of(3e6)).epsilon(1e-10));
  CHECK(says(held, "'k' stopped at its upper bound, 3e+06 N/m: the frequencies ask for more"));
  CHECK(says(held, "L1 of 'a' stays"));
}

TEST_CASE("parameters behind made frequencies are found again") {
  const Scene scene = calibration_scene();
  for (const std::string structure : {"left", "right"}) {
    CAPTURE(structure);
    CalibrationProblem problem = example_problem(scene, structure);
    if (structure == "right") {  // seven parameters, six frequencies: the base is known
      problem.parameters[2].lower = 1.4999e7;
      problem.parameters[2].upper = 1.5001e7;
      problem.parameters[2].start = 1.5e7;
    }
    VectorX truth = starts(problem);
    for (Eigen::Index j = 0; j < truth.size(); ++j) truth[j] *= 1 + 0.3 * std::sin(2.0 * static_cast<double>(j) + 1);
    if (structure == "right") truth[2] = 1.5e7;
    const VectorX f = frequencies(problem, truth);
    for (std::size_t i = 0; i < problem.targets.size(); ++i) problem.targets[i].frequency = f[static_cast<Eigen::Index>(i)];
    const Calibration fit = calibrate(problem);
    CHECK(fit.converged);
    for (const FittedFrequency& one : fit.frequencies) CHECK(std::abs(one.difference()) < 1e-8);
    if (structure == "left") CHECK((fit.values().array() / truth.array() - 1).abs().maxCoeff() < 1e-5);
  }
}

TEST_CASE("six parameters of the left frame end at the same values from another start, by damped steps on differences of frequencies") {
  const CalibrationProblem problem = example_problem(calibration_scene(), "left");
  const Calibration fit = calibrate(problem);
  REQUIRE(fit.converged);
  const auto residual = [&](const VectorX& at) {
    VectorX r = frequencies(problem, at.array().exp().matrix());
    for (std::size_t i = 0; i < problem.targets.size(); ++i)
      r[static_cast<Eigen::Index>(i)] = std::log(r[static_cast<Eigen::Index>(i)] / problem.targets[i].frequency);
    return r;
  };
  VectorX x = starts(problem).array().log() + 0.3;
  VectorX r = residual(x);
  double damping = 1e-2, change = 1;
  for (int iteration = 0; iteration < 150 && change > 1e-7; ++iteration) {
    MatrixX J(r.size(), x.size());
    for (Eigen::Index j = 0; j < x.size(); ++j) {
      VectorX high = x, low = x;
      high[j] += 1e-4;
      low[j] -= 1e-4;
      J.col(j) = (residual(high) - residual(low)) / 2e-4;
    }
    for (bool better = false; !better && damping < 1e6;) {
      MatrixX A = J.transpose() * J;
      A.diagonal() *= 1 + damping;
      const VectorX g = J.transpose() * r, step = -A.llt().solve(g), tried = residual(x + step);
      better = tried.norm() < r.norm();
      damping *= better ? 0.2 : 4;
      if (!better) continue;
      change = step.norm();
      x += step;
      r = tried;
    }
    if (damping >= 1e6) break;
  }
  // L1 and L2 cannot quite be reached together: at the least beams and base can be exchanged to first order, and it is flat there
  VectorX difference = (fit.values().array().log() - x.array()).abs();
  CHECK(difference.head(2).maxCoeff() < 2e-3);
  CHECK(difference.tail(4).maxCoeff() < 1e-4);
  const VectorX frequency = frequencies(problem, x.array().exp().matrix());
  for (Eigen::Index i = 0; i < 6; ++i)
    CHECK(fit.frequencies[static_cast<std::size_t>(i)].fitted == doctest::Approx(frequency[i]).epsilon(1e-6));
}

TEST_CASE("from round numbers both frames reach Table 7 of the paper within 1 percent, twelve frequencies of twelve") {
  const Scene scene = calibration_scene();
  const std::array<std::array<double, 6>, 2> measured{{{2.10, 5.60, 6.10, 17.5, 8.60, 24.4}, {3.70, 10.4, 8.20, 25.2, 10.1, 28.0}}};
  const std::array<std::array<double, 6>, 2> model{{{2.10, 5.60, 6.11, 17.5, 8.60, 24.4}, {3.69, 10.4, 8.20, 25.2, 10.2, 28.0}}};
  for (std::size_t s = 0; s < 2; ++s) {
    const Calibration fit = calibrate(example_problem(scene, s == 0 ? "left" : "right"));
    CHECK(fit.converged);
    REQUIRE(fit.frequencies.size() == 6);
    double start = 0;
    for (std::size_t i = 0; i < 6; ++i) {
      CAPTURE(fit.frequencies[i].mode);
      CHECK(fit.frequencies[i].measured == measured[s][i]);
      CHECK(std::abs(fit.frequencies[i].fitted / measured[s][i] - 1) < 0.01);
      CHECK(std::abs(fit.frequencies[i].fitted / model[s][i] - 1) < 0.01);
      start = std::max(start, std::abs(fit.frequencies[i].start / measured[s][i] - 1));
    }
    CHECK(start > 0.05);  // it was not there before
  }
}

TEST_CASE("with one second moment for the beams of both floors the right frame's L2 stays 1.3 percent off, which the report says") {
  const Scene scene = calibration_scene();
  CalibrationProblem problem = example_problem(scene, "right");
  Diagnostics diagnostics;
  std::vector<SceneParameter> parameters = calibration_parameters(scene, diagnostics);
  std::erase_if(parameters, [](const SceneParameter& p) { return p.name.find("_r") == std::string::npos || p.name == "beam_r2"; });
  REQUIRE(parameters.front().name == "beam_r1");
  parameters.front().keys.push_back("section.beam_right_2.Iz");
  problem.parameters.erase(problem.parameters.begin() + 1);
  problem.model = ParametricModel(scene, parameters);
  const Calibration fit = calibrate(problem);
  CHECK(fit.converged);
  // the least that scipy's least_squares finds on differences of `nsframe modes`, from two starts
  CHECK(fit.frequencies[0].difference() == doctest::Approx(-0.00541).epsilon(0.01));
  CHECK(fit.frequencies[1].difference() == doctest::Approx(0.01301).epsilon(0.01));
  CHECK(fit.parameters[0].fitted == doctest::Approx(6.5555e-5).epsilon(0.01));
  CHECK(says(fit, "L2 of 'right' stays +1.30 % off"));
}

TEST_CASE("fitted to the paper's own model, the left frame gets the parameters that OpenSees was calibrated to") {
  CalibrationProblem problem = example_problem(calibration_scene(), "left");
  problem.targets[2].frequency = 6.11;
  const Calibration fit = calibrate(problem);
  REQUIRE(fit.converged);
  Diagnostics diagnostics;
  const Scene calibrated = read_scene(std::string(NSFRAME_SOURCE_DIR) + "/examples/two_story_elastic/scene.toml", {}, diagnostics);
  const auto& frame = std::get<StoryFrameTable>(calibrated.tables.structures[0]).frame;
  const std::array<double, 6> known{std::get<ConstantsSection>(calibrated.tables.sections[2].kind).constants.Iz,
                                    frame.base.stiffness,
                                    frame.braces->area[0],
                                    frame.braces->area[1],
                                    frame.mass.centre_inertia[0],
                                    frame.mass.centre_inertia[1]};
  for (std::size_t j = 0; j < 6; ++j) {
    CAPTURE(fit.parameters[j].parameter.name);
    CHECK(fit.parameters[j].fitted == doctest::Approx(known[j]).epsilon(0.01));
  }
}

TEST_CASE("stiffness and mass of one oscillator cannot be told apart, and a spring elsewhere not at all") {
  CalibrationProblem problem = oscillator(10, 1e5, 1e8);
  problem.parameters.push_back({"m", 1000, 100, 1e4, "kg", ""});
  problem.parameters.push_back({"other", 1e6, 1e5, 1e7, "N/m", ""});
  problem.model = [](const VectorX& p) {
    ModelDescription d = masses_on_springs({p[0]});
    d.structures[0].masses[0] = mass("1", p[1]);
    d.structures.push_back(masses_on_springs({p[2]}).structures[0]);
    d.structures[1].name = "b";
    return d;
  };
  const Calibration fit = calibrate(problem);
  CHECK(fit.converged);
  CHECK(fit.parameters[0].fitted / fit.parameters[1].fitted == doctest::Approx(stiffness_of(10, 1)).epsilon(1e-8));
  CHECK(fit.parameters[2].fitted == doctest::Approx(1e6).epsilon(1e-12));
  for (const FittedParameter& p : fit.parameters) CHECK(std::isinf(p.error));
  CHECK(says(fit, "3 parameters cannot all follow from 1 measured frequency"));
  CHECK(says(fit, "'other' cannot be identified: no measured frequency depends on it"));
  CHECK(says(fit, "cannot be identified one by one: to first order 'k' +10.0 %, 'm' +10.0 % together change no measured frequency"));
}

TEST_CASE("modes that cross on the way are followed by their shapes") {
  // two masses, weakly coupled: the first is the slower one at the start, and the faster one in the measurement
  const double coupling = 500;
  const auto model = [=](const VectorX& p) { return masses_on_springs({p[0], p[1]}, coupling); };
  CalibrationProblem problem;
  problem.parameters = {{"first", 1e6, 1e5, 1e8, "N/m", ""}, {"second", 2e6, 1e5, 1e8, "N/m", ""}};
  problem.targets = {{{}, "a", "", 6, 1, {{"1", 0, 1}, {"2", 0, 0.01}}}, {{}, "a", "", 5, 1, {{"1", 0, -0.01}, {"2", 0, 1}}}};
  problem.model = model;
  const Calibration fit = calibrate(problem);
  CHECK(fit.converged);
  CHECK(fit.frequencies[0].mode == "L1");
  CHECK(fit.frequencies[0].name == "L2");
  CHECK(says(fit, "the mode followed as L1 of 'a' is called L2 at the fit"));
  // two frequencies of two coupled masses in closed form: sum and product of the eigenvalues
  const double a = stiffness_of(6), b = stiffness_of(5), sum = a + b - 2 * coupling, product = a * b + coupling * coupling;
  const double A = fit.parameters[0].fitted + coupling, B = fit.parameters[1].fitted + coupling;
  CHECK(A + B == doctest::Approx(sum + 2 * coupling).epsilon(1e-8));
  CHECK(A * B == doctest::Approx(product).epsilon(1e-8));
  CHECK(A > B);
  // the same frequencies by their names only: then the first stays the slower one
  problem.targets = {{{}, "a", "L2", 6, 1, {}}, {{}, "a", "L1", 5, 1, {}}};
  const Calibration named = calibrate(problem);
  CHECK(named.converged);
  CHECK(named.parameters[0].fitted < named.parameters[1].fitted);
  CHECK(named.parameters[0].fitted == doctest::Approx(fit.parameters[1].fitted).epsilon(1e-7));
}

TEST_CASE("a name that means another mode at the fit is fitted again with that mode") {
  // the first mass is the slower one at the start; made faster than the second it is L2, and L1 is out of the spring's reach
  CalibrationProblem problem = oscillator(6, 1e5, 1e8);
  problem.parameters[0].start = stiffness_of(4);
  problem.model = [](const VectorX& p) { return masses_on_springs({p[0], stiffness_of(5)}, 500); };
  const Calibration fit = calibrate(problem);
  CHECK(fit.identifications >= 2);
  CHECK(fit.frequencies[0].name == "L1");
  CHECK(fit.frequencies[0].fitted < 5.01);
  CHECK(says(fit, "L1 of 'a' stays"));
}

TEST_CASE("equal frequencies along x and y are told apart by direction, and fitted to different ones") {
  CalibrationProblem problem;
  problem.parameters = {{"x", 1e6, 1e4, 1e8, "N/m", ""}, {"y", 1e6, 1e4, 1e8, "N/m", ""}};
  problem.targets = {{{}, "a", "T1", 6, 1, {}}, {{}, "a", "L1", 5, 1, {}}};
  problem.model = [](const VectorX& p) {
    // springs at 45 degrees, equal but for rounding: where the others are equal too, the solver finds shapes of any direction
    ModelDescription d = masses_on_springs({p[0]}, 0, p[1]);
    d.structures[0].springs.push_back(ground_spring("turned", "1", 5e5 * Vector6::Unit(0) + 5e5 * Vector6::Unit(1)));
    d.structures[0].springs.back().x = Vector3(1, 1, 0).normalized();
    d.structures[0].springs.back().in_plane = Vector3(-1, 1, 0).normalized();
    return d;
  };
  const Calibration fit = calibrate(problem);
  CHECK(fit.converged);
  CHECK(fit.parameters[0].fitted + 5e5 == doctest::Approx(stiffness_of(5)).epsilon(1e-8));
  CHECK(fit.parameters[1].fitted + 5e5 == doctest::Approx(stiffness_of(6)).epsilon(1e-8));
  // a mixture of both is turned apart again
  RestingModel resting = resting_model(problem.model(starts(problem)));
  resting.structures[0].stiffness.coeffRef(0, 1) += 1e-3;  // of 1.5e6 N/m: shapes at 45 degrees, frequencies equal to 1e-9
  resting.structures[0].stiffness.coeffRef(1, 0) += 1e-3;
  CHECK(solve_modes(resting.structures[0].stiffness, resting.structures[0].mass, 2).shape.cwiseAbs().minCoeff() > 0.01);
  const Modes modes = separated_modes(resting, 0, 2);
  for (int i = 0; i < 2; ++i) CHECK(modes.shape.col(i).cwiseAbs().minCoeff() < 1e-8 * modes.shape.col(i).cwiseAbs().maxCoeff());
  MatrixX reference(2, 1);
  reference << 0.6, 0.8;
  const Modes aligned = aligned_modes(resting, 0, 2, reference);
  CHECK(modal_assurance(aligned.shape.col(0), reference.col(0)) == doctest::Approx(1).epsilon(1e-12));
  CHECK(std::abs(aligned.shape.col(0).dot(resting.structures[0].mass * aligned.shape.col(1))) < 1e-12);
}

TEST_CASE("a measured shape that no mode has is left out, said, and no success") {
  CalibrationProblem problem = oscillator(10, 1e5, 1e8);
  problem.model = [](const VectorX& p) { return masses_on_springs({p[0], 5e6}, 10); };
  problem.targets.push_back({{}, "a", "", 20, 1, {{"1", 0, 1}, {"2", 0, 0.3}}});
  const Calibration fit = calibrate(problem);
  CHECK_FALSE(fit.converged);
  CHECK(fit.reason.find("no mode has a shape like the measured one of 20 Hz of 'a'") == 0);
  CHECK_FALSE(fit.frequencies[1].matched);
  CHECK(fit.frequencies[0].fitted == doctest::Approx(10).epsilon(1e-8));
  CHECK(says(fit, "unmatched: no mode of 'a' has a shape like the one measured at 20 Hz"));
}

TEST_CASE("too few iterations are no success, and an unknown mode is an error at its place") {
  CalibrationProblem problem = oscillator(40, 1e5, 1e8);
  problem.max_iterations = 1;
  const Calibration fit = calibrate(problem);
  CHECK_FALSE(fit.converged);
  CHECK(fit.reason == "no least squares after 1 iteration");
  problem.targets[0].mode = "L2";
  problem.targets[0].at = at(7);
  CHECK_THROWS_WITH_AS(calibrate(problem), "s.toml:7:3: error: structure 'a' has no mode 'L2' among its 1 modes; did you mean 'L1'?",
                       InputError);
}

TEST_CASE("least squares with bounds end where the gradient allows no more, and step around points without value") {
  // the corner of Rosenbrock's valley x0 <= 0.5: there x1 = x0^2
  LeastSquaresProblem problem;
  int refused = 0;
  problem.value = [&](const VectorX& x) -> std::optional<VectorX> {
    if (x[1] > 0.6 && x[0] < 0) {
      ++refused;
      return std::nullopt;
    }
    return Vector2(10 * (x[1] - x[0] * x[0]), 1 - x[0]);
  };
  problem.jacobian = [](const VectorX& x) {
    MatrixX J(2, 2);
    J << -20 * x[0], 10, -1, 0;
    return J;
  };
  problem.lower = Vector2(-2, -2);
  problem.upper = Vector2(0.5, 2);
  LeastSquaresOptions options;
  options.max_iterations = 200;
  const LeastSquaresResult held = solve_least_squares(problem, Vector2(-0.7, 0.55), options);
  CHECK(held.converged);
  CHECK(held.x[0] == 0.5);
  CHECK(held.x[1] == doctest::Approx(0.25).epsilon(1e-7));
  problem.upper[0] = 2;
  const LeastSquaresResult free = solve_least_squares(problem, Vector2(-0.7, 0.55), options);
  CHECK(free.converged);
  CHECK((free.x - Vector2(1, 1)).norm() < 1e-8);
}
