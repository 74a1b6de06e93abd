// The scheme event-split: its order across impacts, sustained contact without drift, hard cases of contact, and against exact.
#include <doctest/doctest.h>

#include <cmath>

#include "tests/integrators/oscillators.hpp"
#include "tests/verification/closed_forms.hpp"
#include "tests/verification/pair_of_masses.hpp"

using namespace nsframe;
using namespace nsframe::test;

namespace {

AnalysisOptions by_scheme(const std::string& scheme, double dt, double duration) {
  AnalysisOptions o = options(0.5, dt, duration);
  o.scheme = scheme;
  return o;
}

Run completed(const ModelDescription& d, const AnalysisOptions& o) {
  Run result = run(d, o);
  CAPTURE(result.summary.stop_reason);
  REQUIRE(result.summary.completed);
  return result;
}

ModelDescription row(const std::vector<Oscillator>& bodies) {
  ModelDescription d;
  for (std::size_t i = 0; i < bodies.size(); ++i) d.structures.push_back(oscillator(static_cast<int>(i), bodies[i]));
  return d;
}

ModelDescription pull_back(double e, double xi) {
  ModelDescription d = row({{4600, 2.11e6, xi, -0.024}, {3500, 5.31e6, xi}});
  d.contacts = {contact_of(0, 1, 0.02, e)};
  return d;
}

double pull_back_error(const Run& run) {
  double error = 0;
  for (const State& state : run.states) {
    for (int k = 0; k < 2; ++k) error = std::max(error, std::abs(state.displacement[k] - pull_back_exact(state.time)[static_cast<std::size_t>(k)]));
  }
  return error;
}

}  // namespace

TEST_CASE("event-split: the pull-back pair, of second order across three impacts") {
  std::vector<double> errors;
  for (const double dt : {5e-3, 1e-3, 1e-4}) {
    const Run result = completed(pull_back(0.6, 0.005), by_scheme("event-split", dt, 2));
    CHECK(result.summary.impacts.size() == 3);
    CHECK(result.summary.factorizations == 1);
    errors.push_back(pull_back_error(result));
  }
  CHECK(errors[1] < 4.5e-5);  // an event-split trapezoidal rule with its parts factored anew: 4.2e-5
  CHECK(std::log10(errors[1] / errors[2]) > 1.8);
}
