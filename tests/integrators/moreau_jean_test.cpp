// The theta scheme: order, numerical damping, energy balance, failing steps, threads, and its known limits in contact.
#include <doctest/doctest.h>

#include <cmath>

#include "base/decompositions.hpp"
#include "integrators/moreau_jean.hpp"
#include "tests/integrators/oscillators.hpp"
#include "tests/support/numbers.hpp"

using namespace nsframe;
using namespace nsframe::test;

namespace {

// Chopra's examples 5.3 to 5.6: half a sine of 10 kip over 0.6 s in steps of 0.1 s, as base acceleration.
ModelDescription with_half_sine(ModelDescription d, double m) {
  MotionDescription motion;
  motion.dt = 0.1;
  for (int i = 0; i <= 10; ++i) motion.acceleration.push_back(i < 6 ? -10 * std::sin(pi * i / 6) / m : 0);
  d.motions = {motion};
  return d;
}

// Largest error of displacement in the free vibration of a damped oscillator over 1 s.
double free_vibration_error(double theta, double dt) {
  const double m = 2, k = 200, xi = 0.03, w = std::sqrt(k / m), a = xi * w, wd = w * std::sqrt(1 - xi * xi);
  const Run result = run(linear_oscillator(m, k, xi, 0.1, 0.5), options(theta, dt, 1));
  double error = 0;
  for (const State& state : result.states) {
    const double t = state.time;
    const double exact = std::exp(-a * t) * (0.1 * std::cos(wd * t) + (0.5 + a * 0.1) / wd * std::sin(wd * t));
    error = std::max(error, std::abs(state.displacement[0] - exact));
  }
  return error;
}

}  // namespace

TEST_CASE("with theta = 1/2 an oscillator under half a sine has Chopra's displacements by average acceleration") {
  const double m = 0.2533;
  const Run result = run(with_half_sine(linear_oscillator(m, 10, 0.05), m), options(0.5, 0.1, 1));
  const std::array<double, 6> chopra{0.0437, 0.2326, 0.6121, 1.0825, 1.4309, 1.4231};  // four decimals printed
  for (std::size_t i = 0; i < 6; ++i) CHECK(std::abs(result.states[i + 1].displacement[0] - chopra[i]) < 1.5e-4);
}

TEST_CASE("with theta = 1/2 an elastoplastic oscillator has Chopra's displacements by average acceleration") {
  const double m = 0.2533;
  ModelDescription d = nonlinear_oscillator(m, ElasticPP{10, 0.75});
  d.structures[0].springs[0].damping[0] = 2 * 0.05 * std::sqrt(10 * m);
  const Run result = run(with_half_sine(d, m), options(0.5, 0.1, 1));
  const std::array<double, 9> chopra{0.0437, 0.2326, 0.6121, 1.1143, 1.6214, 1.9891, 2.0951, 1.9240, 1.5602};
  for (std::size_t i = 0; i < 9; ++i) CHECK(std::abs(result.states[i + 1].displacement[0] - chopra[i]) < 2e-4);
}

TEST_CASE("in smooth motion theta = 1/2 is second order and theta = 1 first order") {
  CHECK(std::log2(free_vibration_error(0.5, 4e-3) / free_vibration_error(0.5, 2e-3)) == doctest::Approx(2).epsilon(0.02));
  CHECK(std::log2(free_vibration_error(0.5, 2e-3) / free_vibration_error(0.5, 1e-3)) == doctest::Approx(2).epsilon(0.02));
  CHECK(std::log2(free_vibration_error(1, 4e-4) / free_vibration_error(1, 2e-4)) == doctest::Approx(1).epsilon(0.03));
  CHECK(free_vibration_error(0.5, 1e-3) < 1e-2 * free_vibration_error(1, 1e-3));
}

