// What is not computed: the same results, and true figures of it.
#include <doctest/doctest.h>

#include "tests/integrators/oscillators.hpp"

using namespace nsframe;
using namespace nsframe::test;

namespace {

ModelDescription steel_pair(double velocity, ElementKind kind = ElementKind::displacement_beam) {
  return fiber_pair(Steel02{235e6, 210e9, 0.01}, kind, velocity);
}

}  // namespace

TEST_CASE("forces and histories are the same bits with and without tangents, which stay those of the last call with") {
  for (const ElementKind kind : {ElementKind::displacement_beam, ElementKind::force_beam}) {
    ModelDescription d = steel_pair(0, kind);
    d.structures[0].springs = {ground_spring("k", "3", 1e4 * Vector6::Unit(0))};
    const Model model = build(d);
    Simulation simulation(model, options(1, 1e-3, 1));
    Assembler& assembler = simulation.system().assembler;
    const State& rest = simulation.state();
    State a = rest, b = rest;
    for (Eigen::Index i = 0; i < a.displacement.size(); ++i) a.displacement[i] = 0.02 * std::sin(2.0 * static_cast<double>(i));
    const MatrixX virgin = assembler.tangent();
    assembler.start_step(rest.history, b.history);
    assembler.internal_force(a.displacement, rest.history, b.history, b.internal_force, false);
    CHECK_FALSE(assembler.tangent_is_current());
    CHECK(MatrixX(assembler.tangent()) == virgin);
    assembler.start_step(rest.history, a.history);
    assembler.internal_force(a.displacement, rest.history, a.history, a.internal_force);
    CHECK(assembler.tangent_is_current());
    CHECK(MatrixX(assembler.tangent()) != virgin);
    CHECK((a.internal_force - b.internal_force).norm() <= 1e-14 * a.internal_force.norm());
    CHECK((a.history - b.history).norm() <= 1e-14 * a.history.norm());
    VectorX linear, nonlinear;
    assembler.linear_force(a.displacement, linear);
    assembler.start_step(rest.history, b.history);
    assembler.nonlinear_force(a.displacement, rest.history, b.history, nonlinear, false);
    CHECK(linear.norm() > 0);
    CHECK((assembler.linear_stiffness() * a.displacement - linear).norm() <= 1e-13 * linear.norm());
    CHECK((linear + nonlinear - a.internal_force).norm() <= 1e-14 * a.internal_force.norm());
    CHECK((a.history - b.history).norm() <= 1e-14 * a.history.norm());
  }
}

TEST_CASE("steps that their first guess solves end where steps with iterations do") {
  AnalysisOptions o = options(1, 2e-4, 0.4);
  const Run guessed = run(steel_pair(3), o);
  o.newton_tolerance = 1e-11;  // few guesses reach it
  const Run iterated = run(steel_pair(3), o);
  CHECK(guessed.summary.savings.guessed_steps > 300);
  REQUIRE(iterated.summary.completed);
  CHECK(iterated.summary.savings.guessed_steps < guessed.summary.savings.guessed_steps / 4);
  REQUIRE(guessed.summary.impacts.size() == iterated.summary.impacts.size());
  REQUIRE_FALSE(guessed.summary.impacts.empty());
  const double scale = iterated.states.back().displacement.norm();
  CHECK((guessed.states.back().displacement - iterated.states.back().displacement).norm() < 1e-5 * scale);
  CHECK(guessed.summary.worst_balance_error < 1e-6);
}

TEST_CASE("the savings of a run are those that were made") {
  ModelDescription d = steel_pair(1e-3);
  d.contacts.clear();
  StructureDescription& s = d.structures[0];
  s.springs = {ground_spring("k", "3", 1e4 * Vector6::Unit(0))};
  AnalysisOptions o = options(1, 1e-3, 0.2);
  const Run elastic = run(d, o);
  CHECK(elastic.summary.savings.elements_assembled_once == 1);
  CHECK(elastic.summary.savings.quiet_fibers == 1);
  CHECK(elastic.summary.factorizations == 1);
  // one solution in each guess and each iteration
  CHECK(elastic.summary.savings.factorizations_avoided >= 200 - 1);
  CHECK(elastic.summary.savings.guessed_steps + elastic.summary.newton_iterations >= 200);
  const Run yielding = run(steel_pair(5), o);
  CHECK(yielding.summary.savings.quiet_fibers > 0);
  CHECK(yielding.summary.savings.quiet_fibers < 0.9);
  const Run linear = run(linear_oscillator(100, 1e4, 0.02, 0.01), o);
  CHECK(linear.summary.savings.elements_assembled_once == 1);
  CHECK(linear.summary.savings.quiet_fibers == 0);
  CHECK(linear.summary.savings.guessed_steps == 0);
  CHECK(linear.summary.savings.factorizations_avoided == 199);
}
