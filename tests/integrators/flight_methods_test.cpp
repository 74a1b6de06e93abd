// The time integration methods of event-split: amplification in closed form and as runs show it, order, yielding, stiffening.
#include <doctest/doctest.h>

#include <Eigen/LU>
#include <cmath>
#include <complex>

#include "integrators/generalized_alpha.hpp"
#include "integrators/mode_response.hpp"
#include "tests/integrators/oscillators.hpp"
#include "tests/integrators/runs.hpp"
#include "tests/verification/closed_forms.hpp"
#include "tests/verification/pair_of_masses.hpp"
#include "tests/verification/two_story_model.hpp"

using namespace nsframe;
using namespace nsframe::test;

namespace {

AnalysisOptions by_integrator(const std::string& integrator, double rho, double dt, double duration) {
  AnalysisOptions o = by_scheme("event-split", dt, duration);
  o.integrator = integrator;
  o.rho_infinity = rho;
  return o;
}

const std::vector<std::pair<std::string, double>> methods{{"generalized-alpha", 1}, {"generalized-alpha", 0.8}, {"generalized-alpha", 0},
                                                          {"alpha-os", 1},          {"alpha-os", 0.8},          {"alpha-os", 0.5}};

GeneralizedAlphaParameters parameters(const std::string& integrator, double rho) {
  return integrator == "alpha-os" ? GeneralizedAlphaParameters::hilber_hughes_taylor(rho) : GeneralizedAlphaParameters::chung_hulbert(rho);
}

void damp_all_modes(Scene& scene) {
  for (StructureDescription& structure : scene.model.structures) {
    structure.damping.named_ratios.clear();
    structure.damping.ratios.assign(30, 0.02);
  }
}

double slope_over(double coarse, double fine, double ratio) { return std::log(coarse / fine) / std::log(ratio); }

}  // namespace

TEST_CASE("generalized-alpha: the amplification of a mode solves the method's three equations") {
  const double h = 0.01;
  for (const auto& [integrator, rho] : methods) {
    const GeneralizedAlphaParameters p = parameters(integrator, rho);
    CHECK(p.gamma == doctest::Approx(0.5 - p.alpha_m + p.alpha_f));
    for (const double w : {1.0, 40.0, 900.0}) {
      const double c = 2 * 0.03 * w, k = w * w;
      Eigen::Matrix3d after, before;  // of q, v, a
      after << 1, 0, -h * h * p.beta, 0, 1, -h * p.gamma, (1 - p.alpha_f) * k, (1 - p.alpha_f) * c, 1 - p.alpha_m;
      before << 1, h, h * h * (0.5 - p.beta), 0, 1, h * (1 - p.gamma), -p.alpha_f * k, -p.alpha_f * c, -p.alpha_m;
      const Eigen::Vector3d scale(1, h, h * h);
      const Eigen::Matrix3d expected = scale.asDiagonal() * after.inverse() * before * scale.cwiseInverse().asDiagonal();
      CHECK((amplification(p, w, 0.03, h) - expected).cwiseAbs().maxCoeff() < 1e-11 * expected.cwiseAbs().maxCoeff());
    }
  }
}

TEST_CASE("generalized-alpha and alpha-OS: waves never grow, and shrink by rho_infinity far above what steps resolve") {
  for (const auto& [integrator, rho] : methods) {
    CAPTURE(integrator);
    CAPTURE(rho);
    const GeneralizedAlphaParameters p = parameters(integrator, rho);
    for (double z = 1e-3; z < 1e4; z *= 1.3) CHECK(spectral_radius(amplification(p, z, 0, 1)) < 1 + 1e-7);
    CHECK(spectral_radius(amplification(p, 1e6, 0, 1)) == doctest::Approx(rho).epsilon(1e-3).scale(1));
    CHECK(spectral_radius(amplification(p, 1e-3, 0, 1)) == doctest::Approx(1).epsilon(1e-6));
  }
}

