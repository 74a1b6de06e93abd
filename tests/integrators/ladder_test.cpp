// Solution algorithms in time steps, with contact inside the iterations.
#include <doctest/doctest.h>

#include <cmath>

#include "integrators/algorithms.hpp"
#include "tests/integrators/oscillators.hpp"

using namespace nsframe;
using namespace nsframe::test;

namespace {

struct Result {
  Summary summary;
  State end;
};

Result solution(const ModelDescription& description, const AnalysisOptions& options) {
  const Model model = build(description);
  Simulation simulation(model, options);
  Result result{simulation.run({}), {}};
  result.end = simulation.state();
  return result;
}

}  // namespace

TEST_CASE("every algorithm finds the same impacts and the same motion of yielding cantilevers that pound") {
  AnalysisOptions o = options(1, 1e-3, 0.5);
  o.newton_tolerance = 1e-10;
  const ModelDescription d = fiber_pair(Steel02{235e6, 210e9, 0.01}, ElementKind::displacement_beam, 3);
  o.algorithm = {"newton"};
  const Result newton = solution(d, o);
  REQUIRE(newton.summary.completed);
  REQUIRE_FALSE(newton.summary.impacts.empty());
  for (const std::string& name : algorithm_names()) {
    CAPTURE(name);
    o.algorithm = {name};
    o.max_newton = 60;
    const Result other = solution(d, o);
    REQUIRE_MESSAGE(other.summary.completed, other.summary.stop_reason);
    CHECK(other.summary.halved_steps == 0);
    REQUIRE(other.summary.impacts.size() == newton.summary.impacts.size());
    for (std::size_t i = 0; i < newton.summary.impacts.size(); ++i) {
      const Impact& a = newton.summary.impacts[i];
      const Impact& b = other.summary.impacts[i];
      CHECK(b.time == a.time);
      CHECK(b.impulse == doctest::Approx(a.impulse).epsilon(1e-6));  // a hundred steps of 1e-10, and its conditioning
      CHECK(b.rate_after == doctest::Approx(0.6 * -b.rate_before).epsilon(1e-9));  // the law itself, whatever the algorithm
    }
    CHECK((other.end.displacement - newton.end.displacement).norm() < 1e-7 * newton.end.displacement.norm());
    CHECK(other.summary.worst_balance_error < 1e-7);
  }
}

TEST_CASE("where Newton fails the ladder goes on with the whole step, and the run keeps a record of it") {
  AnalysisOptions o = options(1, 0.02, 0.4);
  const ModelDescription d = nonlinear_oscillator(100, Steel02{1e4, 1e6, 0.01}, 0, 4);
  const Result patient = solution(d, o);
  REQUIRE(patient.summary.halved_steps == 0);
  CHECK(patient.summary.laddered_steps == 0);
  CHECK(patient.summary.ladder.empty());
  o.max_newton = 4;
  const Result laddered = solution(d, o);
  CHECK(laddered.summary.completed);
  REQUIRE(laddered.summary.laddered_steps > 0);
  REQUIRE(laddered.summary.ladder.size() == static_cast<std::size_t>(laddered.summary.laddered_steps));
  const LadderRecord& first = laddered.summary.ladder.front();
  CHECK(first.attempts.size() >= 2);
  CHECK(first.attempts.front().algorithm == "newton");
  CHECK(first.attempts.front().iterations == 4);
  CHECK_FALSE(first.attempts.front().converged);
  CHECK(first.at == doctest::Approx((first.step - 1) * 0.02).epsilon(1e-12));
  if (laddered.summary.halved_steps == 0) {
    CHECK((laddered.end.displacement - patient.end.displacement).norm() < 1e-6 * patient.end.displacement.norm());
  }
}

TEST_CASE("a record of the ladder survives a checkpoint") {
  const std::vector<LadderRecord> records{
      {"", 812, 0.811, {{"newton", 30, false, 12.5, "a reason, with \xc3\xa9"}, {"krylov", 7, true, 0.5, ""}}}, {"push", 3, -1, {}}};
  Snapshot snapshot;
  save("ladder", records, snapshot);
  const std::vector<LadderRecord> again = restore_ladder("ladder", snapshot);
  REQUIRE(again.size() == 2);
  CHECK(again[0].step == 812);
  CHECK(again[0].at == 0.811);
  REQUIRE(again[0].attempts.size() == 2);
  CHECK(again[0].attempts[0].algorithm == "newton");
  CHECK(again[0].attempts[0].reason == records[0].attempts[0].reason);
  CHECK(again[0].attempts[1].converged);
  CHECK(again[1].stage == "push");
}
