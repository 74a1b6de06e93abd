// Contact with closed-form answers by the scheme `exact`: right to rounding where nothing else stands between it and the answer.
#include <fmt/format.h>

#include <cmath>

#include "integrators/simulation.hpp"
#include "tests/support/small_models.hpp"
#include "tests/verification/closed_forms.hpp"
#include "tests/verification/pair_of_masses.hpp"
#include "tests/verification/registry.hpp"

using namespace nsframe;
using namespace nsframe::test;

namespace {

struct ExactRun {
  Summary summary;
  std::vector<State> states;
  const State& last() const { return states.back(); }
  double impulse_so_far() const {
    double sum = 0;
    for (const State& state : states) sum += state.impulse.sum();
    return sum;
  }
};

ExactRun run(const ModelDescription& description, double dt, double duration) {
  const Model model = build(description);
  AnalysisOptions options;
  options.scheme = "exact";
  options.dt = dt;
  options.duration = duration;
  Simulation simulation(model, options);
  Recorder recorder;
  ExactRun result{simulation.run({&recorder}), {}};
  CHECK_MESSAGE(result.summary.completed, result.summary.stop_reason);
  result.states = std::move(recorder.states);
  return result;
}

template <class Exact>
double largest_error(const ExactRun& run, const Exact& exact) {
  double error = 0;
  for (const State& state : run.states) error = std::max(error, std::abs(state.displacement[0] - exact(state.time)));
  return error;
}

// E = 900, rho = 1, L = 10, c = 30 m/s, A = 1: 100 elements of a mass at each end, along x, `height` off a wall at -x.
ModelDescription elastic_bar(double height, double velocity) {
  const int elements = 100;
  const double dx = 0.1;
  ModelDescription d;
  StructureDescription s;
  s.name = "bar";
  s.may_move_freely = true;
  d.materials = {{"e", {}, Elastic{900}}};
  for (int i = 0; i <= elements; ++i) {
    const std::string id = std::to_string(i);
    s.nodes.push_back(node(id, i * dx, 0, 0));
    s.supports.push_back(fixed(id, {false, true, true, true, true, true}));
    s.masses.push_back({{id, {}}, Vector3(i == 0 || i == elements ? dx / 2 : dx, 0, 0), Vector3::Zero()});
    if (velocity != 0) s.initial_velocities.push_back({{id, {}}, 0, velocity});
    if (i < elements) s.elements.push_back(bar(id, id, std::to_string(i + 1), "e", 1));
  }
  d.structures = {s};
  ContactDescription c;
  c.kind = ContactKind::nodes;
  c.a = {"bar.0", {}};
  c.gap = {height};
  c.restitution = 0;
  c.direction = -Vector3::UnitX();
  d.contacts = {c};
  return d;
}

double momentum_of_bar(const State& state) {
  const auto last = state.velocity.size() - 1;
  return 0.1 * (state.velocity.sum() - 0.5 * state.velocity[0] - 0.5 * state.velocity[last]);
}

// Time at which the first contact ends.
double end_of_contact(const ExactRun& run, double after, double before) {
  double end = 0;
  for (const State& state : run.states) {
    if (state.time > after && state.time < before && state.impulse.size() > 0 && state.impulse[0] > 0) end = state.time;
  }
  return end;
}

const double front = std::pow(0.01, 2.0 / 3) * 10 / 30;  // [s]
constexpr double rounding = 1e-12;  // [m] of displacements of centimetres over some seconds

}  // namespace

