// Which scheme `auto` takes, and what it says about it.
#include <doctest/doctest.h>

#include "integrators/scheme_choice.hpp"
#include "tests/integrators/oscillators.hpp"

using namespace nsframe;
using namespace nsframe::test;

namespace {

struct Chosen {
  std::string scheme, reason;
};

Chosen chosen(const ModelDescription& description) {
  const Model model = build(description);
  AnalysisOptions options;
  options.duration = 0.1;
  const Summary summary = Simulation(model, options).run({});
  return {summary.scheme, summary.scheme_reason};
}

bool tells(const Chosen& chosen, const std::string& what) { return chosen.reason.find(what) != std::string::npos; }

}  // namespace

TEST_CASE("without a scheme, a linear scene is moved exactly and a nonlinear one by the exponential scheme, and the run says why") {
  const Chosen linear = chosen(linear_oscillator(1, 100, 0.02, 0.01));
  CHECK(linear.scheme == "exact");
  CHECK(tells(linear, "linear"));
  const Chosen nonlinear = chosen(nonlinear_oscillator(100, Steel02{1e4, 1e6, 0.01}, 0, 4));
  CHECK(nonlinear.scheme == "exponential");
  CHECK(tells(nonlinear, "element 's.k' (spring) is nonlinear"));
  ModelDescription damped = nonlinear_oscillator(100, Viscous{1e3, 0.5}, 0, 4);
  damped.structures[0].springs.push_back(ground_spring("elastic", "1", 1e4 * Vector6::Unit(0)));
  const Chosen rate = chosen(damped);
  CHECK(rate.scheme == "moreau-jean");
  CHECK(tells(rate, "rate of deformation"));
}

TEST_CASE("auto leaves to Moreau-Jean what exact cannot take, overlap at the start, and not what it can: dashpots that tie modes together") {
  ModelDescription overlap = linear_oscillator(1, 100, 0, 0.02);
  overlap.contacts = {wall("s.1", 0.01, 0.5)};
  const Chosen overlapping = chosen(overlap);
  CHECK(overlapping.scheme == "moreau-jean");
  CHECK_MESSAGE(tells(overlapping, "overlaps by 0.01 m at the start"), overlapping.reason);
  overlap.contacts[0].gap = {0.02};
  CHECK(chosen(overlap).scheme == "exact");  // touches
  ModelDescription dashpot = linear_oscillator(1, 100, 0);
  StructureDescription& s = dashpot.structures[0];
  s.supports[0].fixed[1] = false;
  s.springs[0].stiffness[1] = 400;
  s.springs.push_back(s.springs[0]);
  s.springs[1].id = "skew";
  s.springs[1].stiffness.setZero();
  s.springs[1].damping[0] = 3;
  s.springs[1].x = Vector3(1, 1, 0);
  s.springs[1].in_plane = Vector3::UnitY();
  const Chosen coupled = chosen(dashpot);
  CHECK(coupled.scheme == "exact");
  const Model model = build(dashpot);
  AnalysisOptions options;
  options.duration = 0.1;
  const std::vector<std::string> lines = Simulation(model, options).scheme().describe();
  CHECK(std::any_of(lines.begin(), lines.end(), [](const std::string& line) { return line.find("damping ties 2 modes of structure 's' together") == 0; }));
}

TEST_CASE("a scheme that is asked for is taken") {
  const Model model = build(linear_oscillator(1, 100, 0, 0.01));
  const Simulation simulation(model, options(0.5, 1e-3, 0.1));
  CHECK(simulation.scheme().name() == "moreau-jean");
  CHECK(simulation.scheme_reason() == "asked for");
}