TEST_CASE("event-split: free motion has the frequency and damping that the summary tells") {
  const double m = 1000, xi = 0.02, h = 0.01;
  for (const double w : {8.0, 60.0, 150.0}) {
    std::vector<AnalysisOptions> runs{by_scheme("event-split", h, 0.2), by_scheme("event-split", h, 0.2), by_scheme("moreau-jean", h, 0.2)};
    runs[1].theta = 0.7;
    runs[2].theta = 0.8;
    for (const auto& [integrator, rho] : methods) runs.push_back(by_integrator(integrator, rho, h, 0.2));
    for (const AnalysisOptions& o : runs) {
      CAPTURE(o.integrator);
      CAPTURE(o.rho_infinity);
      CAPTURE(w);
      const Run free = completed(linear_oscillator(m, m * w * w, xi, 0.01, 0.1), o);
      // displacements obey q_n+3 = x q_n+2 + y q_n+1 + z q_n; of the theta-method with z = 0
      const int terms = o.integrator == "theta" ? 2 : 3;
      const Eigen::Index rows = 12;
      MatrixX A(rows, terms);
      VectorX b(rows);
      const auto q = [&](Eigen::Index i) { return free.states[static_cast<std::size_t>(i)].displacement[0]; };
      for (Eigen::Index i = 0; i < rows; ++i) {
        b[i] = q(i + terms);
        for (int j = 0; j < terms; ++j) A(i, j) = q(i + terms - 1 - j);
      }
      if (terms == 3) {  // what the motion shows of the invariants
        const Eigen::Matrix3d step = amplification(parameters(o.integrator, o.rho_infinity), w, xi, h);
        const double second = 0.5 * (step.trace() * step.trace() - (step * step).trace());
        CHECK((b - A * Eigen::Vector3d(step.trace(), -second, step.determinant())).cwiseAbs().maxCoeff() < 1e-12);
        continue;
      }
      const VectorX x = (A.transpose() * A).ldlt().solve(A.transpose() * b);
      CHECK((b - A * x).cwiseAbs().maxCoeff() < 1e-12);
      const std::complex<double> root = 0.5 * (x[0] + std::sqrt(std::complex<double>(x[0] * x[0] + 4 * x[1], 0)));
      const std::complex<double> exponent = std::log(root) / h;
      Simulation simulation(build(linear_oscillator(m, m * w * w, xi)), o);
      const Scheme::ModeResponse told = simulation.scheme().mode_response(w, xi, h);
      CHECK(told.circular_frequency == doctest::Approx(std::abs(exponent)).epsilon(1e-7));
      CHECK(told.damping_ratio == doctest::Approx(-exponent.real() / std::abs(exponent)).epsilon(1e-6));
    }
  }
}

TEST_CASE("generalized-alpha: damping and period of resolved modes as its series in w h tells") {
  // undamped, z = w h << 1: |lambda| = 1 - (1 - rho)^3 z^4 / (8 (1 + rho)^3 ...) is of third order in the damping ratio; the period error of
  // second order: 1/12 for rho = 1, the trapezoidal rule
  const auto told = [](double rho, double z) { return generalized_alpha_response(GeneralizedAlphaParameters::chung_hulbert(rho), z, 0, 1); };
  CHECK(std::abs(told(1, 0.1).damping_ratio) < 1e-12);
  CHECK(1 - told(1, 0.1).circular_frequency / 0.1 == doctest::Approx(0.01 / 12).epsilon(0.01));
  for (const double rho : {0.0, 0.5, 0.8}) {
    CHECK(told(rho, 0.1).damping_ratio > 0);
    CHECK(slope_over(told(rho, 0.1).damping_ratio, told(rho, 0.05).damping_ratio, 2) == doctest::Approx(3).epsilon(0.03));
    CHECK(slope_over(0.1 - told(rho, 0.1).circular_frequency, 0.05 - told(rho, 0.05).circular_frequency, 2) == doctest::Approx(3).epsilon(0.03));
  }
}

TEST_CASE("event-split: every method is of second order across the impacts of the pull-back pair") {
  for (const auto& [integrator, rho] : methods) {
    CAPTURE(integrator);
    CAPTURE(rho);
    std::vector<double> errors;
    for (const double dt : {1e-3, 1e-4}) {
      const Run result = completed(pull_back(0.6, 0.005), by_integrator(integrator, rho, dt, 2));
      CHECK(result.summary.impacts.size() == 3);
      CHECK(result.summary.integrator == integrator);
      double error = 0;
      for (const State& state : result.states) {
        for (int k = 0; k < 2; ++k) error = std::max(error, std::abs(state.displacement[k] - pull_back_exact(state.time)[static_cast<std::size_t>(k)]));
      }
      errors.push_back(error);
    }
    CHECK(errors[0] < 4e-4);
    CHECK(slope_over(errors[0], errors[1], 10) > 1.8);
  }
}