VERIFICATION_CASE("Contact", "Exact scheme: pull-back of two oscillators",
                  "Table 3 of the paper, e = 0.6, damping 0.5 %, over 2 s; closed form between impacts located to rounding, and the state at 2 s "
                  "to its printed digits.") {
  for (const double dt : {1e-2, 1e-3}) {
    const ExactRun result = run(pull_back(0.6, 0.005), dt, 2);
    rows.add(fmt::format("dt = {:g} s: impacts", dt), static_cast<double>(result.summary.impacts.size()), 3, absolute(0));
    double error = 0;
    for (const State& state : result.states) {
      for (int k = 0; k < 2; ++k) error = std::max(error, std::abs(state.displacement[k] - pull_back_exact(state.time)[static_cast<std::size_t>(k)]));
    }
    rows.add(fmt::format("dt = {:g} s: largest error of both displacements, m", dt), error, 0, absolute(rounding));
    const std::array<double, 3> times{0.12050131156430804, 0.38924251683069677, 0.6722824563756127}, impulses{858.33033, 1259.16694, 813.15022};
    for (std::size_t i = 0; i < 3; ++i) {
      rows.add(fmt::format("dt = {:g} s: impact {}, s", dt, i + 1), result.summary.impacts.at(i).time, times[i], relative(1e-12));
      rows.add(fmt::format("dt = {:g} s: impulse {}, N s", dt, i + 1), result.summary.impacts.at(i).impulse, impulses[i], relative(1e-8));
    }
    const std::array<double, 2> q{-0.011297890361169, 0.000394892409473}, v{0.130187206077, 0.184512991022};
    for (int k = 0; k < 2; ++k) {
      rows.add(fmt::format("dt = {:g} s: displacement {} at 2 s, m", dt, k + 1), result.last().displacement[k], q[static_cast<std::size_t>(k)], absolute(rounding));
      rows.add(fmt::format("dt = {:g} s: velocity {} at 2 s, m/s", dt, k + 1), result.last().velocity[k], v[static_cast<std::size_t>(k)], absolute(2e-11));
    }
  }
}

VERIFICATION_CASE("Contact", "Exact scheme: ball until it rests",
                  "Dropped from 1 m under 2 m/s2: infinitely many impacts, at rest after (1 + e)/(1 - e) s.") {
  for (const double e : {0.5, 0.9}) {
    ModelDescription d = row({{1, 0, 0}});
    d.contacts = {contact_of(0, -1, 1.0, e)};
    d.gravity = {Vector3(2, 0, 0), false};
    const double rest = (1 + e) / (1 - e);
    const ExactRun result = run(d, 1e-3, rest + 0.5);
    double last = 0;
    for (const Impact& impact : result.summary.impacts) last = std::max(last, impact.time);
    rows.add(fmt::format("e = {:g}: at rest from, s", e), last, rest, absolute(1e-10));
    rows.add(fmt::format("e = {:g}: displacement at rest, m", e), result.last().displacement[0], 1, absolute(1e-13));
    rows.add(fmt::format("e = {:g}: energy lost, J", e), result.summary.energy.contact, 2, relative(1e-12));
    rows.add(fmt::format("e = {:g}: largest penetration, m", e), result.summary.max_penetration, 0, absolute(1e-13));
    rows.add(fmt::format("e = {:g}: largest bounce left out at the end, m", e), result.summary.accumulations.largest_bounce, 0, absolute(1e-13));
    if (e == 0.5) {
      rows.add("e = 0.5: largest error of the height, m", largest_error(result, [](double t) { return 1 - bouncing_ball_height(t); }), 0, absolute(rounding));
    }
  }
}

VERIFICATION_CASE("Contact", "Exact scheme: preload on a wall",
                  "1000 kg at 2 Hz, wall at g0 = 1 cm, e = 0, pushed by 3 k g0 from rest, from 1 s on by - k g0: contact at arccos(2/3)/w, reaction "
                  "2 k g0 for as long as the push lasts, then a free oscillation about - g0.") {
  const double m = 1000, k = m * 16 * pi * pi, g0 = 0.01, w = 4 * pi, t1 = 1;
  ModelDescription d = row({{m, k, 0}});
  MotionDescription motion;  // 4 k g0 until t1, beside - k g0 throughout
  motion.dt = t1 / 4;
  motion.acceleration.assign(5, -4 * k * g0 / m);
  d.motions = {motion};
  d.gravity = {Vector3(-k * g0 / m, 0, 0), false};
  d.contacts = {contact_of(0, -1, g0, 0)};
  const ExactRun result = run(d, 1e-3, 1.4);
  double drift = 0, later = 0;
  for (const State& state : result.states) {
    if (state.time > 0.067 && state.time <= t1) drift = std::max(drift, std::abs(state.displacement[0] - g0));
    if (state.time > t1) later = std::max(later, std::abs(state.displacement[0] + g0 - 2 * g0 * std::cos(w * (state.time - t1))));
  }
  rows.add("contact, s", result.summary.impacts.at(0).time, 0.0669301182, relative(1e-9));
  rows.add("contact by the closed form, s", result.summary.impacts.at(0).time, std::acos(2.0 / 3) / w, relative(1e-13));
  rows.add("parting, s", result.summary.impacts.at(1).time, t1, relative(1e-13));
  rows.add("reaction, N", result.states.at(500).impulse[0] / 1e-3, 3158.2734, relative(1e-8));
  rows.add("largest drift on the wall, m", drift, 0, absolute(1e-15));
  rows.add("largest error after parting, m", later, 0, absolute(rounding));
}

