// The exact scheme with dampers that tie natural modes together (theory.md, 335-345), each case against another route.
#include <doctest/doctest.h>

#include <cmath>
#include <random>

#include "tests/integrators/damped_chains.hpp"
#include "tests/support/numbers.hpp"

using namespace nsframe;
using namespace nsframe::test;

namespace {

// Error of a free motion against the matrix exponential, of every kept state, relative to the largest displacement at the start.
double free_motion_error(const std::vector<double>& masses, const std::vector<Tie>& ties, const std::vector<double>& q0, const std::vector<double>& v0,
                         double frequency, bool free = false) {
  const double dt = 0.01;
  const Run result = run(chain(masses, ties, q0, v0, free), exact_options(dt, 4));
  REQUIRE(result.summary.completed);
  REQUIRE(result.summary.scheme == "exact");
  const LongMatrixX step = exponential(ChainMatrices(masses, ties).system(), static_cast<Long>(dt));
  LongVector y = state_of(q0, v0);
  double error = 0;
  for (const State& state : result.states) {
    error = std::max(error, difference(state, y, frequency));
    y = (step * y).eval();
  }
  CHECK(std::abs(result.summary.energy.balance_error()) <= 1e-12 * (result.summary.energy.initial + std::abs(result.summary.energy.strain)));
  double most = 0;
  for (const State& state : result.states) most = std::max(most, state.displacement.cwiseAbs().maxCoeff());
  return error / most;
}

const std::vector<double> three_masses{1000, 700, 300};
const std::vector<Tie> three_ties{{0, -1, 4e5, 0}, {0, 1, 3e5, 8e3}, {1, 2, 2e5, 0}, {2, -1, 0, 500}};

}  // namespace

TEST_CASE("exact: three masses with dashpots between some of them move as the matrix exponential says") {
  CHECK(free_motion_error(three_masses, three_ties, {0.02, 0, -0.01}, {0, 1, 0}, 30) < 2e-13);
}

TEST_CASE("exact: dashpots so strong that modes creep and others stop at once") {
  for (const double c : {1e2, 1e4, 1e6}) {
    CAPTURE(c);
    const double rate = c * (1.0 / 10 + 1.0 / 5);  // [1/s]; in modes its rounding stands beside frequencies of 30 rad/s
    CHECK(free_motion_error({10, 5, 2}, {{0, -1, 4e3, 0}, {0, 1, 3e3, c}, {1, 2, 2e3, 0}, {2, -1, 0, c}}, {0.02, 0, -0.01}, {0, 1, 0}, 30) <
          1e-13 + 4 * epsilon * rate / 30);
  }
}

TEST_CASE("exact: a damper of two oscillators at which their complex modes become parallel") {
  // (s2 + a s + w1^2) (s2 + b s + w2^2) - a b s2 is a square at a = 2 p w1 / (w1 + w2), b = 2 p w2 / (w1 + w2), p = w2 - w1
  const double w1 = 10, w2 = 14, m1 = 1.4, m2 = 1, c = m1 * 2 * (w2 - w1) * w1 / (w1 + w2);
  for (const double off : {0.0, 1e-14, 1e-10, 1e-6, 1e-3, 0.1}) {
    CAPTURE(off);
    CHECK(free_motion_error({m1, m2}, {{0, -1, m1 * w1 * w1, 0}, {1, -1, m2 * w2 * w2, 0}, {0, 1, 0, c * (1 + off)}}, {0.02, 0}, {0, 0.3}, 12) < 2e-13);
  }
  // there (s2 + p s + w1 w2)^2 = 0
  const Summary summary =
      run(chain({m1, m2}, {{0, -1, m1 * w1 * w1, 0}, {1, -1, m2 * w2 * w2, 0}, {0, 1, 0, c}}, {0.02, 0}), exact_options(0.01, 0.1)).summary;
  REQUIRE(summary.modes.size() == 2);
  for (const ModeNumerics& mode : summary.modes) {
    CHECK(mode.complex_frequency == doctest::Approx(std::sqrt(w1 * w2) / (2 * pi)).epsilon(1e-12));
    CHECK(mode.complex_damping == doctest::Approx((w2 - w1) / 2 / std::sqrt(w1 * w2)).epsilon(1e-12));
  }
}

