// Force-based members that carry what is left of their balance from one evaluation of a step to the next, in schemes and algorithms:
// the same runs as with inner iterations at every evaluation, with less work, and nothing carried beyond a step.
#include <doctest/doctest.h>

#include "integrators/algorithms.hpp"
#include "integrators/static_analysis.hpp"
#include "integrators/static_stage.hpp"
#include "tests/integrators/oscillators.hpp"
#include "tests/integrators/runs.hpp"

using namespace nsframe;
using namespace nsframe::test;

namespace {

ModelDescription force_pair(bool inner_iterations, Geometry geometry = Geometry::linear) {
  ModelDescription d = fiber_pair(Steel02{235e6, 210e9, 0.01, 20, 0.925, 0.15}, ElementKind::force_beam, 4, geometry);
  for (StructureDescription& s : d.structures) {
    for (ElementDescription& e : s.elements) e.inner_iterations = inner_iterations;
  }
  return d;
}

// Of any element, in a history that was committed [-].
double largest_unsettled(const Model& model, const VectorX& history) {
  double largest = 0;
  for (std::size_t g = 0; g < model.groups.size(); ++g) {
    const ElementGroup& group = *model.groups[g];
    for (int e = 0; e < group.size(); ++e) {
      largest = std::max(largest, group.state_work(e, history.data() + model.history_begin[g] + group.history_begin(e)).unsettled);
    }
  }
  return largest;
}

double work_of(const ModelDescription& d, const Run& run, bool nothing_carried) {
  const Model model = build(d);
  for (const State& state : run.states) REQUIRE(largest_unsettled(model, state.history) == 0);
  const StateWorkSums& work = run.summary.state_work;
  CHECK(work.evaluations > 0);
  CHECK(work.passes >= work.evaluations);
  CHECK(work.finished <= work.carried);
  CHECK((work.carried == 0) == nothing_carried);
  return static_cast<double>(work.passes);
}

}  // namespace

TEST_CASE("schemes that iterate carry what is left within a step and end it settled, with fewer passes and the same motion") {
  for (const std::string scheme : {"moreau-jean", "event-split"}) {
    for (const Geometry geometry : {Geometry::linear, Geometry::corotational}) {
      CAPTURE(scheme);
      CAPTURE(static_cast<int>(geometry));
      AnalysisOptions o = by_scheme(scheme, 1e-3, 0.3);
      o.newton_tolerance = 1e-10;
      const Run carried = completed(force_pair(false, geometry), o), iterated = completed(force_pair(true, geometry), o);
      REQUIRE_FALSE(carried.summary.impacts.empty());
      REQUIRE(carried.summary.impacts.size() == iterated.summary.impacts.size());
      CHECK(work_of(force_pair(false, geometry), carried, false) < work_of(force_pair(true, geometry), iterated, true));
      // what sections tolerate, 1e-4 of a step's change, is left squared
      CHECK(difference(carried, iterated) < 1e-6 * carried.states.back().displacement.cwiseAbs().maxCoeff());
      CHECK(carried.summary.laddered_steps == 0);
      CHECK(carried.summary.newton_iterations <= 1.02 * static_cast<double>(iterated.summary.newton_iterations) + 2);
    }
  }
}

TEST_CASE("schemes with one evaluation a step carry nothing: the same bits as with inner iterations") {
  for (const std::string integrator : {"theta", "alpha-os"}) {
    AnalysisOptions o = by_scheme(integrator == "theta" ? "exponential" : "event-split", 1e-3, 0.2);
    o.integrator = integrator;
    o.rho_infinity = 0.8;
    if (integrator == "alpha-os") {
      ModelDescription carried = force_pair(false), iterated = force_pair(true);
      carried.contacts.clear();
      iterated.contacts.clear();
      CHECK(difference(completed(carried, o), completed(iterated, o)) == 0);
      continue;
    }
    const Run carried = completed(force_pair(false), o), iterated = completed(force_pair(true), o);
    CHECK(difference(carried, iterated) == 0);
    CHECK(carried.summary.state_work.carried == 0);
  }
}

TEST_CASE("every algorithm ends at the same state; those that evaluate a point again carry nothing") {
  AnalysisOptions o = options(1, 2e-3, 0.16);
  o.newton_tolerance = 1e-10;
  o.max_newton = 60;
  const Run reference = completed(force_pair(true), o);
  for (const std::string& name : algorithm_names()) {
    CAPTURE(name);
    o.algorithm = {name};
    const Run other = completed(force_pair(false), o);
    CHECK(other.summary.halved_steps == 0);
    CHECK(difference(other, reference) < 1e-6 * reference.states.back().displacement.cwiseAbs().maxCoeff());
    const bool carries = name == "newton" || name == "modified" || name == "initial";
    work_of(force_pair(false), other, !carries);
  }
}

TEST_CASE("a run that carries goes on from a snapshot with the same bits and the same sums") {
  const Model model = build(force_pair(false));
  const AnalysisOptions o = options(0.5, 1e-3, 0.1);
  check_resumed(model, o, 40);
  Simulation whole(model, o);
  const StateWorkSums all = whole.run({}).state_work;
  Snapshot snapshot;
  int steps = 0;
  RunControl stop;
  stop.stop_requested = [&] { return ++steps > 40; };
  stop.keep_snapshot = [&](const Snapshot& kept) { snapshot = kept; };
  Simulation first(model, o);
  first.run({}, stop);
  RunControl go_on;
  go_on.resume = &snapshot;
  Simulation second(model, o);
  const StateWorkSums parts = second.run({}, go_on).state_work;
  CHECK(parts.evaluations == all.evaluations);
  CHECK(parts.passes == all.passes);
  CHECK(parts.carried == all.carried);
  CHECK(parts.finished == all.finished);
  CHECK(parts.iterated == all.iterated);
}

TEST_CASE("an evaluation of the remaining elements alone gives the force and tangent of one of all") {
  const Model model = build(force_pair(false));
  System system(model, 1);
  const State rest = virgin_state(system);
  VectorX q = rest.displacement, carried_force, force, all_force;
  for (Eigen::Index i = 0; i < q.size(); ++i) q[i] = 0.01 * std::sin(2.0 * static_cast<double>(i));
  State a = rest, b = rest;
  Assembler& assembler = system.assembler;
  assembler.start_step(rest.history, a.history);
  assembler.internal_force(q, rest.history, a.history, carried_force, true, StateDetermination::one_pass);
  REQUIRE(assembler.unsettled());
  b.history = a.history;
  assembler.internal_force(q, rest.history, a.history, force, true, StateDetermination::remaining);
  CHECK_FALSE(assembler.unsettled());
  const MatrixX tangent = assembler.tangent();
  assembler.internal_force(q, rest.history, b.history, all_force);
  CHECK((force - all_force).norm() < 1e-9 * all_force.norm());
  CHECK((tangent - MatrixX(assembler.tangent())).norm() < 1e-3 * tangent.norm());
  // at once from rest into yielding: a tenth of that change may be carried, its square is in the force
  CHECK((carried_force - all_force).norm() < 2e-2 * all_force.norm());
  assembler.start_step(rest.history, b.history);
  assembler.internal_force(q, rest.history, b.history, all_force);
  CHECK((force - all_force).norm() < 1e-6 * all_force.norm());
}