VERIFICATION_CASE("Contact", "Exact scheme: a wall grazed without speed",
                  "1 kg, q = g0 cos 2 pi t, wall at g0 = 1 cm: touched at whole seconds without speed, no impulse.") {
  ModelDescription d = row({{1, 4 * pi * pi, 0, 0.01}});
  d.contacts = {contact_of(0, -1, 0.01, 0.6)};
  const ExactRun result = run(d, 1e-3, 3.5);
  double impulse = 0;
  for (const Impact& impact : result.summary.impacts) impulse += impact.impulse;
  rows.add("sum of impulses, N s", impulse, 0, absolute(1e-9));
  rows.add("largest error of the displacement, m", largest_error(result, [](double t) { return 0.01 * std::cos(2 * pi * t); }), 0, absolute(rounding));
}

VERIFICATION_CASE("Contact", "Exact scheme: five equal balls in a row",
                  "e = 1, the first at 1 m/s. Touching: Newton's law for all pairs at once gives (2 - n)/n and 2/n; with gaps between them the last takes "
                  "all.") {
  const int n = 5;
  for (const double gap : {0.0, 1e-3}) {
    std::vector<Oscillator> balls(n, {2, 0, 0});
    balls[0].velocity = 1;
    ModelDescription d = row(balls);
    for (int i = 0; i + 1 < n; ++i) d.contacts.push_back(contact_of(i, i + 1, gap, 1));
    const ExactRun result = run(d, 1e-2, 1);
    for (int i = 0; i < n; ++i) {
      const double expected = gap == 0 ? (i == 0 ? (2.0 - n) / n : 2.0 / n) : (i == n - 1 ? 1.0 : 0.0);
      rows.add(fmt::format("gap {:g} m: velocity of ball {}, m/s", gap, i + 1), result.last().velocity[i], expected, absolute(1e-13));
    }
  }
}

VERIFICATION_CASE("Contact", "Exact scheme: mass ratios of a million and ten thousand million",
                  "A heavy ball at 1 m/s on a light one, e = 0.7; then a stack at rest under gravity, heavy on light on the floor.") {
  for (const double ratio : {1e6, 1e10}) {
    const double e = 0.7, g = 9.81;
    ModelDescription d = row({{ratio, 0, 0, 0, 1}, {1, 0, 0}});
    d.contacts = {contact_of(0, 1, 0.1, e)};
    const ExactRun impact = run(d, 1e-2, 0.2);
    rows.add(fmt::format("{:g}: velocity of the heavy ball, m/s", ratio), impact.last().velocity[0], (ratio - e) / (ratio + 1), relative(1e-14));
    rows.add(fmt::format("{:g}: velocity of the light ball, m/s", ratio), impact.last().velocity[1], ratio * (1 + e) / (ratio + 1), relative(1e-14));
    d = row({{ratio, 0, 0}, {1, 0, 0}});
    d.contacts = {contact_of(0, 1, 0, e), contact_of(1, -1, 0, e)};
    d.gravity = {Vector3(g, 0, 0), false};
    const ExactRun stack = run(d, 1e-2, 0.5);
    const VectorX& p = stack.last().impulse;
    rows.add(fmt::format("{:g}: reaction between them, N", ratio), p[0] / 1e-2, ratio * g, relative(1e-8));
    rows.add(fmt::format("{:g}: reaction of the floor, N", ratio), p[1] / 1e-2, (ratio + 1) * g, relative(1e-8));
    rows.add(fmt::format("{:g}: largest displacement, m", ratio), stack.last().displacement.cwiseAbs().maxCoeff(), 0, absolute(1e-15));
  }
}