TEST_CASE("exact: a damper at which two creeping modes become parallel: critical damping of tied modes") {
  // the characteristic polynomial is linear in c: c(r) at s = -r has its least value where r is a double root
  const double m1 = 2, m2 = 1, k1 = 200, k2 = 450;
  const auto needed = [&](double r) {
    return (r * r + k1 / m1) * (r * r + k2 / m2) / (r * (r * r * (1 / m1 + 1 / m2) + (k1 + k2) / (m1 * m2)));
  };
  double low = 5, high = 60;
  for (int i = 0; i < 200; ++i) {
    const double a = low + (high - low) / 3, b = high - (high - low) / 3;
    (needed(a) < needed(b) ? high : low) = needed(a) < needed(b) ? b : a;
  }
  const double c = needed(low);
  for (const double off : {0.0, -1e-12, 1e-12, -1e-8, 1e-8, -1e-4, 1e-4}) {
    CAPTURE(off);
    CHECK(free_motion_error({m1, m2}, {{0, -1, k1, 0}, {1, -1, k2, 0}, {0, 1, 0, c * (1 + off)}}, {0.02, 0}, {0, 0.3}, 15) < 2e-13);
  }
}

TEST_CASE("exact: free masses that a dashpot alone ties together, and with springs beside it") {
  // relative velocity fades as exp(-c (1/m1 + 1/m2) t), the centre goes on
  const double m1 = 3, m2 = 5, c = 40, v1 = 1, v2 = -0.2, rate = c * (1 / m1 + 1 / m2), centre = (m1 * v1 + m2 * v2) / (m1 + m2);
  const Run result = run(chain({m1, m2}, {{0, 1, 0, c}}, {}, {v1, v2}, true), exact_options(0.01, 2));
  double error = 0;
  for (const State& s : result.states) {
    const double closing = (v1 - v2) * -std::expm1(-rate * s.time) / rate;
    error = std::max({error, std::abs(s.displacement[0] - centre * s.time - m2 / (m1 + m2) * closing),
                      std::abs(s.displacement[1] - centre * s.time + m1 / (m1 + m2) * closing)});
  }
  CHECK(error < 1e-13);
  CHECK(free_motion_error({3, 5, 2, 4}, {{0, 1, 900, 0}, {1, 2, 0, 40}, {2, 3, 500, 5}}, {0.01, 0, 0, 0}, {1, 0, -0.2, 0}, 15, true) < 1e-12);
}