TEST_CASE("the scheme's damping ratio and frequency of a mode are those of its free vibration") {
  for (const double theta : {0.5, 0.6, 0.75, 1.0}) {
    for (const double h : {1e-3, 1e-2, 0.1}) {
      for (const double xi : {0.0, 0.02, 0.3}) {
        CAPTURE(theta);
        CAPTURE(h);
        CAPTURE(xi);
        const double w = 25;
        const ModelDescription d = linear_oscillator(1, w * w, xi, 0.1, 0.2);
        const Run result = run(d, options(theta, h, 40 * h));
        // q(n+2) = trace q(n+1) - determinant q(n), from all steps
        MatrixX A(38, 2);
        VectorX b(38);
        for (int n = 0; n < 38; ++n) {
          const auto q = [&](int i) { return result.states[static_cast<std::size_t>(n + i)].displacement[0]; };
          A.row(n) << q(1), -q(0);
          b[n] = q(2);
        }
        const VectorX fit = A.colPivHouseholderQr().solve(b);
        const double alpha = -0.5 * std::log(fit[1]), beta = std::acos(0.5 * fit[0] / std::sqrt(fit[1]));
        const Model model = build(d);
        const System system(model, 1);
        const auto response = MoreauJean(options(theta, h, 1), system).mode_response(w, xi, h);
        // rounding of the samples, times the conditioning (w h)^-2 of the fit
        const double rounding = 1e3 * epsilon / std::min(1.0, w * w * h * h);
        CHECK(response.circular_frequency == doctest::Approx(std::hypot(alpha, beta) / h).epsilon(rounding));
        CHECK(std::abs(response.damping_ratio - alpha / std::hypot(alpha, beta)) < rounding);
      }
    }
  }
}

TEST_CASE("the energy of a linear pounding balances to rounding, whatever theta") {
  for (const double theta : {0.5, 0.7, 1.0}) {
    ModelDescription d = linear_oscillator(4600, 2.11e6, 0.005, -0.024);
    d.contacts = {wall("s.1", 0.01, 0.6)};
    const Run result = run(d, options(theta, 1e-3, 1));
    CHECK(result.summary.impacts.size() >= 3);
    CHECK(result.summary.worst_balance_error < 1e4 * epsilon);  // a thousand steps
    CHECK(result.summary.energy.contact > 0);
    CHECK(result.summary.factorizations == 1);
  }
}

TEST_CASE("two free masses lose (1 - e^2)/2 of their reduced mass times the squared approach velocity") {
  for (const double theta : {0.5, 1.0}) {
    const ModelDescription d = two_free_masses(0.4);
    const Run result = run(d, options(theta, 1e-3, 0.2));
    REQUIRE(result.summary.impacts.size() == 1);
    CHECK(result.summary.energy.contact == doctest::Approx(0.5 * 1.2 * (1 - 0.16) * 2.25).epsilon(256 * epsilon));
    CHECK(result.summary.impacts[0].impulse == doctest::Approx(1.2 * 1.4 * 1.5).epsilon(256 * epsilon));
  }
}

TEST_CASE("the energy of a yielding fiber frame in pounding balances to the tolerance of the iterations") {
  for (const ElementKind kind : {ElementKind::displacement_beam, ElementKind::force_beam}) {
    AnalysisOptions o = options(0.5, 1e-3, 0.25);
    o.newton_tolerance = 1e-11;
    const Run result = run(fiber_pair(Steel02{235e6, 210e9, 0.01}, kind, 3), o);
    CHECK(result.summary.completed);
    CHECK(result.summary.impacts.size() > 0);
    CHECK(result.summary.energy.strain > 0);
    CHECK(result.summary.worst_balance_error < 1e-9);  // 250 steps of 1e-11
  }
}

TEST_CASE("a run gives the same bits with one thread and with two") {
  const ModelDescription d = fiber_pair(Steel02{235e6, 210e9, 0.01}, ElementKind::force_beam, 3, Geometry::p_delta);
  AnalysisOptions o = options(1, 1e-3, 0.15);
  const Run one = run(d, o);
  o.threads = 2;
  const Run two = run(d, o);
  CHECK(one.summary.impacts.size() > 0);
  CHECK(one.summary.impacts.size() == two.summary.impacts.size());
  CHECK(one.states.back().displacement == two.states.back().displacement);
  CHECK(one.states.back().velocity == two.states.back().velocity);
  CHECK(one.states.back().history == two.states.back().history);
}

TEST_CASE("a step that Newton cannot do at once is halved, and the run goes on") {
  AnalysisOptions o = options(1, 0.02, 0.4);
  o.max_newton = 4;
  o.algorithm = {"newton"};
  const ModelDescription d = nonlinear_oscillator(100, Steel02{1e4, 1e6, 0.01}, 0, 4);
  const Run result = run(d, o);
  CHECK(result.summary.completed);
  CHECK(result.summary.halved_steps > 0);
  CHECK(result.summary.steps == 20);
  CHECK(result.states.back().time == doctest::Approx(0.4).epsilon(4 * epsilon));
  CHECK(result.summary.worst_balance_error < 1e-6);  // newton_tolerance 1e-8 over some dozens of steps
}

