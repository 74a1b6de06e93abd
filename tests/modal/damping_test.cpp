// Modal and Rayleigh damping give the ratios that were asked for, structure by structure.
#include <doctest/doctest.h>
#include <fmt/format.h>


#include "base/errors.hpp"
#include "integrators/simulation.hpp"
#include "tests/support/numbers.hpp"
#include "tests/support/small_models.hpp"

using namespace nsframe;
using namespace nsframe::test;

namespace {

// A plane column with three masses.
StructureDescription tower(const std::string& name, double x) {
  StructureDescription s;
  s.name = name;
  s.at = at(1);
  for (int i = 0; i <= 3; ++i) s.nodes.push_back(node(std::to_string(i), x, 0, 3 * i));
  s.supports = {fixed("0")};
  for (int i = 1; i <= 3; ++i) {
    s.supports.push_back(fixed(std::to_string(i), {false, true, false, true, false, true}));
    s.elements.push_back(beam(fmt::format("e{}", i), std::to_string(i - 1), std::to_string(i), "c"));
    s.masses.push_back(mass(std::to_string(i), 1000));
  }
  return s;
}

ModelDescription towers(const DampingDescription& damping, int count) {
  ModelDescription d;
  d.sections = {elastic_section("c", {210e9, 81e9, 3e-3, 1e-5, 4e-6, 8e-8})};
  for (int i = 0; i < count; ++i) {
    d.structures.push_back(tower(fmt::format("t{}", i), 10 * i));
    d.structures.back().damping = damping;
  }
  return d;
}

AnalysisOptions short_run() {
  AnalysisOptions options;
  options.scheme = "moreau-jean";
  options.duration = 0.1;
  return options;
}

DampingDescription modal(std::vector<double> ratios) {
  DampingDescription damping;
  damping.at = at(9);
  damping.kind = DampingKind::modal;
  damping.ratios = std::move(ratios);
  return damping;
}

}  // namespace

TEST_CASE("modal damping gives every mode its own ratio, and none to modes beyond") {
  const Model model = build(towers(modal({0.01, 0.02, 0.05}), 1));
  Simulation simulation(model, short_run());
  const StructureModes& modes = simulation.modes()[0];
  const System& system = simulation.system();
  REQUIRE(modes.modes.size() >= 5);
  const MatrixX& U = system.damping.modal[0];
  CHECK(U.cols() == 3);
  const MatrixX generalized = modes.modes.shape.transpose() * U * U.transpose() * modes.modes.shape;
  const VectorX w = modes.modes.circular_frequency;
  VectorX expected = VectorX::Zero(w.size());
  for (int i = 0; i < 3; ++i) expected[i] = 2 * std::array{0.01, 0.02, 0.05}[static_cast<std::size_t>(i)] * w[i];
  CHECK((generalized - MatrixX(expected.asDiagonal())).norm() < 1e-9 * expected.norm());  // orthogonality of the shapes
  CHECK(modes.damping_ratio[1] == doctest::Approx(0.02).epsilon(1e-9));
  CHECK(std::abs(modes.damping_ratio[4]) < 1e-9);
}

TEST_CASE("a ratio asked for by a mode's name goes to that mode") {
  DampingDescription damping = modal({});
  damping.named_ratios = {{{"L2", at(5)}, 0.03}};
  const Model model = build(towers(damping, 1));
  Simulation simulation(model, short_run());
  const StructureModes& modes = simulation.modes()[0];
  const auto second = std::find(modes.names.begin(), modes.names.end(), "L2") - modes.names.begin();
  for (int i = 0; i < modes.modes.size(); ++i) {
    CHECK(std::abs(modes.damping_ratio[i] - (i == second ? 0.03 : 0.0)) < 1e-9);
  }
  damping.named_ratios = {{{"T1", at(5)}, 0.03}};
  const Model plane = build(towers(damping, 1));
  CHECK_THROWS_WITH_AS(Simulation(plane, short_run()), doctest::Contains("s.toml:5:3: error: structure 't0' has no mode 'T1'"), InputError);
  const Model many = build(towers(modal(std::vector<double>(40, 0.01)), 1));
  CHECK_THROWS_WITH_AS(Simulation(many, short_run()), doctest::Contains("s.toml:9:3: error: structure 't0' has 6 modes, 40 damping ratios are given"), InputError);
}

