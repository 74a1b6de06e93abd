// Impacts with closed-form answers.
#include <fmt/format.h>

#include "integrators/simulation.hpp"
#include "tests/support/small_models.hpp"
#include "tests/verification/closed_forms.hpp"
#include "tests/verification/pair_of_masses.hpp"
#include "tests/verification/registry.hpp"

using namespace nsframe;
using namespace nsframe::test;

namespace {

struct Run {
  Summary summary;
  std::vector<State> states;
};

Run run(const ModelDescription& description, double theta, double dt, double duration) {
  const Model model = build(description);
  AnalysisOptions options;
  options.scheme = "moreau-jean";
  options.theta = theta;
  options.dt = dt;
  options.duration = duration;
  Simulation simulation(model, options);
  Recorder recorder;
  Run result{simulation.run({&recorder}), {}};
  result.states = std::move(recorder.states);
  return result;
}

}  // namespace

VERIFICATION_CASE("Contact", "Two masses collide",
                  "2 kg at 1.5 m/s against 3 kg at rest, e = 0.4, free. Momentum and Newton's law: with the reduced mass m*, the impulse is "
                  "m* (1 + e) v and the energy lost m* (1 - e^2) v^2 / 2.") {
  ModelDescription d;
  d.structures = {oscillator(0, {2, 0, 0, 0, 1.5}), oscillator(1, {3, 0, 0})};
  d.contacts = {contact_of(0, 1, 0.1, 0.4)};
  const Run result = run(d, 0.5, 1e-3, 0.2);
  const VectorX& v = result.states.back().velocity;
  rows.add("impulse, N s", result.summary.impacts.at(0).impulse, 1.2 * 1.4 * 1.5, relative(1e-12));
  rows.add("energy lost, J", result.summary.energy.contact, 0.5 * 1.2 * (1 - 0.16) * 2.25, relative(1e-12));
  rows.add("velocity of the first after, m/s", v[0], 1.5 - 1.2 * 1.4 * 1.5 / 2, relative(1e-12));
  rows.add("velocity of the second after, m/s", v[1], 1.2 * 1.4 * 1.5 / 3, relative(1e-12));
}

VERIFICATION_CASE("Contact", "Bouncing ball",
                  "Dropped from 1 m under 2 m/s2, e = 0.5: impacts at 1, 2, 2.5, 2.75 ... s, at rest from 3 s. theta = 1/2, dt = 0.1 ms; "
                  "each impact is found to a step, later ones by as many.") {
  ModelDescription d;
  d.structures = {oscillator(0, {1, 0, 0})};
  d.contacts = {contact_of(0, -1, 1.0, 0.5)};
  d.gravity = {Vector3(2, 0, 0), false};
  const double dt = 1e-4;
  const Run result = run(d, 0.5, dt, 3.5);
  const std::array<double, 4> times{1, 2, 2.5, 2.75};
  for (std::size_t i = 0; i < times.size(); ++i) {
    rows.add(fmt::format("impact {}, s", i + 1), result.summary.impacts.at(i).time, times[i], absolute(static_cast<double>(i + 1) * dt));
  }
  for (const double t : {0.5, 1.5, 2.25}) {
    const State& state = result.states.at(static_cast<std::size_t>(std::lround(t / dt)));
    rows.add(fmt::format("height at {:g} s, m", t), 1 - state.displacement[0], bouncing_ball_height(t), absolute(1.5e-4));
  }
}

VERIFICATION_CASE("Contact", "Pull-back of two oscillators",
                  "4600 kg on 2.11 MN/m, pulled back by 2.4 cm, against 3500 kg on 5.31 MN/m; gap 2 cm, e = 0.6, damping 0.5 %. Langlade et "
                  "al., Eng. Struct. 241 (2021) 112426, Table 3; reference: closed form between impacts located to rounding. theta = 1/2, "
                  "dt = 0.1 ms.") {
  ModelDescription d;
  d.structures = {oscillator(0, {4600, 2.11e6, 0.005, -0.024}), oscillator(1, {3500, 5.31e6, 0.005})};
  d.contacts = {contact_of(0, 1, 0.02, 0.6)};
  const double dt = 1e-4;
  const Run result = run(d, 0.5, dt, 2);
  rows.add("impacts", static_cast<double>(result.summary.impacts.size()), 3, absolute(0));
  for (std::size_t i = 0; i < 3; ++i) {
    const ExactImpact& exact = pull_back_impacts()[i];
    rows.add(fmt::format("time of impact {}, s", i + 1), result.summary.impacts.at(i).time, exact.time, absolute(2 * dt));
    rows.add(fmt::format("approach velocity {}, m/s", i + 1), result.summary.impacts.at(i).approach_velocity, -exact.rate, relative(0.01));
  }
  double error = 0;
  for (const State& state : result.states) {
    for (int k = 0; k < 2; ++k) error = std::max(error, std::abs(state.displacement[k] - pull_back_exact(state.time)[static_cast<std::size_t>(k)]));
  }
  rows.add("largest error of both displacements over 2 s, mm", 1e3 * error, 0, absolute(0.05));
}

VERIFICATION_CASE("Contact", "Mass against a stiff stop",
                  "100 kg on 10 kN/m meets a stop of 1 MN/m at 1 m/s (Code_Aster SDND101). The stop is a cable: it acts in one sense only. "
                  "Closed form: half a period of both springs. theta = 1/2, dt = 20 us.") {
  ModelDescription d;
  d.materials = {{"stop", {}, Elastic{1e9}}};
  StructureDescription s = oscillator(0, {100, 1e4, 0, 0, 1});
  s.nodes.push_back(node("wall", -1, 0, 0));
  s.supports.push_back(fixed("wall"));
  s.elements.push_back(bar("stop", "wall", "1", "stop", 1e-3, ElementKind::cable));
  d.structures = {s};
  const double dt = 2e-5, w = std::sqrt(1.01e6 / 100);
  const Run result = run(d, 0.5, dt, 0.04);
  double largest = 0, impulse = 0, end = 0;
  for (const State& state : result.states) {
    const double u = state.displacement[0];
    largest = std::max(largest, u);
    impulse += 1e6 * std::max(u, 0.0) * dt;
    if (end == 0 && u < 0) end = state.time - u / state.velocity[0];
  }
  rows.add("largest displacement, m", largest, 1 / w, relative(1e-5));
  rows.add("largest force of the stop, N", 1e6 * largest, 1e6 / w, relative(1e-5));
  rows.add("duration of contact, s", end, pi / w, relative(1e-5));
  rows.add("impulse of the stop, N s", impulse, 2e6 / (w * w), relative(1e-5));
}
