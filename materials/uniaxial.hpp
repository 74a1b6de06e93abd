// Any uniaxial law behind one set of functions. The laws are listed in laws.hpp.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "materials/laws.hpp"

namespace nsframe {

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

// Throws std::invalid_argument that begins with the name of the first parameter outside its range.
void check_parameters(const UniaxialLaw& law);

// True when both are the same law with the same parameters.
bool same_law(const UniaxialLaw& a, const UniaxialLaw& b);

// Calls visit(const Law&) with a default-made law of every kind, in the order of the registry.
template <class Visit>
void for_each_law(Visit&& visit) {
  [&]<std::size_t... index>(std::index_sequence<index...>) {
    (visit(std::variant_alternative_t<index, UniaxialLaw>{}), ...);
  }(std::make_index_sequence<std::variant_size_v<UniaxialLaw>>());
}

std::vector<std::string> law_names();

}  // namespace nsframe
