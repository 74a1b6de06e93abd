// The calibrated two-story pair against OpenSees' frequencies and static displacements, and against the paper's Table 7.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>

#include "integrators/simulation.hpp"
#include "integrators/static_analysis.hpp"
#include "tests/support/reference_data.hpp"
#include "tests/verification/registry.hpp"
#include "tests/verification/two_story_model.hpp"

using namespace nsframe;
using namespace nsframe::test;

VERIFICATION_CASE("Contact", "The two-story pair by the exact scheme",
                  "examples/two_story_elastic over 6 s of El Centro with bursts of impacts and sustained contact: results kept at each ms "
                  "against those at each 5 ms, which must not matter. No outside reference.") {
  const auto end = [](const char* dt) {
    const Scene scene = example_scene("two_story_elastic", {"analysis.scheme=exact", "analysis.duration=6 s", std::string("analysis.dt=") + dt});
    const Model model = model_of(scene);
    Simulation simulation(model, scene.analysis);
    const Summary summary = simulation.run({});
    CHECK(summary.completed);
    CHECK(summary.impacts.size() > 100);
    CHECK(summary.max_penetration < 1e-12);
    return simulation.state();
  };
  const State fine = end("1 ms"), coarse = end("5 ms");
  rows.add("largest displacement at 6 s, m", fine.displacement.cwiseAbs().maxCoeff(), coarse.displacement.cwiseAbs().maxCoeff(), relative(1e-9));
  rows.add("largest difference of displacement at 6 s, m", (fine.displacement - coarse.displacement).cwiseAbs().maxCoeff(), 0, absolute(1e-9));
}

VERIFICATION_CASE("Modes", "The paper's two-story structures",
                  "examples/two_story_elastic, calibrated to Langlade et al., Eng. Struct. 241 (2021) 112426, Table 7; the same model in "
                  "OpenSees 3.7.1.") {
  const Scene scene = example_scene("two_story_elastic");
  const Model model = model_of(scene);
  Simulation simulation(model, scene.analysis);
  const std::array<std::string, 2> structure{"left", "right"};
  const std::array<std::string, 6> names{"L1", "L2", "T1", "T2", "R1", "R2"};
  const std::array<std::array<double, 6>, 2> table{{{2.10, 5.60, 6.11, 17.5, 8.60, 24.4}, {3.69, 10.4, 8.20, 25.2, 10.2, 28.0}}};
  for (const auto& row : read_reference("two_story_modes")) {
    const auto s = static_cast<std::size_t>(row[0]) - 1;
    const int mode = static_cast<int>(row[1]);
    if (mode > 12) continue;  // static displacements, below
    rows.add(fmt::format("{}, frequency {} in OpenSees, Hz", structure[s], mode),
             simulation.modes()[s].modes.circular_frequency[mode - 1] / (2 * pi), row[2], relative(1e-5));
  }
  for (std::size_t s = 0; s < 2; ++s) {
    const StructureModes& modes = simulation.modes()[s];
    for (std::size_t i = 0; i < 6; ++i) {
      const auto found = std::find(modes.names.begin(), modes.names.end(), names[i]) - modes.names.begin();
      REQUIRE(found < modes.modes.size());
      rows.add(fmt::format("{}, {} of Table 7, Hz", structure[s], names[i]), modes.modes.circular_frequency[found] / (2 * pi), table[s][i],
               relative(s == 0 ? 0.002 : 0.013));
    }
  }
}

TEST_CASE("twelve frequencies and two static displacements of each two-story structure equal OpenSees' within 1e-5") {
  for (const std::string example : {"two_story_elastic", "two_story"}) {
    CAPTURE(example);
    const Scene scene = example_scene(example);
    const Model model = model_of(scene);
    Simulation simulation(model, scene.analysis);
    for (const auto& row : read_reference("two_story_modes")) {
      const auto structure = static_cast<std::size_t>(row[0]) - 1;
      const int mode = static_cast<int>(row[1]);
      CAPTURE(structure);
      CAPTURE(mode);
      if (mode < 100) {
        const double frequency = simulation.modes()[structure].modes.circular_frequency[mode - 1] / (2 * pi);
        CHECK(frequency == doctest::Approx(row[2]).epsilon(1e-5));
        continue;
      }
      const std::string roof = structure == 0 ? "left.25" : "right.25";
      const auto node = std::find(model.nodes.id.begin(), model.nodes.id.end(), roof) - model.nodes.id.begin();
      VectorX load = VectorX::Zero(model.dofs.full);
      load[6 * node + mode - 100] = 1000;
      System system(model, 1);
      State state = virgin_state(system);
      solve_static(system, model.dofs.transformation_transposed * load, StaticOptions{}, state);
      CHECK(model.dofs.expand(state.displacement)[6 * node + mode - 100] == doctest::Approx(row[2]).epsilon(1e-5));
    }
  }
}

