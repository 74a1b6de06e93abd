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

  // What the curve of a branch needs beside its origin is found when it begins.
  template <class T>
  struct History {
    T strain;           // [-], including sigInit / E
    T stress;           // [Pa]
    T least_strain;     // smallest strain at a reversal, at most -fy/E
    T largest_strain;   // largest strain at a reversal, at least fy/E
    T reversal_strain;  // e_r
    T reversal_stress;  // s_r
    T inverse_range;    // 1/(e_0 - e_r), of the branch's sign; 0 before any strain
    T R, inverse_R;     // and 1/R
  };
  History<double> virgin() const { return {sigInit / E, sigInit, -fy / E, fy / E, 0, 0, 0, R0, 1 / R0}; }
  // Without isotropic hardening, a virgin fiber reverses on the elastic line, which meets the asymptotes at +-fy/E
  // whatever it has done: R remains R0, and the curve leaves the line by |e*|^R / R, lost in rounding below 2^-54 / R.
  template <class T>
  struct QuietHistory {
    T asymptote_strain, reversal_strain;
  };
  double quiet_limit(double error) const { return a1 == 0 && a3 == 0 ? std::pow(std::max(error, 0x1p-54), 1 / R0) : 0; }
  History<double> opened(double strain_from_zero, const QuietHistory<double>& quiet) const {
    const double strain = strain_from_zero + sigInit / E, range = quiet.asymptote_strain - quiet.reversal_strain;
    return {strain, E * strain, -fy / E, fy / E, quiet.reversal_strain, E * quiet.reversal_strain, range == 0 ? 0 : 1 / range, R0, 1 / R0};
  }
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

// The branch of a point that has reversed, or was never strained.
template <class T>
HWY_INLINE void start_branch(const Steel02& law, T increment, const Steel02::History<T>& committed, Steel02::History<T>& next) {
  const double E = law.E, hardening = law.b * law.E, yield_strain = law.fy / law.E;
  const T zero(0.0), one(1.0);
  const auto first = committed.inverse_range == zero;
  // 10 machine epsilons: a virgin fiber that has hardly moved has no direction yet, but already its elastic stress:
  // a stress that stays behind would be a jump, on which sections in equilibrium with small forces do not converge
  const auto begins = except(first, abs(increment) < T(2.220446049250313e-15));
  const auto rising = increment > zero, reversed = committed.inverse_range * increment < zero;
  const T sign = select(rising, one, T(-1.0));
  next.least_strain = select(both(reversed, rising), min(committed.least_strain, committed.strain), committed.least_strain);
  next.largest_strain = select(both(reversed, increment < zero), max(committed.largest_strain, committed.strain), committed.largest_strain);
  T shift = one;
  if (law.a1 != 0 || law.a3 != 0) {
    const T excursion = next.largest_strain - next.least_strain;
    shift = one + select(rising, T(law.a3), T(law.a1)) *
                      pow(excursion * select(rising, T(0.5 / (law.a4 * yield_strain)), T(0.5 / (law.a2 * yield_strain))), T(0.8));
  }
  // from the reversal to the shifted asymptote along the elastic line, in the branch's direction: at least what rounding
  // leaves of it when a strain far out on the asymptote reverses twice
  const T outward = shift * T(law.fy * (1 - law.b)) - sign * (committed.stress - T(hardening) * committed.strain);
  const T new_range = sign * max(outward * T(1 / (E - hardening)), T(1e-12 * yield_strain));
  next.reversal_strain = select(reversed, committed.strain, committed.reversal_strain);
  next.reversal_stress = select(reversed, committed.stress, committed.reversal_stress);
  const T range = select(reversed, new_range, sign * T(yield_strain)), asymptote_strain = next.reversal_strain + range;

  // R = R0 above / below with below = cR2 + x, above = cR2 + (1 - cR1) x; one division serves R, 1/R and the range
  const T target_strain = select(rising, next.largest_strain, next.least_strain);
  const T excursion = abs(target_strain - asymptote_strain) * T(1 / yield_strain);
  const T below = T(law.cR2) + excursion, above = mul_add(T(1 - law.cR1), excursion, T(law.cR2));
  const T inverse = one / (above * below * range);
  const auto starts = either(reversed, begins);
  next.R = select(starts, T(law.R0) * above * above * (inverse * range), committed.R);
  next.inverse_R = select(starts, T(1 / law.R0) * below * below * (inverse * range), committed.inverse_R);
  next.inverse_range = select(starts, inverse * above * below, committed.inverse_range);
}

template <class T>
HWY_INLINE Response<T, Steel02> respond(const Steel02& law, T strain_from_zero, const Steel02::History<T>& committed) {
  const T zero(0.0), one(1.0);
  Steel02::History<T> next = committed;
  next.strain = strain_from_zero + T(law.sigInit / law.E);
  const T increment = next.strain - committed.strain;
  if (!all(committed.inverse_range * increment > zero)) start_branch(law, increment, committed, next);

  const T from_reversal = next.strain - next.reversal_strain, ratio = abs(from_reversal * next.inverse_range);
  T curve = one, bend = T(1 - law.b);  // bend = (1 - b) / curve^(1 + 1/R)
  if (!all(next.R * log2_bound(ratio) < T(-54.0))) {  // else |e*|^R is lost against 1 by rounding: a straight line
    const T power = pow(ratio, next.R);
    curve = one + power;
    bend = bend * one_plus_pow(power, one + next.inverse_R);
  }
  const T secant = T(law.E) * mul_add(bend, curve, T(law.b));
  next.stress = mul_add(from_reversal, secant, next.reversal_stress);
  return {next.stress, T(law.E) * (T(law.b) + bend), next};
}

template <class T>
HWY_INLINE auto stays_linear(const Steel02& law, double limit, T before_from_zero, T strain_from_zero,
                             Steel02::QuietHistory<T>& quiet) {
  const T zero(0.0), before = before_from_zero + T(law.sigInit / law.E), strain = strain_from_zero + T(law.sigInit / law.E);
  const T increment = strain - before, range = quiet.asymptote_strain - quiet.reversal_strain;
  // as in respond(), branch by branch
  const auto first = range == zero;
  const auto unmoved = both(first, abs(increment) < T(2.220446049250313e-15));
  const auto reversed = range * increment < zero;
  const T yield_strain(law.fy / law.E), target = select(increment > zero, yield_strain, -yield_strain);
  quiet.reversal_strain = select(reversed, before, quiet.reversal_strain);
  quiet.asymptote_strain = select(unmoved, zero, select(either(first, reversed), target, quiet.asymptote_strain));
  const T room = T(limit) * abs(quiet.asymptote_strain - quiet.reversal_strain);
  return either(unmoved, abs(strain - quiet.reversal_strain) < room);
}

// On the way the fiber may reverse, at a strain that is by no more than the reach nearer to the asymptote.
template <class T>
HWY_INLINE T linear_reach(const Steel02& law, double limit, T strain_from_zero, const Steel02::QuietHistory<T>& quiet) {
  const T strain = strain_from_zero + T(law.sigInit / law.E), yield_strain(law.fy / law.E), zero(0.0);
  const T kept = abs(quiet.asymptote_strain - quiet.reversal_strain), range = select(kept == zero, yield_strain - abs(quiet.reversal_strain), kept);
  const T going_on = T(limit) * range - abs(strain - quiet.reversal_strain);
  return min(going_on, T(limit / (1 + limit)) * (yield_strain - abs(strain)));
}

}  // namespace HWY_NAMESPACE
}  // namespace nsframe
HWY_AFTER_NAMESPACE();

#endif