TEST_CASE("the damping of two equal towers does not tie them together") {
  const Model model = build(towers(modal({0.05, 0.05}), 2));
  Simulation simulation(model, short_run());
  const System& system = simulation.system();
  REQUIRE(system.damping.modal.size() == 2);
  VectorX velocity = VectorX::Zero(model.dofs.size()), force = velocity;
  velocity.head(model.structures[0].last_dof).setOnes();
  system.damping.add_force(system.assembler.blocks(), 1, velocity, force);
  CHECK(force.head(model.structures[0].last_dof).norm() > 0);
  CHECK(force.tail(model.dofs.size() - model.structures[1].first_dof) == VectorX::Zero(model.dofs.size() - model.structures[1].first_dof));
}

TEST_CASE("Rayleigh damping has the asked ratios at both frequencies, and less between them") {
  const Model plain = build(towers({}, 1));
  Simulation undamped(plain, short_run());
  const VectorX w = undamped.modes()[0].modes.circular_frequency;
  DampingDescription damping;
  damping.kind = DampingKind::rayleigh;
  damping.frequencies = {w[0] / (2 * pi), w[2] / (2 * pi)};
  damping.frequency_ratios = {0.02, 0.03};
  const Model model = build(towers(damping, 1));
  Simulation simulation(model, short_run());
  const VectorX ratio = simulation.modes()[0].damping_ratio;
  CHECK(ratio[0] == doctest::Approx(0.02).epsilon(1e-9));  // shapes are orthogonal to 1e-12 and less
  CHECK(ratio[2] == doctest::Approx(0.03).epsilon(1e-9));
  CHECK(ratio[1] < 0.03);
  damping.frequencies.reset();
  damping.mass_factor = 0.2;
  damping.stiffness_factor = 1e-4;
  const Model factors = build(towers(damping, 1));
  Simulation by_factors(factors, short_run());
  for (int i = 0; i < 3; ++i) {
    CHECK(by_factors.modes()[0].damping_ratio[i] == doctest::Approx(0.5 * (0.2 / w[i] + 1e-4 * w[i])).epsilon(1e-9));
  }
}

TEST_CASE("Rayleigh damping from two equal frequencies is an error with its place") {
  DampingDescription damping;
  damping.at = at(9);
  damping.kind = DampingKind::rayleigh;
  damping.frequencies = {2.5, 2.5};
  damping.frequency_ratios = {0.02, 0.02};
  const Model model = build(towers(damping, 1));
  CHECK_THROWS_WITH_AS(Simulation(model, short_run()), doctest::Contains("Rayleigh damping needs two different frequencies"),
                       InputError);
}

TEST_CASE("a dashpot adds its own damping to a mode") {
  ModelDescription d = towers({}, 1);
  SpringDescription dashpot = ground_spring("d", "3", Vector6::Zero());
  dashpot.damping[0] = 500;
  d.structures[0].springs = {dashpot};
  const Model model = build(d);
  Simulation simulation(model, short_run());
  const StructureModes& modes = simulation.modes()[0];
  const int top = static_cast<int>(std::find_if(model.dofs.free.begin(), model.dofs.free.end(), [](const FreeDof& f) { return f.node == 3 && f.direction == 0; }) - model.dofs.free.begin());
  for (int i = 0; i < 3; ++i) {
    const double c = 500 * std::pow(modes.modes.shape(top, i), 2);
    CHECK(modes.damping_ratio[i] == doctest::Approx(c / (2 * modes.modes.circular_frequency[i])).epsilon(64 * epsilon));
  }
}

TEST_CASE("a part of a structure that supports hold entirely needs no damping ratios") {
  ModelDescription d = towers(modal({0.01}), 1);
  d.structures[0].nodes.push_back(node("base", 5, 0, 0));
  d.structures[0].supports.push_back(fixed("base"));
  const Model model = build(d);
  CHECK_NOTHROW(Simulation(model, short_run()));
}
