// What every uniaxial law shares: the form of its answer and the checks of its parameters.
//
// A law is a struct of parameters with `name`, `History<T>` (members of type T only), `virgin()`, `initial_tangent()`,
// `yield_strain()` and `check()`, and a free function template respond(law, strain, committed) written for any number
// type T of materials/number.hpp: `double` gives the scalar definition, `Lanes` the SIMD kernel of fiber sections.
// The function stands in HWY_NAMESPACE, because it is compiled once for every instruction set.
#pragma once

#include <limits>
#include <stdexcept>
#include <string>

namespace nsframe {

template <class T, class Law>
struct Response {
  T stress;                                  // [Pa]
  T tangent;                                 // [Pa]
  typename Law::template History<T> history; // at the trial strain
};

inline void require(bool valid, const std::string& rule) {
  if (!valid) throw std::invalid_argument(rule);
}
inline void require_positive(double value, const std::string& parameter) {
  require(value > 0, parameter + " must be positive");
}

}  // namespace nsframe
