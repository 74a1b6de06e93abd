// Any uniaxial law behind one set of functions. The laws are listed in laws.hpp.
#pragma once

#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "materials/laws.hpp"

namespace nsframe {

// The law that a wrapper holds (wrapper.hpp).
struct WrappedLaw {
  UniaxialLaw law;
};
InnerLaw inner(UniaxialLaw law);

struct UniaxialPoint {
  double stress = 0;   // [Pa] (or force, in a spring)
  double tangent = 0;  // [Pa]
};

// Number of history doubles a material point of this law keeps; max_history at most, which build_model() checks.
int history_size(const UniaxialLaw& law);
inline constexpr int max_history = 128;

// Virgin history, history_size(law) doubles.
void initialize_history(const UniaxialLaw& law, double* history);

// Stress and tangent at `strain`, from the committed history of the last accepted state; writes the history at the
// trial strain. `committed` is not changed; both hold history_size(law) doubles and may not overlap.
UniaxialPoint respond(const UniaxialLaw& law, double strain, const double* committed, double* trial);

// The same for many points at once: the definition in plain doubles, and the SIMD kernel for the instruction set of
// this machine (array_kernel.cpp).
void respond_points(const UniaxialLaw& law, const PointArrays& points);
void respond_points_simd(const UniaxialLaw& law, const PointArrays& points);

// Tangent of the virgin law at zero strain [Pa].
double initial_tangent(const UniaxialLaw& law);

// Strain at first yield in either direction [-]; infinity for a law that does not yield.
double yield_strain(const UniaxialLaw& law);

// True when the law's stress is proportional to strain for ever.
bool is_linear(const UniaxialLaw& law);

// True when the plastic strain |e - s/E| exceeds a tenth of the yield strain.
bool has_yielded(const UniaxialLaw& law, double strain, double stress);

// The same for laws inside wrappers.
inline int history_size(const InnerLaw& law) { return history_size(law.law->law); }
inline void initialize_history(const InnerLaw& law, double* history) { initialize_history(law.law->law, history); }
inline double initial_tangent(const InnerLaw& law) { return initial_tangent(law.law->law); }
inline double yield_strain(const InnerLaw& law) { return yield_strain(law.law->law); }

// True when the stress depends on the rate of strain: respond() is then the law at rest (rate.hpp).
bool is_rate_dependent(const UniaxialLaw& law);

// The stress of a rate-dependent law over a time step that leads from the committed history to `strain`; writes the
// trial history. Zero for other laws, whose history stays as it is.
RatePoint respond_rate(const UniaxialLaw& law, double strain, const double* committed, double* trial, const StepSpan& step);

// Stress that the last time step left in the history of a rate-dependent law [Pa]; zero for others.
double rate_stress(const UniaxialLaw& law, const double* history);

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

// Calls visit(InnerLaw&) for the laws right inside a wrapper; Law may be const.
template <class Law, class Visit>
void for_each_inner(Law& law, Visit&& visit) {
  const auto one = [&visit](auto& value) {
    if constexpr (std::is_same_v<std::decay_t<decltype(value)>, InnerLaw>) visit(value);
  };
  std::visit(
      [&one](auto& l) {
        std::decay_t<decltype(l)>::visit_parameters(
            [&one](const Parameter&, auto& value) {
              if constexpr (requires { value.data(); })
                for (auto& item : value) one(item);
              else
                one(value);
            },
            l);
      },
      law);
}

// Names for scenes, each once.
std::vector<std::string> law_names();

}  // namespace nsframe