TEST_CASE("exact: a base motion that is linear between samples moves masses with dashpots as the matrix exponential says, with the work it does") {
  MotionDescription motion;
  motion.dt = 0.05;
  for (int i = 0; i <= 40; ++i) motion.acceleration.push_back(3 * std::sin(1.7 * i) + std::cos(0.3 * i * i));
  for (const bool free : {false, true}) {
    CAPTURE(free);
    std::vector<Tie> ties = three_ties;
    if (free) ties = {{0, 1, 3e5, 8e3}, {1, 2, 0, 4e3}};  // K is singular twice
    const std::vector<double> v0 = free ? std::vector<double>{0.5, 0, -0.3} : std::vector<double>{0, 0, 0};
    ModelDescription d = chain(three_masses, ties, {0, 0, 0}, v0, free);
    d.motions = {motion};
    const double dt = 0.01;
    const Run result = run(d, exact_options(dt, 2));
    const ChainMatrices matrices(three_masses, ties);
    LongVector y = state_of({0, 0, 0}, v0);
    double error = 0, dissipated = 0;
    for (std::size_t i = 0; i < result.states.size(); ++i) {
      const State& state = result.states[i];
      error = std::max(error, difference(state, y, 30));
      if (i + 1 == result.states.size()) break;
      const auto k = static_cast<std::size_t>(state.time / motion.dt + 1e-6);
      const double slope = (motion.acceleration[k + 1] - motion.acceleration[k]) / motion.dt;
      const double now = motion.acceleration[k] + slope * (state.time - static_cast<double>(k) * motion.dt);
      const LongVector masses = matrices.M.diagonal(), f0 = -now * masses, f1 = -slope * masses;
      y[6] = 1;
      y[7] = 0;
      const auto power = [&](const LongVector& at) { return static_cast<double>(at.segment(3, 3).dot(matrices.C * at.segment(3, 3))); };
      const LongMatrixX eighth = exponential(matrices.system(f0, f1), static_cast<Long>(dt) / 8);
      for (int part = 0; part < 4; ++part) {  // Simpson's rule over a quarter
        const LongVector middle = eighth * y, end = eighth * middle;
        dissipated += dt / 24 * (power(y) + 4 * power(middle) + power(end));
        y = end;
      }
    }
    CHECK(error < 1e-12);
    const Energy& energy = result.summary.energy;
    CHECK(energy.damping == doctest::Approx(dissipated).epsilon(1e-7));  // Simpson's rule: (w h)^4 / 2880
    CHECK(std::abs(energy.balance_error()) <= 1e-11 * energy.damping);
  }
}

namespace {

// Impacts of mass 2 with a wall at `gap`, found by marching in tenths of milliseconds and halving: no bounds, no modes.
LongVector march(const ChainMatrices& matrices, LongVector y, double gap, double e, double duration, int& impacts) {
  const Eigen::Index n = matrices.M.rows(), hit = n - 1;
  const LongMatrixX A = matrices.system();
  const Long h = 1e-4L;
  const LongMatrixX step = exponential(A, h);
  const auto left = static_cast<long>(std::lround(duration / 1e-4));
  for (long i = 0; i < left; ++i) {
    LongVector next = step * y;
    Long done = 0;
    while (next[hit] > gap) {
      Long low = 0, high = h - done;
      for (int k = 0; k < 70; ++k) {
        const Long middle = (low + high) / 2;
        ((exponential(A, middle) * y)[hit] > gap ? high : low) = middle;
      }
      y = (exponential(A, low) * y).eval();
      y[n + hit] *= -e;
      ++impacts;
      done += low;
      next = exponential(A, h - done) * y;
    }
    y = next;
  }
  return y;
}

ModelDescription beside_wall(const std::vector<double>& masses, const std::vector<Tie>& ties, const std::vector<double>& v0, double gap, double e) {
  ModelDescription d = chain(masses, ties, {}, v0);
  d.contacts = {wall(fmt::format("s.{}", masses.size() - 1), gap, e)};
  return d;
}

}  // namespace

TEST_CASE("exact: impacts of masses with dashpots are those of a march with the matrix exponential") {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> unit(0, 1);
  for (int scene = 0; scene < 3; ++scene) {
    CAPTURE(scene);
    std::vector<double> masses;
    std::vector<Tie> ties;
    for (int i = 0; i < 4; ++i) {
      masses.push_back(std::pow(10, 1 + unit(random)));
      ties.push_back({i, i - 1, 4e4 * (0.3 + unit(random)), unit(random) < 0.6 ? 300 * unit(random) : 0});
    }
    ties.push_back({3, 0, 0, 200});
    const double e = 0.5 + 0.25 * scene, gap = 0.002;  // up to e = 1
    const Run result = run(beside_wall(masses, ties, {0, 0, 0, 1}, gap, e), exact_options(5e-3, 1));
    int impacts = 0;
    const LongVector y = march(ChainMatrices(masses, ties), state_of({0, 0, 0, 0}, {0, 0, 0, 1}), gap, e, 1, impacts);
    CHECK(result.summary.impacts.size() == static_cast<std::size_t>(impacts));
    CHECK(impacts >= 3);
    CHECK(difference(result.states.back(), y, 50) < 1e-11);
    CHECK(std::abs(result.summary.energy.balance_error()) <= 1e-12 * result.summary.energy.initial);
    CHECK(result.summary.max_penetration < 1e-14);
  }
}

