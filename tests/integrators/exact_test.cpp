// The exact scheme: what it refuses, and a touch without speed; its hard cases with closed forms are in tests/verification/exact_cases.cpp.
#include <doctest/doctest.h>

#include <cmath>

#include "integrators/exact.hpp"
#include "tests/integrators/oscillators.hpp"

using namespace nsframe;
using namespace nsframe::test;

namespace {

AnalysisOptions exactly(double dt, double duration) {
  AnalysisOptions o;
  o.scheme = "exact";
  o.dt = dt;
  o.duration = duration;
  return o;
}

}  // namespace

TEST_CASE("exact: a wall that is missed by a millionth of a millionth gives no impulse") {
  const double g0 = 0.01;
  ModelDescription d = linear_oscillator(1, 4 * pi * pi, 0, g0);  // q = g0 cos 2 pi t
  d.contacts = {wall("s.1", g0 * (1 + 1e-12), 0.6)};
  const Run result = run(d, exactly(1e-3, 3.5));
  REQUIRE(result.summary.completed);
  double impulse = 0, error = 0;
  for (const Impact& impact : result.summary.impacts) impulse += impact.impulse;
  for (const State& state : result.states) error = std::max(error, std::abs(state.displacement[0] - g0 * std::cos(2 * pi * state.time)));
  CHECK(impulse < 1e-9);
  CHECK(error < 1e-12);
}

TEST_CASE("exact: nonlinear elements are refused with their names") {
  const auto reason = [](const ModelDescription& d) {
    try {
      run(d, exactly(1e-3, 0.1));
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string("no error");
  };
  const ModelDescription nonlinear = nonlinear_oscillator(100, Steel02{1e4, 1e6, 0.01}, 0, 4);
  CHECK(reason(nonlinear).find("element 's.k' (spring) is nonlinear") != std::string::npos);
  AnalysisOptions named = exactly(1e-3, 0.1);
  named.scheme_at = {"s.toml", 7, 10};
  CHECK_THROWS_WITH_AS(run(nonlinear, named),
                       "s.toml:7:10: error: scheme 'exact' is for linear scenes, and element 's.k' (spring) is nonlinear; use scheme = \"exponential\" or \"moreau-jean\"",
                       InputError);
}
