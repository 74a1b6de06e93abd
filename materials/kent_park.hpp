// The compression envelope of Kent and Park (1971) as modified by Scott, Park and Priestley (1982): a parabola up to
// the strength fpc at epsc0, a line down to fpcu at epsU, constant beyond. Compression is negative.
#if defined(NSFRAME_MATERIALS_KENT_PARK_HPP) == defined(HWY_TARGET_TOGGLE)
#ifdef NSFRAME_MATERIALS_KENT_PARK_HPP
#undef NSFRAME_MATERIALS_KENT_PARK_HPP
#else
#define NSFRAME_MATERIALS_KENT_PARK_HPP
#endif

#include "materials/law.hpp"
#include "materials/number.hpp"

#ifndef NSFRAME_MATERIALS_KENT_PARK_PARAMETERS
#define NSFRAME_MATERIALS_KENT_PARK_PARAMETERS
namespace nsframe {

struct KentPark {
  double fpc, epsc0;  // strength [Pa] and its strain [-]
  double fpcu, epsU;  // crushing strength [Pa] and its strain [-]
  double initial_tangent() const { return 2 * fpc / epsc0; }
  double softening() const { return (fpcu - fpc) / (epsU - epsc0); }
  void check() const {
    require(fpc < 0, "fpc must not be 0");
    require(epsc0 < 0, "epsc0 must not be 0");
    require(epsU < epsc0, "epsU must be farther out than epsc0");
  }
};

// Of parameters of either sign, as OpenSees takes them.
inline KentPark kent_park(double fpc, double epsc0, double fpcu, double epsU) {
  return {-std::abs(fpc), -std::abs(epsc0), -std::abs(fpcu), -std::abs(epsU)};
}

}  // namespace nsframe
#endif

HWY_BEFORE_NAMESPACE();
namespace nsframe {
namespace HWY_NAMESPACE {

// At strain <= 0.
template <class T>
HWY_INLINE Branch<T> respond(const KentPark& envelope, T strain) {
  const T ratio = strain * T(1 / envelope.epsc0);
  const auto rising = strain >= T(envelope.epsc0), crushed = strain <= T(envelope.epsU);
  const T parabola = T(envelope.fpc) * ratio * (T(2.0) - ratio);
  const T line = T(envelope.fpc) + T(envelope.softening()) * (strain - T(envelope.epsc0));
  const T stress = select(rising, parabola, select(crushed, T(envelope.fpcu), line));
  const T slope = select(crushed, T(0.0), T(envelope.softening()));
  return {stress, select(rising, T(envelope.initial_tangent()) * (T(1.0) - ratio), slope)};
}

}  // namespace HWY_NAMESPACE
}  // namespace nsframe
HWY_AFTER_NAMESPACE();

#endif