TEST_CASE("exact: event-split and Moreau-Jean converge to it where dashpots tie modes together, at the order they have") {
  const ModelDescription d = beside_wall({40, 25, 10}, {{0, -1, 4e4, 0}, {0, 1, 3e4, 200}, {1, 2, 2e4, 0}, {2, 0, 0, 60}}, {0, 0, 1}, 0.006, 0.6);
  const Run exact = run(d, exact_options(0.01, 0.5));
  REQUIRE(exact.summary.impacts.size() >= 2);
  const auto error = [&](const std::string& scheme, double dt) {
    AnalysisOptions o = exact_options(dt, 0.5);
    o.scheme = scheme;
    o.theta = o.gamma = 0.5;
    const Run other = run(d, o);
    const auto stride = static_cast<std::size_t>(std::lround(0.01 / dt));
    double sum = 0;
    for (std::size_t i = 0; i < exact.states.size(); ++i) sum += (exact.states[i].displacement - other.states[i * stride].displacement).squaredNorm();
    return std::sqrt(sum);
  };
  CHECK(std::log2(error("event-split", 1e-3) / error("event-split", 2.5e-4)) / 2 > 1.8);
  CHECK(std::log2(error("moreau-jean", 2.5e-4) / error("moreau-jean", 3.125e-5)) / 3 > 0.7);
  CHECK(error("event-split", 2.5e-4) < 5e-6);
}

namespace {

// Mass 2 is pulled against a wall and stays there, while the others go on.
struct Pressed {
  Run result;
  double drift = 0, motion_error = 0, force_error = 0;
};

Pressed press(double e) {
  const std::vector<double> masses{40, 25, 10};
  const std::vector<Tie> ties{{0, -1, 4e4, 0}, {0, 1, 3e4, 200}, {1, 2, 2e4, 30}, {2, 0, 0, 60}};
  ModelDescription d = chain(masses, ties, {0.01, 0, 0}, {0.5, 0, 0});
  const double g = 100;  // [m/s2]
  d.gravity = {Vector3(g, 0, 0), false};
  d.contacts = {wall("s.2", 0, e)};
  const double dt = 0.01;
  Pressed pressed{run(d, exact_options(dt, 2))};
  // mass 2 held: the others with its springs and dashpots to the ground
  const std::vector<double> two{40, 25};
  std::vector<Tie> held = ties;
  held[2].to = held[3].from = -1;
  held[3] = {0, -1, 0, 60};
  const ChainMatrices matrices(two, held);
  const LongVector weight = static_cast<Long>(g) * matrices.M.diagonal();
  const LongMatrixX step = exponential(matrices.system(weight, LongVector::Zero(2)), static_cast<Long>(dt) / 20);
  LongVector y = state_of({0.01, 0}, {0.5, 0});
  const auto force = [&] { return 10 * g + static_cast<double>(2e4L * y[1] + 30 * y[3] + 60 * y[2]); };
  for (std::size_t i = 0; i < pressed.result.states.size(); ++i) {
    const State& state = pressed.result.states[i];
    pressed.drift = std::max(pressed.drift, std::abs(state.displacement[2]));
    for (int k = 0; k < 2; ++k) pressed.motion_error = std::max(pressed.motion_error, std::abs(state.displacement[k] - static_cast<double>(y[k])));
    double impulse = 0;
    for (int part = 0; part < 10; ++part) {  // of the next step, by Simpson's rule
      const double a = force();
      y = (step * y).eval();
      const double b = force();
      y = (step * y).eval();
      impulse += dt / 60 * (a + 4 * b + force());
    }
    if (i + 1 < pressed.result.states.size()) {
      pressed.force_error = std::max(pressed.force_error, std::abs(pressed.result.states[i + 1].impulse[0] - impulse) / (10 * g * dt));
    }
  }
  return pressed;
}

}  // namespace

