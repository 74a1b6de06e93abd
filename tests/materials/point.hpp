// A material point, the sample laws that the property tests run over, and comparison with reference histories.
#pragma once

#include <rapidcheck.h>

#include <cmath>
#include <vector>

#include "materials/uniaxial.hpp"
#include "tests/support/numbers.hpp"
#include "tests/support/reference_data.hpp"

namespace nsframe::test {

constexpr double fy = 235e6, E = 210e9, b = 0.01, yield = fy / E;  // [Pa], [Pa], [-], [-]

// A material point that commits every strain it is given.
class Point {
 public:
  explicit Point(UniaxialLaw law) : law_(std::move(law)), committed_(history()), trial_(history()) {
    initialize_history(law_, committed_.data());
  }
  // Response at a trial strain; nothing is committed.
  UniaxialPoint probe(double strain) const {
    std::vector<double> scratch(committed_.size());
    return respond(law_, strain, committed_.data(), scratch.data());
  }
  UniaxialPoint move(double strain) {
    const UniaxialPoint point = respond(law_, strain, committed_.data(), trial_.data());
    std::swap(committed_, trial_);
    return point;
  }
  const std::vector<double>& committed() const { return committed_; }

 private:
  std::vector<double> history() const { return std::vector<double>(static_cast<std::size_t>(history_size(law_))); }
  UniaxialLaw law_;
  std::vector<double> committed_, trial_;
};

// A law with the scale of its strains and stresses, so that random histories reach all its branches.
struct Sample {
  const char* name;
  UniaxialLaw law;
  double strain = yield;         // histories go 20 of these to either side
  double stress = fy;            // of which roundings are measured
  double largest = 22;           // bound of |stress| in such a history, in units of `stress`
  double conditioning = 0;       // by how much a rounding may grow: |p log x| of a power x^p, or a trial stress over the
                                 // peak stress; 0 for laws of sums, products and choices
};

// Every law of the registry is in it at least once; see samples.cpp.
const std::vector<Sample>& samples();

// Strains in hundredths of the sample's, up to 20 of them to either side.
inline rc::Gen<std::vector<int>> history_of(std::size_t points) {
  return rc::gen::container<std::vector<int>>(points, rc::gen::inRange(-2000, 2001));
}

// Largest differences to a reference history, relative to its largest stress and to the initial tangent.
struct Difference {
  double stress = 0, tangent = 0;
};
Difference compare_history(const UniaxialLaw& law, const std::string& file);

// What check_parameters() says; empty when it accepts.
std::string fault_of(const UniaxialLaw& law);

}  // namespace nsframe::test