TEST_CASE("fiber columns of Elastic material give the elastic frame's run to 1e-9") {
  const std::vector<std::string> short_run{"analysis.duration=4", "output.frames=0"};
  const auto run = [&](std::vector<std::string> overrides) {
    overrides.insert(overrides.end(), short_run.begin(), short_run.end());
    const Scene scene = example_scene("two_story_elastic", overrides);
    const Model model = model_of(scene);
    Simulation simulation(model, scene.analysis);
    const Summary summary = simulation.run({});
    REQUIRE(summary.impacts.size() > 0);
    return simulation.state().displacement;
  };
  const VectorX elastic = run({});
  for (const std::string kind : {"displacement", "force-based"}) {
    CAPTURE(kind);
    const VectorX fiber = run({"material.S235.law=Elastic", "structure.left.columns.element=" + kind, "structure.right.columns.element=" + kind});
    CHECK((fiber - elastic).norm() < 1e-9 * elastic.norm());
  }
}

TEST_CASE("force-based columns that carry what is left of their balance give the run of those that iterate at every evaluation") {
  // 3 s of El Centro: yielding, and the first poundings
  const auto run = [](std::vector<std::string> overrides, bool inner_iterations) {
    const std::string value = inner_iterations ? "true" : "false";
    for (const char* side : {"left", "right"}) overrides.push_back(std::string("structure.") + side + ".columns.inner_iterations=" + value);
    overrides.insert(overrides.end(), {"analysis.duration=3", "output.frames=0"});
    const Scene scene = example_scene("two_story", overrides);
    const Model model = model_of(scene);
    Simulation simulation(model, scene.analysis);
    Summary summary = simulation.run({});
    REQUIRE(summary.completed);
    REQUIRE(summary.impacts.size() > 0);
    return std::pair{simulation.state().displacement, std::move(summary)};
  };
  struct Scheme {
    const char *name, *theta;
    double tolerance;  // of the largest displacement at the end
  };
  for (const Scheme& scheme : {Scheme{"moreau-jean", "1.0", 1e-7}, {"moreau-jean", "0.5", 1e-7}, {"event-split", "0.5", 1e-6}, {"exponential", "0.5", 0.0}}) {
    CAPTURE(scheme.name);
    CAPTURE(scheme.theta);
    const std::vector<std::string> options{std::string("analysis.scheme=") + scheme.name, std::string("analysis.theta=") + scheme.theta};
    const auto [carried, work] = run(options, false);
    const auto [iterated, other] = run(options, true);
    CHECK((carried - iterated).cwiseAbs().maxCoeff() <= scheme.tolerance * iterated.cwiseAbs().maxCoeff());
    CHECK(work.impacts.size() == other.impacts.size());
    CHECK(other.state_work.carried == 0);
    const bool once = std::string(scheme.name) == "exponential";
    CHECK((work.state_work.passes < other.state_work.passes) == !once);
    CHECK((work.state_work.carried == 0) == once);
  }
}

TEST_CASE("an undamped frame in free vibration at theta = 1/2 keeps its energy to 1e-10 over 1e5 steps") {
  Scene scene = example_scene("two_story_elastic", {"analysis.theta=0.5", "analysis.duration=100"});
  scene.model.motions.clear();
  scene.model.contacts.clear();
  scene.model.gravity.acceleration.setZero();
  for (StructureDescription& structure : scene.model.structures) {
    structure.damping.kind = DampingKind::none;
    structure.initial_velocities.push_back({{"25", {}}, 0, 0.5});
    structure.initial_velocities.push_back({{"15", {}}, 1, 0.3});
  }
  const Model model = model_of(scene);
  Simulation simulation(model, scene.analysis);
  const Summary summary = simulation.run({});
  const State& state = simulation.state();
  const double energy = 0.5 * state.velocity.dot(model.mass * state.velocity) + 0.5 * state.displacement.dot(simulation.initial_stiffness() * state.displacement);
  CHECK(summary.steps == 100000);
  CHECK(energy == doctest::Approx(summary.energy.initial).epsilon(1e-10));
  CHECK(summary.worst_balance_error < 1e-10);
}
