// Properties that every uniaxial law has, over random histories of the samples.
#include <doctest/doctest.h>

#include <set>

#include "tests/materials/point.hpp"

using namespace nsframe;
using namespace nsframe::test;

namespace {

// The property must hold for every law and every random history.
template <class Property>
void check_for_all_laws(const Property& property) {
  for (const Sample& sample : samples()) {
    CAPTURE(std::string(sample.name));
    CHECK(rc::check(sample.name, [&] { property(sample); }));
  }
}

double strain_of(const Sample& sample, int hundredths) { return hundredths * sample.strain / 100; }

}  // namespace

TEST_CASE("every law of the registry is among the samples") {
  std::set<std::size_t> sampled;
  for (const Sample& sample : samples()) sampled.insert(sample.law.index());
  CHECK(sampled.size() == std::variant_size_v<UniaxialLaw>);
}

TEST_CASE("the tangent is the derivative of the stress along any history") {
  check_for_all_laws([](const Sample& sample) {
    Point point(sample.law);
    for (const int i : *history_of(30)) point.move(strain_of(sample, i));
    // never a committed strain
    const double strain = strain_of(sample, *rc::gen::inRange(-2000, 2000)) + 0.005 * sample.strain;
    const double h = 1e-6 * sample.strain, stiffness = sample.stress / sample.strain;
    const double stress = point.probe(strain).stress;
    const double forward = (point.probe(strain + h).stress - stress) / h;
    const double backward = (stress - point.probe(strain - h).stress) / h;
    const double bend = std::abs(forward - backward);
    if (bend > 1e-3 * stiffness) return;  // a corner within h
    // truncation is at most the bend; cancellation is epsilon (stress up to 2 of the sample's) / h
    RC_ASSERT(std::abs(point.probe(strain).tangent - (forward + backward) / 2) < bend + 1e-8 * stiffness);
  });
}

TEST_CASE("a response leaves the committed history as it was") {
  check_for_all_laws([](const Sample& sample) {
    Point point(sample.law);
    for (const int i : *history_of(10)) point.move(strain_of(sample, i));
    const std::vector<double> before = point.committed();
    const double strain = strain_of(sample, *rc::gen::inRange(-2000, 2001));
    const UniaxialPoint first = point.probe(strain);
    point.probe(-strain);
    RC_ASSERT(point.committed() == before);
    // so that trials may come in any order
    const UniaxialPoint again = point.probe(strain);
    RC_ASSERT(first.stress == again.stress);
    RC_ASSERT(first.tangent == again.tangent);
  });
}

TEST_CASE("the response to the committed strain is the committed stress") {
  check_for_all_laws([](const Sample& sample) {
    Point point(sample.law);
    double strain = 0, stress = point.probe(0).stress;
    for (const int i : *history_of(30)) {
      strain = strain_of(sample, i);
      stress = point.move(strain).stress;
    }
    // curved laws evaluate their curve again, laws in series their equilibrium: rounding of a stress reached over 40 of the sample's strains
    const double roundings = std::holds_alternative<Series>(sample.law) ? sample.conditioning : 100;
    RC_ASSERT(std::abs(point.probe(strain).stress - stress) < roundings * epsilon * sample.stress);
  });
}

TEST_CASE("random histories of a thousand strains stay finite") {
  check_for_all_laws([](const Sample& sample) {
    Point point(sample.law);
    for (const int i : *history_of(1000)) {
      const UniaxialPoint at = point.move(strain_of(sample, i));
      RC_ASSERT(std::isfinite(at.stress));
      RC_ASSERT(std::isfinite(at.tangent));
      // Steel02 may overshoot after partial unloading, never by as much as an elastic line
      RC_ASSERT(std::abs(at.stress) < sample.largest * sample.stress);
    }
    for (const double value : point.committed()) RC_ASSERT(std::isfinite(value));
  });
}

TEST_CASE("laws stay finite through strains that repeat and reverse by rounding errors") {
  for (const Sample& sample : samples()) {
    CAPTURE(std::string(sample.name));
    Point point(sample.law);
    for (const double center : {0.0, 0.5, 3.0, -5.0, 3.0, 0.0}) {
      for (const double offset : {0.0, 1e-16, 0.0, -1e-16, 1e-18, -1e-18, 1e-12, -1e-12, 0.0, 0.0}) {
        const UniaxialPoint at = point.move((center + offset) * sample.strain);
        CHECK(std::isfinite(at.stress));
        CHECK(std::isfinite(at.tangent));
      }
    }
  }
}

TEST_CASE("the initial tangent is that of the virgin law, and its parameters are accepted") {
  for (const Sample& sample : samples()) {
    CAPTURE(std::string(sample.name));
    // the larger one where tension and compression differ
    const Point point(sample.law);
    const double tangent = std::max(point.probe(1e-9 * sample.strain).tangent, point.probe(-1e-9 * sample.strain).tangent);
    CHECK(initial_tangent(sample.law) == doctest::Approx(tangent).epsilon(1e-9));
    CHECK(fault_of(sample.law) == "");
    CHECK(same_law(sample.law, sample.law));
  }
}
