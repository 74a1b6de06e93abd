// What every uniaxial law shares: the form of its answer. A law is a struct of parameters with
//   name                    as scene files call it; laws may share a name: a scene gets the first that knows all its
//                           keys, so that a rarely used option doesn't cost every point its history
//   variety                 optional: what tells it from others of its name, for the reference
//   visit_parameters()      its parameters with text, quantity and range (materials/parameter.hpp)
//   check()                 optional: rules across parameters; throws std::invalid_argument by require(), the message
//                           beginning with the name of a parameter
//   History<T>              what a material point remembers; members of type T only
//   virgin()                the history of a point that was never strained
//   initial_tangent(), yield_strain()
//   is_linear()             optional: true when stress is proportional to strain for ever
//   has_yielded(strain, stress)   optional: in place of the plastic strain against the yield strain
// and a free function template respond(law, strain, committed) written for any number type T of materials/number.hpp:
// `double` gives the scalar definition, `Lanes` the SIMD kernel of fiber sections. The function stands in
// HWY_NAMESPACE, because it is compiled once for every instruction set. Registered in materials/laws.hpp.
//
// A law whose virgin fibers are linear to rounding at small strains can take part in the screening of fiber sections
// (elements/screening.hpp). It then also has
//   QuietHistory<T>         what of its history changes there, at most as many members (all of type T) as History
//   quiet_limit(error)      for stays_linear() to hold where the stress leaves the line by less than this, relative to
//                           itself, or by rounding; 0 where these parameters allow no screening
//   opened(strain, quiet)   the whole history at a strain
// and a function stays_linear(law, limit, before, strain, quiet) beside respond(): the mask of fibers that are linear at
// `strain`, having been at the strain `before`; brings `quiet` to the new strain. And linear_reach(law, limit, strain, quiet): while
// the strain moves from there by less than that, forth and back summed up, stays_linear() holds for certain.
#pragma once

#include <limits>

#include "materials/parameter.hpp"

namespace nsframe {

template <class T, class Law>
struct Response {
  T stress;                                  // [Pa]
  T tangent;                                 // [Pa]
  typename Law::template History<T> history; // at the trial strain
};

// A piece of a law without memory: stress and tangent [Pa].
template <class T>
struct Branch {
  T stress, tangent;
};

// Doubles that a point of this law remembers.
template <class Law>
constexpr int history_doubles = static_cast<int>(sizeof(typename Law::template History<double>) / sizeof(double));

}  // namespace nsframe
