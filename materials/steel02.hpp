// Giuffre-Menegotto-Pinto steel with optional isotropic hardening by shifting the yield asymptotes (Filippou, Popov,
// Bertero 1983; OpenSees' Steel02):
//   s* = b e* + (1 - b) e* / (1 + |e*|^R)^(1/R),   e* = (e - e_r)/(e_0 - e_r),   s* = (s - s_r)/(s_0 - s_r),
// (e_r, s_r) the last reversal, (e_0, s_0) where the elastic line through it meets the yield asymptote, and
// R = R0 (1 - cR1 x/(cR2 + x)) with x the plastic excursion in yield strains.
#if defined(NSFRAME_MATERIALS_STEEL02_HPP) == defined(HWY_TARGET_TOGGLE)
#ifdef NSFRAME_MATERIALS_STEEL02_HPP
#undef NSFRAME_MATERIALS_STEEL02_HPP
#else
#define NSFRAME_MATERIALS_STEEL02_HPP
#endif

#include "materials/law.hpp"
#include "materials/number.hpp"

#ifndef NSFRAME_MATERIALS_STEEL02_PARAMETERS
#define NSFRAME_MATERIALS_STEEL02_PARAMETERS
namespace nsframe {

struct Steel02 {
  static constexpr const char* name = "Steel02";
  double fy = 0;         // [Pa]
  double E = 0;          // [Pa]
  double b = 0;          // hardening ratio [-]
  double R0 = 20;        // curvature of the first loading [-]
  double cR1 = 0.925;    // its decay with plastic excursion [-]
  double cR2 = 0.15;     // [-]
  double a1 = 0;         // isotropic hardening in compression, times (excursion/(2 a2 yield strain))^0.8 [-]
  double a2 = 1;         // [-]
  double a3 = 0;         // isotropic hardening in tension [-]
  double a4 = 1;         // [-]
  double sigInit = 0;    // initial stress [Pa]

  template <class T>
  struct History {
    T strain;           // [-], including sigInit / E
    T stress;           // [Pa]
    T least_strain;     // smallest strain at a reversal, at most -fy/E
    T largest_strain;   // largest strain at a reversal, at least fy/E
    T target_strain;    // extreme strain towards which the branch runs
    T asymptote_strain; // e_0
    T asymptote_stress; // s_0
    T reversal_strain;  // e_r
    T reversal_stress;  // s_r
    T direction;        // 0 before any strain, then +1 or -1
  };
  History<double> virgin() const { return {sigInit / E, sigInit, -fy / E, fy / E, 0, 0, 0, 0, 0, 0}; }
  double initial_tangent() const { return E; }
  double yield_strain() const { return fy / E; }
  bool has_yielded(double strain, double stress) const {
    return std::abs(strain + (sigInit - stress) / E) > 0.1 * yield_strain();
  }

  template <class Visit, class Law>
  static void visit_parameters(Visit&& visit, Law& law) {
    using namespace parameter;
    visit(required(stress("fy", "yield stress", range::positive)), law.fy);
    visit(required(stress("E", "elastic modulus", range::positive)), law.E);
    visit(number("b", "hardening ratio", range::below_one), law.b);
    visit(number("R0", "curvature of the first loading", range::positive), law.R0);
    visit(number("cR1", "decay of the curvature with plastic excursion", {0, 1, false, true}), law.cR1);
    visit(number("cR2", "the same", range::positive), law.cR2);
    visit(number("a1", "isotropic hardening in compression"), law.a1);
    visit(number("a2", "its excursion in yield strains", range::positive), law.a2);
    visit(number("a3", "isotropic hardening in tension"), law.a3);
    visit(number("a4", "its excursion in yield strains", range::positive), law.a4);
    visit(stress("sigInit", "initial stress"), law.sigInit);
  }
};

}  // namespace nsframe
#endif