TEST_CASE("event-split: generalized-alpha and alpha-OS on yielding masses and fiber members that hit each other, of second order") {
  const ModelDescription masses = yielding_masses(Steel01{8e3, 2e6, 0.05});
  const auto slope = [](const ModelDescription& d, double dt, double duration, double most) {
    const Run fine = completed(d, by_scheme("exponential", dt / 32, duration));
    REQUIRE_FALSE(fine.summary.impacts.empty());
    for (const char* integrator : {"generalized-alpha", "alpha-os"}) {
      CAPTURE(integrator);
      std::vector<double> errors;
      for (const int parts : {1, 8}) {
        const Run ours = completed(d, by_integrator(integrator, 0.8, dt / parts, duration));
        errors.push_back(difference(ours, fine));
        CHECK(ours.summary.max_penetration < 1e-9);
        CHECK(ours.summary.stiffened_steps == 0);
        if (integrator == std::string("alpha-os")) {
          CHECK(ours.summary.newton_iterations < 10 + ours.summary.steps / 20);  // of parts, near contact
          CHECK(ours.summary.factorizations < 4 + ours.summary.steps / 6);  // two, and the looks at the tangent
        }
      }
      CAPTURE(errors[0]);
      CAPTURE(errors[1]);
      CHECK(errors[0] < most);
      CHECK(slope_over(errors[0], errors[1], 8) > 1.8);
    }
  };
  slope(masses, 8e-4, 0.4, 1e-4);
  slope(fiber_pair(Steel02{235e6, 210e9, 0.02}, ElementKind::displacement_beam, 4), 4e-4, 0.1, 2e-4);
  slope(fiber_pair(Steel02{235e6, 210e9, 0.02}, ElementKind::force_beam, 4), 4e-4, 0.1, 2e-4);
}

TEST_CASE("event-split: second order over the first pounding of the two-story pair, elastic with all modes damped, and closer than Moreau-Jean") {
  Scene scene = example_scene("two_story_elastic");
  damp_all_modes(scene);
  const Model model = model_of(scene);
  const auto at_end = [&](AnalysisOptions o) {
    o.duration = 2.6;
    o.gamma = 0.5;
    Simulation simulation(model, o);
    CHECK(simulation.run({}).impacts.size() > 3);
    return simulation.state().displacement;
  };
  const VectorX exact = at_end(by_scheme("exact", 1e-3, 0));
  const auto error = [&](const AnalysisOptions& o) { return (at_end(o) - exact).cwiseAbs().maxCoeff(); };
  CHECK(error(by_scheme("event-split", 1e-3, 0)) < 0.2 * error(by_scheme("moreau-jean", 1e-3, 0)));
  for (const char* integrator : {"theta", "generalized-alpha"}) {
    const double coarse = error(by_integrator(integrator, 0.8, 1e-4, 0)), fine = error(by_integrator(integrator, 0.8, 2.5e-5, 0));
    CAPTURE(coarse);
    CAPTURE(fine);
    CHECK(coarse < 3e-5);
    CHECK(slope_over(coarse, fine, 4) > 1.8);
  }
}

TEST_CASE("the two-story pair multiplies a change of its gaps a thousandfold in 6 s where only its named modes are damped, not where all are") {
  const auto growth = [](bool all_damped, double change) {
    const auto at_end = [&](double more) {
      Scene scene = example_scene("two_story_elastic");
      if (all_damped) damp_all_modes(scene);
      for (double& gap : scene.model.contacts[0].gap) gap += more;
      const Model model = model_of(scene);
      Simulation simulation(model, by_scheme("exact", 5e-3, 6));
      CHECK(simulation.run({}).completed);
      return simulation.state().displacement;
    };
    return (at_end(change) - at_end(0)).cwiseAbs().maxCoeff() / change;
  };
  const double paper = growth(false, 1e-10);
  CHECK(paper > 300);
  CHECK(paper < 3000);
  CHECK(growth(false, 1e-8) == doctest::Approx(paper).epsilon(0.1));  // no chaos: the same factor whatever the change
  CHECK(growth(true, 1e-10) < 10);
}

