// Steel01 with isotropic hardening: its yield lines move outwards at every reversal by
//   shift = 1 + a ((largest - least strain)/(2 a' fy/E))^0.8,  a, a' = a1, a2 in compression and a3, a4 in tension.
// A law of its own, because it remembers more than Steel01 and costs more; scenes call both Steel01.
// Differs from OpenSees in one point: the shift acts from the reversal on. There it acts from the second strain
// after it, so that a reversal and the yielding after it in one step still meet the old line.
#if defined(NSFRAME_MATERIALS_STEEL01_ISOTROPIC_HPP) == defined(HWY_TARGET_TOGGLE)
#ifdef NSFRAME_MATERIALS_STEEL01_ISOTROPIC_HPP
#undef NSFRAME_MATERIALS_STEEL01_ISOTROPIC_HPP
#else
#define NSFRAME_MATERIALS_STEEL01_ISOTROPIC_HPP
#endif

#include "materials/law.hpp"
#include "materials/number.hpp"

#ifndef NSFRAME_MATERIALS_STEEL01_ISOTROPIC_PARAMETERS
#define NSFRAME_MATERIALS_STEEL01_ISOTROPIC_PARAMETERS
namespace nsframe {

struct Steel01Isotropic {
  static constexpr const char* name = "Steel01";
  static constexpr const char* variety = "with isotropic hardening";
  double fy = 0;   // [Pa]
  double E = 0;    // [Pa]
  double b = 0;    // hardening ratio [-]
  double a1 = 0;   // shift in compression [-]
  double a2 = 55;  // [-]
  double a3 = 0;   // shift in tension [-]
  double a4 = 55;  // [-]

  template <class Visit, class Law>
  static void visit_parameters(Visit&& visit, Law& law) {
    using namespace parameter;
    visit(required(stress("fy", "yield stress", range::positive)), law.fy);
    visit(required(stress("E", "elastic modulus", range::positive)), law.E);
    visit(number("b", "hardening ratio", range::below_one), law.b);
    visit(number("a1", "isotropic hardening in compression", range::non_negative), law.a1);
    visit(number("a2", "its excursion in yield strains", range::positive), law.a2);
    visit(number("a3", "isotropic hardening in tension", range::non_negative), law.a3);
    visit(number("a4", "its excursion in yield strains", range::positive), law.a4);
  }
  template <class T>
  struct History {
    T strain;          // [-]
    T stress;          // [Pa]
    T least_strain;    // at a reversal, at most 0
    T largest_strain;  // at a reversal, at least 0
    T direction;       // 0 before any strain, then +1 or -1
    T reversals;       // 0 before the first, then 1
  };
  History<double> virgin() const { return {0, 0, 0, 0, 0, 0}; }
  double initial_tangent() const { return E; }
  double yield_strain() const { return fy / E; }
};

}  // namespace nsframe
#endif

HWY_BEFORE_NAMESPACE();
namespace nsframe {
namespace HWY_NAMESPACE {

template <class T>
HWY_INLINE Response<T, Steel01Isotropic> respond(const Steel01Isotropic& law, T strain,
                                                 const Steel01Isotropic::History<T>& committed) {
  const T zero(0.0), one(1.0);
  const double yield = law.fy / law.E;
  const T increment = strain - committed.strain;
  const auto rising = increment > zero, falling = increment < zero;
  Steel01Isotropic::History<T> h = committed;
  const auto reversed = committed.direction * increment < zero;
  h.largest_strain = select(both(reversed, falling), max(h.largest_strain, committed.strain), h.largest_strain);
  h.least_strain = select(both(reversed, rising), min(h.least_strain, committed.strain), h.least_strain);
  h.direction = select(rising, one, select(falling, -one, h.direction));
  h.reversals = select(reversed, one, h.reversals);
  const auto upwards = h.direction > zero;
  // only the line ahead can be met
  const T excursion = (h.largest_strain - h.least_strain) *
                      select(upwards, T(0.5 / (law.a4 * yield)), T(0.5 / (law.a2 * yield)));
  const T shift = one + h.reversals * select(upwards, T(law.a3), T(law.a1)) * pow(excursion, T(0.8));
  const T trial = committed.stress + T(law.E) * increment;
  const T middle = T(law.b * law.E) * strain, half_width = shift * T(law.fy * (1 - law.b));
  const T stress = select(upwards, min(middle + half_width, trial), max(middle - half_width, trial));
  h.strain = strain;
  h.stress = stress;
  return {stress, select(stress == trial, T(law.E), T(law.b * law.E)), h};
}

}  // namespace HWY_NAMESPACE
}  // namespace nsframe
HWY_AFTER_NAMESPACE();

#endif
