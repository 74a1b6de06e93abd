// Bilinear steel with kinematic hardening (OpenSees' Steel01 without its isotropic parameters): the elastic trial
// stress is held between two parallel lines of slope b E through +-fy at the yield strain.
#if defined(NSFRAME_MATERIALS_STEEL01_HPP) == defined(HWY_TARGET_TOGGLE)
#ifdef NSFRAME_MATERIALS_STEEL01_HPP
#undef NSFRAME_MATERIALS_STEEL01_HPP
#else
#define NSFRAME_MATERIALS_STEEL01_HPP
#endif

#include "materials/law.hpp"
#include "materials/number.hpp"

#ifndef NSFRAME_MATERIALS_STEEL01_PARAMETERS
#define NSFRAME_MATERIALS_STEEL01_PARAMETERS
namespace nsframe {

struct Steel01 {
  static constexpr const char* name = "Steel01";
  double fy = 0;  // [Pa]
  double E = 0;   // [Pa]
  double b = 0;   // hardening ratio [-]

  template <class T>
  struct History {
    T strain;  // [-]
    T stress;  // [Pa]
  };
  History<double> virgin() const { return {0, 0}; }
  template <class T>
  struct QuietHistory {};
  double quiet_limit(double) const { return 1; }
  History<double> opened(double strain, const QuietHistory<double>&) const { return {strain, E * strain}; }
  double initial_tangent() const { return E; }
  double yield_strain() const { return fy / E; }
  template <class Visit, class Law>
  static void visit_parameters(Visit&& visit, Law& law) {
    using namespace parameter;
    visit(required(stress("fy", "yield stress", range::positive)), law.fy);
    visit(required(stress("E", "elastic modulus", range::positive)), law.E);
    visit(number("b", "hardening ratio", range::below_one), law.b);
  }
};

}  // namespace nsframe
#endif

HWY_BEFORE_NAMESPACE();
namespace nsframe {
namespace HWY_NAMESPACE {

template <class T>
HWY_INLINE Response<T, Steel01> respond(const Steel01& law, T strain, const Steel01::History<T>& committed) {
  const T trial = committed.stress + T(law.E) * (strain - committed.strain);
  const T middle = T(law.b * law.E) * strain;
  const T half_width = T(law.fy * (1 - law.b));
  const T stress = max(middle - half_width, min(middle + half_width, trial));
  return {stress, select(stress == trial, T(law.E), T(law.b * law.E)), {strain, stress}};
}

template <class T>
HWY_INLINE auto stays_linear(const Steel01& law, double, T, T strain, Steel01::QuietHistory<T>&) {
  return abs(strain) < T(law.fy / law.E);
}

template <class T>
HWY_INLINE T linear_reach(const Steel01& law, double, T strain, const Steel01::QuietHistory<T>&) {
  return T(law.fy / law.E) - abs(strain);
}

}  // namespace HWY_NAMESPACE
}  // namespace nsframe
HWY_AFTER_NAMESPACE();

#endif
