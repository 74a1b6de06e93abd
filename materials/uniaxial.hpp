// The registry of uniaxial laws. A new law is one header (law.hpp says what it holds), its line in laws.hpp and in
// UniaxialLaw, its fields in the scene schema, and one test.
#pragma once

#include <string>
#include <variant>

#include "materials/laws.hpp"

namespace nsframe {

using UniaxialLaw = std::variant<Elastic, ElasticPP, Steel01, Steel02>;

struct UniaxialPoint {
  double stress = 0;   // [Pa] (or force, in a spring)
  double tangent = 0;  // [Pa]
};

// Number of history doubles a material point of this law keeps.
int history_size(const UniaxialLaw& law);

// Virgin history, history_size(law) doubles.
void initialize_history(const UniaxialLaw& law, double* history);

// Stress and tangent at `strain`, from the committed history of the last accepted state; writes the history at the
// trial strain. `committed` is not changed; both hold history_size(law) doubles and may not overlap.
UniaxialPoint respond(const UniaxialLaw& law, double strain, const double* committed, double* trial);

// Tangent of the virgin law at zero strain [Pa].
double initial_tangent(const UniaxialLaw& law);

// Strain at first yield in either direction [-]; infinity for a law that does not yield.
double yield_strain(const UniaxialLaw& law);

// True when the law's stress is proportional to strain for ever.
bool is_linear(const UniaxialLaw& law);

// Throws std::invalid_argument that names the first parameter outside its range.
void check_parameters(const UniaxialLaw& law);

}  // namespace nsframe