HWY_BEFORE_NAMESPACE();
namespace nsframe {
namespace HWY_NAMESPACE {

template <class T>
HWY_INLINE Response<T, Steel02> respond(const Steel02& law, T strain_from_zero, const Steel02::History<T>& committed) {
  const double E = law.E, hardening = law.b * law.E, yield_strain = law.fy / law.E;
  const T zero(0.0), one(1.0);
  const T strain = strain_from_zero + T(law.sigInit / E);
  const T increment = strain - committed.strain;
  // 10 machine epsilons: a virgin fiber that has hardly moved has no direction yet, but already its elastic stress:
  // a stress that stays behind would be a jump, on which sections in equilibrium with small forces do not converge
  const auto unmoved = both(committed.direction == zero, abs(increment) < T(2.220446049250313e-15));
  const auto rising = increment > zero;
  const T sign = select(rising, one, T(-1.0));

  Steel02::History<T> h = committed;
  const auto first = committed.direction == zero;
  h.direction = select(first, sign, h.direction);
  h.asymptote_strain = select(first, sign * T(yield_strain), h.asymptote_strain);
  h.asymptote_stress = select(first, sign * T(law.fy), h.asymptote_stress);
  h.target_strain = select(first, sign * T(yield_strain), h.target_strain);

  const auto reversed = h.direction * increment < zero;
  h.least_strain = select(both(reversed, rising), min(h.least_strain, committed.strain), h.least_strain);
  h.largest_strain = select(both(reversed, increment < zero), max(h.largest_strain, committed.strain), h.largest_strain);
  T shift = one;
  if (law.a1 != 0 || law.a3 != 0) {
    const T excursion = h.largest_strain - h.least_strain;
    shift = one + select(rising, T(law.a3), T(law.a1)) *
                      pow(excursion * select(rising, T(0.5 / (law.a4 * yield_strain)), T(0.5 / (law.a2 * yield_strain))), T(0.8));
  }
  const T yield_stress = sign * shift * T(law.fy), shifted_strain = sign * shift * T(yield_strain);
  const T meeting_strain =
      (yield_stress - T(hardening) * shifted_strain - committed.stress + T(E) * committed.strain) * T(1 / (E - hardening));
  const T meeting_stress = yield_stress + T(hardening) * (meeting_strain - shifted_strain);
  h.reversal_strain = select(reversed, committed.strain, h.reversal_strain);
  h.reversal_stress = select(reversed, committed.stress, h.reversal_stress);
  h.asymptote_strain = select(reversed, meeting_strain, h.asymptote_strain);
  h.asymptote_stress = select(reversed, meeting_stress, h.asymptote_stress);
  h.target_strain = select(reversed, select(rising, h.largest_strain, h.least_strain), h.target_strain);
  h.direction = select(reversed, sign, h.direction);

  // R = R0 above / below with below = cR2 + x, above = cR2 + (1 - cR1) x; one division serves R, 1/R and e*
  const T excursion = abs(h.target_strain - h.asymptote_strain) * T(1 / yield_strain);
  const T below = T(law.cR2) + excursion, above = T(law.cR2) + T(1 - law.cR1) * excursion;
  const T strain_range = h.asymptote_strain - h.reversal_strain, stress_range = h.asymptote_stress - h.reversal_stress;
  const T inverse = one / (above * below * strain_range);
  const T R = T(law.R0) * above * above * (inverse * strain_range);
  const T inverse_R = T(1 / law.R0) * below * below * (inverse * strain_range);
  const T inverse_range = inverse * above * below;
  const T ratio = (strain - h.reversal_strain) * inverse_range;
  T curve = one, bend = T(1 - law.b);  // bend = (1 - b) / curve^(1 + 1/R)
  if (!all(R * log2_bound(abs(ratio)) < T(-54.0))) {  // else |e*|^R is lost against 1 by rounding: a straight line
    curve = one + pow(abs(ratio), R);
    bend = bend * pow(curve, -(one + inverse_R));
  }
  const T stress = h.reversal_stress + stress_range * ratio * (T(law.b) + bend * curve);
  const T tangent = (T(law.b) + bend) * (stress_range * inverse_range);

  h.strain = strain;
  h.stress = select(unmoved, committed.stress + T(E) * increment, stress);
  h.direction = select(unmoved, zero, h.direction);
  return {h.stress, select(unmoved, T(E), tangent), h};
}

}  // namespace HWY_NAMESPACE
}  // namespace nsframe
HWY_AFTER_NAMESPACE();

#endif