VERIFICATION_CASE("Contact", "Exact scheme: a million steps without damping",
                  "The pull-back pair with e = 1 and no damping: its energy of 607.68 J stays, over a million steps of 1 ms, over steps of ten periods, and "
                  "over steps of 0.1 us.") {
  const auto energy = [](const State& s) {
    return 0.5 * (4600 * s.velocity[0] * s.velocity[0] + 3500 * s.velocity[1] * s.velocity[1] + 2.11e6 * s.displacement[0] * s.displacement[0] +
                  5.31e6 * s.displacement[1] * s.displacement[1]);
  };
  const Model model = build(pull_back(1, 0));
  const double slow_period = 2 * pi / std::sqrt(2.11e6 / 4600);
  for (const auto& [dt, duration, name] : {std::tuple{1e-3, 1000.0, "dt = 1 ms, 1000 s"}, std::tuple{10 * slow_period, 1000 * slow_period, "dt = 10 periods, 1000 periods"},
                                           std::tuple{1e-7, 0.15, "dt = 0.1 us, 0.15 s"}}) {
    AnalysisOptions options;
    options.scheme = "exact";
    options.dt = dt;
    options.duration = duration;
    Simulation simulation(model, options);
    const Summary summary = simulation.run({});
    CHECK_MESSAGE(summary.completed, summary.stop_reason);
    rows.add(fmt::format("{}: energy, J", name), energy(simulation.state()), 607.68, relative(1e-11));
    rows.add(fmt::format("{}: error of the balance at the end, J", name), summary.energy.balance_error(), 0, absolute(1e-11 * 607.68));
  }
}

VERIFICATION_CASE("Contact", "Exact scheme: contact on a rotation without mass",
                  "Cantilever of 2.5 m, EI = 7.3e5, 4600 kg at its tip, contact at an arm of 0.5 m on the tip's rotation, gap 1 cm, let go at - 2 cm: a spring in "
                  "series, no impulse, e plays no part. Reference: piecewise closed form, eight digits.") {
  const double m = 4600, EI = 7.3e5, L = 2.5, arm = 0.5;
  ModelDescription d;
  d.sections = {elastic_section("c", {EI / 1e-4, 81e9, 1, 1e-4, 1e-4, 1e-4})};
  StructureDescription s;
  s.name = "s0";
  s.nodes = {node("0", 0, 0, 0), node("2", 0, 0, L), node("1", 0, 0, L + arm)};
  s.elements = {beam("e", "0", "2", "c")};
  s.supports = {fixed("0"), fixed("2", {false, true, true, true, false, true})};
  s.masses = {{{"2", {}}, Vector3(m, 0, 0), Vector3::Zero()}};
  s.constraints = {constraint(ConstraintKind::rigid_body, "2", {"1"})};
  s.initial_displacements = {{{"2", {}}, 0, -0.02}};
  d.structures = {s};
  d.contacts = {contact_of(0, -1, 0.01, 0.6)};
  const ExactRun result = run(d, 1e-3, 1.5);
  rows.add("first parting, s", result.summary.impacts.at(0).time, 0.42862361, absolute(6e-9));
  rows.add("second parting, s", result.summary.impacts.at(1).time, 1.21333678, absolute(6e-9));
  rows.add("largest penetration, m", result.summary.max_penetration, 0, absolute(1e-12));
  rows.add("1 - worst error of the energy balance", 1 - result.summary.worst_balance_error, 1, absolute(1e-9));
}