TEST_CASE("a step that no halving helps ends the run: time and element are named, what was computed is kept") {
  AnalysisOptions o = options(1, 1e-3, 0.2);
  o.max_newton = 1;
  o.algorithm = {"newton"};
  o.max_halvings = 2;
  o.newton_tolerance = 1e-12;
  const ModelDescription d = nonlinear_oscillator(100, Steel01{1000, 1e5, 0.01}, 0, 1);  // yields at 0.01 s, unloads at 0.1 s
  const Run result = run(d, o);
  CHECK_FALSE(result.summary.completed);
  CHECK(result.summary.halved_steps > 0);
  CHECK(result.summary.steps > 90);
  CHECK(result.summary.steps < 110);
  CHECK(result.states.size() == static_cast<std::size_t>(result.summary.steps) + 1);
  CHECK(result.summary.end_time == doctest::Approx(result.summary.steps * 1e-3).epsilon(4 * epsilon));
  CHECK(result.summary.stop_reason.starts_with("the step at t = 0.10"));
  CHECK(result.summary.stop_reason.ends_with("largest in element 's.k'; tried: newton (1 iteration)"));
  CHECK(result.summary.worst_balance_error < 1e-11);  // a hundred steps of 1e-12
  CHECK(std::abs(result.summary.energy.balance_error()) < 1e-11 * result.summary.energy.initial);
}

TEST_CASE("impacts are observed once each, in the order in which the summary lists them") {
  ModelDescription d = linear_oscillator(4600, 2.11e6, 0.005, -0.024);
  d.contacts = {wall("s.1", 0.01, 0.6)};
  const Run result = run(d, options(1, 1e-3, 1));
  REQUIRE(result.observed.size() == result.summary.impacts.size());
  for (std::size_t i = 0; i < result.observed.size(); ++i) CHECK(result.observed[i].time == result.summary.impacts[i].time);
}

TEST_CASE("contact under preload: Moreau-Jean freezes a penetration of 1.6e-4 m and a reaction 0.8 % low") {
  const double m = 1000, k = m * 16 * pi * pi, g0 = 0.01;  // exact: contact at 0.0669301182 s, reaction 2 k g0 = 3158.2734 N
  ModelDescription d = linear_oscillator(m, k, 0);
  MotionDescription motion;
  motion.dt = 2;
  motion.acceleration = {-3 * k * g0 / m, -3 * k * g0 / m};
  d.motions = {motion};
  d.contacts = {wall("s.1", g0, 0)};
  AnalysisOptions o = options(0.5, 1e-3, 1);
  o.gamma = 0.5;
  const Run result = run(d, o);
  REQUIRE(result.summary.impacts.size() > 100);
  CHECK(result.summary.impacts.front().time == doctest::Approx(0.0669301182).epsilon(0.02));  // a step
  CHECK(result.summary.max_penetration == doctest::Approx(1.6e-4).epsilon(0.1));
  CHECK(result.summary.impacts.back().impulse / 1e-3 == doctest::Approx(3158.2734 * (1 - 0.008)).epsilon(1e-3));
}

TEST_CASE("a mass that grazes the wall without speed gets a small impulse that the exact motion does not have") {
  // q = 0.01 cos 2 pi t exactly under the load (k - m 4 pi^2) q; the wall at 0.01 m is touched at every whole second
  const double m = 1, k = 16 * pi * pi;
  ModelDescription d = linear_oscillator(m, k, 0, 0.01);
  MotionDescription motion;
  motion.dt = 1e-3;
  for (int i = 0; i <= 1500; ++i) motion.acceleration.push_back(-(k / m - 4 * pi * pi) * 0.01 * std::cos(2 * pi * i * 1e-3));
  d.motions = {motion};
  d.contacts = {wall("s.1", 0.01, 0.6)};
  for (const double theta : {0.5, 1.0}) {
    const Run result = run(d, options(theta, 1e-3, 1.5));
    double impulse = 0;
    for (const Impact& impact : result.summary.impacts) impulse += impact.impulse;
    CHECK(impulse < 0.01);  // of the largest momentum 0.063
  }
}