TEST_CASE("alpha-OS: where members stiffen too far it goes on by its implicit form, and says so") {
  // a soft spring, and a stop sixty times as stiff once a gap of 1 cm has closed: h^2 (k_t - k_0) / m = 9.6
  ModelDescription d = nonlinear_oscillator(1000, ElasticPPGap{6e5, 6e8, 0.01}, 0, 0.3);
  d.structures[0].springs.push_back(ground_spring("soft", "1", 1e4 * Vector6::Unit(0)));
  const double dt = 0.126;
  ModelDescription small = d;
  const Run guarded = completed(d, by_integrator("alpha-os", 0.8, dt, 60));
  CHECK(guarded.summary.stiffened_steps > 0);
  double peak = 0;
  for (const State& state : guarded.states) peak = std::max(peak, std::abs(state.displacement[0]));
  CHECK(peak < 0.11);  // v / w of the soft spring alone: 0.095
  const Run fine = completed(small, by_integrator("alpha-os", 0.8, 1e-3, 4));
  CHECK(fine.summary.stiffened_steps == 0);  // h^2 (k_t - k_0) / m = 6e-4
  const Run finer = completed(small, by_integrator("generalized-alpha", 0.8, 2.5e-4, 4));
  CHECK(difference(fine, finer) < 1e-4);
}

TEST_CASE("event-split: a pair at a point without mass that yields is met where it is, and shorter steps converge") {
  // a mass on a spring carries a point without mass that a yielding spring holds: the point runs ahead of what its stiffness at rest tells
  ModelDescription d = nonlinear_oscillator(1000, Steel01{2e3, 1e6, 0.01}, 0, 0.6);
  StructureDescription& s = d.structures[0];
  s.springs[0].node_i = {"2", {}};
  s.nodes.push_back(node("2", 0, 0, 0));
  s.supports.push_back(fixed("2", {false, true, true, true, true, true}));
  s.springs.push_back(ground_spring("link", "1", 1e6 * Vector6::Unit(0)));
  s.springs.back().node_j = Reference{"2", {}};
  s.springs.push_back(ground_spring("soft", "1", 1e4 * Vector6::Unit(0)));
  d.contacts = {wall("s.2", 0.02, 0.5)};
  AnalysisOptions whole = by_integrator("theta", 0.8, 0.02, 0.4);
  whole.max_halvings = 0;
  CHECK(completed(d, whole).summary.max_penetration < 1e-12);
  const Run fine = completed(d, by_integrator("theta", 0.8, 1.25e-5, 0.4));
  std::vector<double> errors;
  for (const double dt : {4e-4, 1e-4}) errors.push_back(difference(completed(d, by_integrator("theta", 0.8, dt, 0.4)), fine));
  CHECK(fine.summary.max_penetration < 1e-12);
  CHECK(errors[0] < 4e-6);
  CHECK(slope_over(errors[0], errors[1], 4) > 1.8);
}

TEST_CASE("event-split: a run by each method that goes on from a snapshot has the same bits") {
  const Model model = build(fiber_pair(Steel02{235e6, 210e9, 0.02}, ElementKind::displacement_beam, 4));
  for (const char* integrator : {"generalized-alpha", "alpha-os"}) {
    for (const int stop_at : {3, 43}) check_resumed(model, by_integrator(integrator, 0.8, 1e-3, 0.1), stop_at);
  }
}

TEST_CASE("event-split: integrators and their parameters are refused by name") {
  const ModelDescription d = row({{1, 100, 0}});
  CHECK_THROWS_WITH_AS(run(d, by_integrator("generalised-alpha", 0.8, 1e-3, 0.1)), doctest::Contains("generalized-alpha"), InputError);
  CHECK_THROWS_WITH_AS(run(d, by_integrator("alpha-os", 0.3, 1e-3, 0.1)), doctest::Contains("[0.5, 1]"), InputError);
  CHECK_THROWS_WITH_AS(run(d, by_integrator("generalized-alpha", 1.2, 1e-3, 0.1)), doctest::Contains("[0, 1]"), InputError);
}
