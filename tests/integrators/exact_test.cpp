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

TEST_CASE("exact: nonlinear elements and damping that couples the modes are refused, each with its name") {
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
  ModelDescription d = linear_oscillator(1, 100, 0);
  CHECK(reason(d) == "no error");
  StructureDescription& s = d.structures[0];
  s.supports[0].fixed[1] = false;  // two directions, of which a skew dashpot couples the motions
  s.springs[0].stiffness[1] = 400;
  s.springs.push_back(s.springs[0]);
  s.springs[1].id = "skew";
  s.springs[1].stiffness.setZero();
  s.springs[1].damping[0] = 3;
  s.springs[1].x = Vector3(1, 1, 0);
  s.springs[1].in_plane = Vector3::UnitY();
  const std::string why = reason(d);
  CHECK_MESSAGE(why.find("structure 's'") != std::string::npos, why);
}
