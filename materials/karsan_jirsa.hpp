// Where concrete unloads to after Karsan and Jirsa (1969): from the least strain e_m in a line to zero stress at e_p,
//   e_p/epsc0 = 0.145 x^2 + 0.13 x for x = e_m/epsc0 < 2, else 0.707 (x - 2) + 0.834; x stays at epsU/epsc0 below epsU,
// unless that line were steeper than the initial tangent, which then takes its place. Compression is negative.
#if defined(NSFRAME_MATERIALS_KARSAN_JIRSA_HPP) == defined(HWY_TARGET_TOGGLE)
#ifdef NSFRAME_MATERIALS_KARSAN_JIRSA_HPP
#undef NSFRAME_MATERIALS_KARSAN_JIRSA_HPP
#else
#define NSFRAME_MATERIALS_KARSAN_JIRSA_HPP
#endif

#include "materials/law.hpp"
#include "materials/number.hpp"

#ifndef NSFRAME_MATERIALS_KARSAN_JIRSA_PARAMETERS
#define NSFRAME_MATERIALS_KARSAN_JIRSA_PARAMETERS
namespace nsframe {

struct KarsanJirsa {
  double epsc0, epsU, Ec;  // [-], [-], [Pa]
};

}  // namespace nsframe
#endif

HWY_BEFORE_NAMESPACE();
namespace nsframe {
namespace HWY_NAMESPACE {

template <class T>
struct UnloadingLine {
  T plastic_strain, slope;  // e_p [-], [Pa]
};

// From the least strain and its stress, both <= 0.
template <class T>
HWY_INLINE UnloadingLine<T> unload(const KarsanJirsa& rule, T least, T stress) {
  const T ratio = max(least, T(rule.epsU)) * T(1 / rule.epsc0);
  const T plastic = T(rule.epsc0) * select(ratio < T(2.0), ratio * (T(0.145) * ratio + T(0.13)),
                                           T(0.707) * (ratio - T(2.0)) + T(0.834));
  const T recovered = min(least - plastic, stress * T(1 / rule.Ec));  // both are negative
  const auto none = recovered >= T(0.0);
  return {least - recovered, select(none, T(rule.Ec), stress / select(none, T(-1.0), recovered))};
}

// Compression of a concrete whose envelope at `strain` <= 0 is given; History has least_strain, plastic_strain and
// unloading_slope, and is carried on.
template <class T, class History>
HWY_INLINE Branch<T> compress(const KarsanJirsa& rule, T strain, const Branch<T>& envelope, History& history) {
  const auto deeper = strain <= history.least_strain;
  const T closing = strain - history.plastic_strain;
  const auto open = closing >= T(0.0);
  const Branch<T> answer{select(deeper, envelope.stress, select(open, T(0.0), history.unloading_slope * closing)),
                         select(deeper, envelope.tangent, select(open, T(0.0), history.unloading_slope))};
  const UnloadingLine<T> line = unload(rule, strain, envelope.stress);
  history.least_strain = min(strain, history.least_strain);
  history.plastic_strain = select(deeper, line.plastic_strain, history.plastic_strain);
  history.unloading_slope = select(deeper, line.slope, history.unloading_slope);
  return answer;
}

}  // namespace HWY_NAMESPACE
}  // namespace nsframe
HWY_AFTER_NAMESPACE();

#endif
