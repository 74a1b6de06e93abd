// Wrappers: laws around other laws. They are evaluated on arrays of points, so that the laws inside run as SIMD
// kernels; the wrapper's own arithmetic is the same plain doubles for one point and for many.
//
// A wrapper has, in place of History, virgin() and the free respond() of plain laws (law.hpp):
//   history_size(), initialize_history(history)    as the functions of uniaxial.hpp
//   respond(points, evaluate)                       evaluate() answers for a law inside, at most wrapped_points at a time
#pragma once

#include <memory>
#include <vector>

#include "base/diagnostics.hpp"
#include "materials/law.hpp"

namespace nsframe {

struct WrappedLaw;  // a UniaxialLaw, see uniaxial.hpp

// A law inside another, by its name in the scene until it is resolved.
struct InnerLaw {
  Reference reference;
  std::shared_ptr<const WrappedLaw> law;  // null until resolved
};

// Material points of one law. Component k of the history of point i stands at k * stride + i.
struct PointArrays {
  int count = 0;
  const double* strain = nullptr;
  const double* committed = nullptr;
  double* trial = nullptr;
  int stride = 0;
  double* stress = nullptr;   // [Pa]
  double* tangent = nullptr;  // [Pa]

  // The same points for a law inside, whose history begins at component `first`.
  PointArrays inside(int first, const double* strains, double* stresses, double* tangents) const {
    return {count, strains, committed + first * stride, trial + first * stride, stride, stresses, tangents};
  }
  // One of them.
  PointArrays point(int i) const {
    return {1, strain + i, committed + i, trial + i, stride, stress + i, tangent + i};
  }
  // Keeps the committed history of a point from component `first` to `end`.
  void keep(int i, int first, int end) const {
    for (int k = first; k < end; ++k) trial[k * stride + i] = committed[k * stride + i];
  }
};

inline constexpr int wrapped_points = 64;

using Evaluate = void (*)(const WrappedLaw&, const PointArrays&);

template <class Law>
concept PlainLaw = requires { typename Law::template History<double>; };

inline void require_in_range(const Parameter&, const InnerLaw&) {}

namespace parameter {
constexpr Parameter law_inside(std::string_view name, std::string_view text) {
  return required({name, text});
}
}  // namespace parameter

}  // namespace nsframe