TEST_CASE("exact: a mass with dashpots that is pressed against a wall stays there, and the contact carries what springs and dashpots bring") {
  for (const double e : {0.0, 0.5, 1.0}) {
    CAPTURE(e);
    const Pressed pressed = press(e);
    REQUIRE(pressed.result.summary.completed);
    CHECK(pressed.drift <= 1e-12);
    CHECK(pressed.motion_error < 1e-12);
    CHECK(pressed.force_error < 1e-9);  // Simpson's rule
    CHECK(std::abs(pressed.result.summary.energy.balance_error()) <= 1e-11 * pressed.result.summary.energy.damping);
  }
}

namespace {

// A mass on a spring k1 and, through a node without mass, on a dashpot c and a spring k2 one behind the other. In (x, x', z) with z of the node:
// c z' + k2 z = c x', m x'' + k1 x + k2 z = m g.
LongMatrixX maxwell(double m, double k1, double k2, double c, double g) {
  LongMatrixX A = LongMatrixX::Zero(4, 4);
  A(0, 1) = 1;
  A(1, 0) = -k1 / m;
  A(1, 2) = -k2 / m;
  A(1, 3) = g;
  A(2, 1) = 1;
  A(2, 2) = -k2 / c;
  return A;
}

}  // namespace

TEST_CASE("exact: a dashpot at a node without mass is a motion of first order") {
  const double m = 50, k1 = 2e4, k2 = 3e4, c = 400, g = 9.81;
  for (const bool fallen : {false, true}) {  // from rest under gravity, or suddenly under it
    CAPTURE(fallen);
    ModelDescription d = chain({m, 0}, {{0, -1, k1, 0}, {0, 1, 0, c}, {1, -1, k2, 0}}, {}, {1, 0});
    d.gravity = {Vector3(g, 0, 0), !fallen};
    const Run result = run(d, exact_options(0.01, 1));
    const LongMatrixX step = exponential(maxwell(m, k1, k2, c, fallen ? g : 0), 0.01L);
    LongVector y = LongVector::Zero(4);
    y[1] = y[3] = 1;
    const double rest = fallen ? 0 : m * g / k1;
    double error = 0;
    for (const State& s : result.states) {
      error = std::max({error, std::abs(s.displacement[0] - rest - static_cast<double>(y[0])), std::abs(s.displacement[1] - static_cast<double>(y[2]))});
      if (s.time > 0) error = std::max(error, std::abs(s.velocity[1] - static_cast<double>(y[1] - k2 / c * y[2])) / 30);
      y = (step * y).eval();
    }
    CHECK(error < 1e-13);
    CHECK(std::abs(result.summary.energy.balance_error()) < 1e-13 * (result.summary.energy.initial + std::abs(result.summary.energy.input)));
  }
}

TEST_CASE("exact: a dashpot at a node without mass beside impacts, which light masses in its place approach") {
  const double m = 50, k1 = 2e4, k2 = 3e4, c = 400;
  const auto scene = [&](double light) {
    ModelDescription d = chain({m, light}, {{0, -1, k1, 0}, {0, 1, 0, c}, {1, -1, k2, 0}}, {}, {1, 0});
    d.contacts = {wall("s.0", 0.01, 0.7)};
    return run(d, exact_options(0.01, 1));
  };
  const Run none = scene(0), light = scene(1e-5), lighter = scene(1e-6);
  REQUIRE(none.summary.completed);
  CHECK(none.summary.impacts.size() >= 2);
  CHECK(lighter.summary.impacts.size() == none.summary.impacts.size());
  const auto distance = [&](const Run& other) {
    double most = 0;
    for (std::size_t i = 0; i < none.states.size(); ++i) most = std::max(most, std::abs(other.states[i].displacement[0] - none.states[i].displacement[0]));
    return most;
  };
  CHECK(distance(lighter) < 1e-8);  // of the order of the light mass over the other, times displacements of centimetres
  CHECK(distance(light) / distance(lighter) == doctest::Approx(10).epsilon(0.05));
}