VERIFICATION_CASE("Contact", "Exact scheme: a rigid slab falls flat on four corners",
                  "4600 kg from 5 cm on corners at 1.6 m and 1.1 m: rank 3 of four pairs. It leaves with e sqrt(2 g h), does not turn, and rests with m g.") {
  const double m = 4600, h = 0.05, g = 9.81, v = std::sqrt(2 * g * h);
  for (const double e : {0.5, 0.0}) {
    ModelDescription d;
    StructureDescription s;
    s.name = "slab";
    s.may_move_freely = true;
    s.nodes = {node("0", 0, 0, h), node("1", -1.6, -1.1, h), node("2", 1.6, -1.1, h), node("3", 1.6, 1.1, h), node("4", -1.6, 1.1, h)};
    s.masses = {mass("0", m, Vector3(m * 1.1 * 1.1 / 3, m * 1.6 * 1.6 / 3, m * 1.2))};
    s.constraints = {constraint(ConstraintKind::rigid_body, "0", {"1", "2", "3", "4"})};
    d.structures = {s};
    for (int i = 1; i <= 4; ++i) {
      ContactDescription c = contact_of(0, -1, h, e);
      c.a = {fmt::format("slab.{}", i), {}};
      c.direction = -Vector3::UnitZ();
      d.contacts.push_back(c);
    }
    d.gravity = {Vector3(0, 0, -g), false};
    const ExactRun result = run(d, 1e-3, e > 0 ? 0.15 : 0.5);
    double sum = 0, turned = 0;
    for (std::size_t i = 0; i < 4; ++i) sum += result.summary.impacts.at(i).impulse;
    for (const State& state : result.states) turned = std::max(turned, state.displacement.tail(3).cwiseAbs().maxCoeff());
    rows.add(fmt::format("e = {:g}: impact, s", e), result.summary.impacts.at(0).time, std::sqrt(2 * h / g), relative(1e-14));
    rows.add(fmt::format("e = {:g}: velocity after, m/s", e), result.summary.impacts.at(0).rate_after, e * v, absolute(1e-13));
    rows.add(fmt::format("e = {:g}: sum of impulses, N s", e), sum, m * (1 + e) * v, relative(1e-13));
    rows.add(fmt::format("e = {:g}: largest rotation, rad", e), turned, 0, absolute(1e-15));
    if (e == 0) rows.add("e = 0: sum of reactions at rest, N", result.last().impulse.sum() / 1e-3, m * g, relative(1e-12));
  }
}

VERIFICATION_CASE("Contact", "Exact scheme: an elastic bar on a wall",
                  "E = 900, rho = 1, L = 10, c = 30 m/s in 100 elements, 5 m off the wall at 10 m/s. Closed form of the bar: in contact from 0.5 s for 2 L/c, "
                  "impulse 200, leaves as it came. The chain of masses disperses the front of the wave over (dx/L)^(2/3) L/c.") {
  const ExactRun result = run(elastic_bar(5, -10), 1e-3, 1.5);
  double off = 0;
  for (const State& state : result.states) {
    if (state.time > 0.5 && state.time < 0.5 + 2.0 / 3) off = std::max(off, std::abs(state.displacement[0] + 5));
  }
  rows.add("impulse, N s", result.impulse_so_far(), 200, relative(0.01));
  rows.add("end of contact, s", end_of_contact(result, 0.4, 1.4), 0.5 + 2.0 / 3, absolute(front));
  rows.add("momentum after, N s", momentum_of_bar(result.last()), 100, relative(0.02));
  rows.add("largest distance from the wall in contact, m", off, 0, absolute(1e-13));
  rows.add("1 - worst error of the energy balance", 1 - result.summary.worst_balance_error, 1, absolute(1e-12));
}

VERIFICATION_CASE("Contact", "Exact scheme: an elastic bar bounces under gravity",
                  "The same bar from rest, 5 m up, under 10 m/s2: hits after 1 s with 10 m/s, pressure rho c (10 + 10 t) for 2 L/c, impulse 266.67.") {
  ModelDescription d = elastic_bar(5, 0);
  d.gravity = {Vector3(-10, 0, 0), false};
  const ExactRun result = run(d, 1e-3, 2.5);
  rows.add("impact, s", result.summary.impacts.at(0).time, 1, relative(1e-12));
  rows.add("end of contact, s", end_of_contact(result, 0.9, 2.4), 1 + 2.0 / 3, absolute(front));
  rows.add("impulse, N s", result.impulse_so_far(), 30 * (10 * 2.0 / 3 + 5 * 4.0 / 9), relative(0.01));
  rows.add("momentum at 2.5 s, N s", momentum_of_bar(result.last()), -250 + 30 * (10 * 2.0 / 3 + 5 * 4.0 / 9), absolute(3));
  rows.add("1 - worst error of the energy balance", 1 - result.summary.worst_balance_error, 1, absolute(1e-12));
}