TEST_CASE("exact: contact at a node with a dashpot and no mass is refused, with what to do") {
  ModelDescription d = chain({50, 0}, {{0, -1, 2e4, 0}, {0, 1, 0, 400}, {1, -1, 3e4, 0}}, {}, {1, 0});
  d.contacts = {wall("s.1", 0.01, 0.7)};
  std::string why = "no error";
  try {
    run(d, exact_options(0.01, 1));
  } catch (const InputError& error) {
    why = error.what();
  }
  CHECK_MESSAGE(why.find("contact meets DOFs that have damping and no mass: give them mass") != std::string::npos, why);
}

TEST_CASE("exact: Rayleigh and modal damping beside a dashpot, with rotations that have no mass: event-split converges to it, and the balance holds") {
  for (const DampingKind kind : {DampingKind::rayleigh, DampingKind::modal}) {
    ModelDescription d = column();
    StructureDescription& s = d.structures[0];
    s.nodes.push_back(node("3", 0, 0, 5));
    s.elements.push_back(beam("e2", "2", "3", "c"));
    s.masses.push_back(mass("3", 700));
    s.damping.kind = kind;
    s.damping.mass_factor = 0.1;
    s.damping.stiffness_factor = 1e-3;
    s.damping.ratios = {0.02, 0.02};
    SpringDescription dashpot = ground_spring("d", "2", Vector6::Zero());
    dashpot.damping[0] = 2e4;
    s.springs = {dashpot};
    s.initial_velocities = {{{"3", {}}, 0, 0.5}};
    d.contacts = {wall("a.3", 0.01, 0.5)};
    const Run exact = run(d, exact_options(0.01, 0.5));
    CHECK(exact.summary.impacts.size() >= 1);
    CHECK(std::abs(exact.summary.energy.balance_error()) < 1e-11 * exact.summary.energy.initial);
    const auto error = [&](double dt) {
      AnalysisOptions o = exact_options(dt, 0.5);
      o.scheme = "event-split";
      o.theta = 0.5;
      const Run other = run(d, o);
      return (other.states.back().displacement - exact.states.back().displacement).norm();
    };
    CHECK(error(1.25e-4) < 2e-6);
    CHECK(std::log2(error(1.25e-4) / error(3.125e-5)) / 2 > 1.5);  // one impact
  }
}

TEST_CASE("exponential: yielding columns with a dashpot that ties modes together, to which event-split converges") {
  ModelDescription d = yielding_masses(Steel02{1e5, 1e7, 0.05});
  StructureDescription& s = d.structures[0];
  s.nodes.push_back(node("2", 0, 0, 0));
  s.supports.push_back(fixed("2", {false, true, true, true, true, true}));
  s.masses.push_back(mass("2", 400));
  SpringDescription tie = ground_spring("tie", "1", 5e6 * Vector6::Unit(0));
  tie.node_j = Reference{"2", {}};
  tie.damping[0] = 2e4;
  s.springs.push_back(tie);
  AnalysisOptions o = exact_options(1e-4, 0.3);
  o.scheme = "exponential";
  const Run exponential = run(d, o);
  CHECK(exponential.summary.impacts.size() >= 1);
  o.scheme = "event-split";
  o.theta = 0.5;
  const Run other = run(d, o);
  CHECK((other.states.back().displacement - exponential.states.back().displacement).norm() < 1e-5);
}
