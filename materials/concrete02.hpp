// Concrete after Yassin (1994; OpenSees' Concrete02): the Kent-Park envelope in compression, tension with linear
// softening, and between them unloading and reloading lines through one common point R of the compression side,
// compression being negative and parameters of either sign taken as compression:
//   R lies on the initial tangent through the origin and on the line of slope lambda Ec through (epsU, fpcu).
// From the least strain e_m on the envelope the line to R meets zero stress at e_t. Above e_t tension begins; below,
// the elastic trial stress is held between the reloading line (through e_m, slope Er) and half of it (slope Er/2 at
// e_t).
#if defined(NSFRAME_MATERIALS_CONCRETE02_HPP) == defined(HWY_TARGET_TOGGLE)
#ifdef NSFRAME_MATERIALS_CONCRETE02_HPP
#undef NSFRAME_MATERIALS_CONCRETE02_HPP
#else
#define NSFRAME_MATERIALS_CONCRETE02_HPP
#endif

#include "materials/kent_park.hpp"
#include "materials/law.hpp"
#include "materials/number.hpp"

#ifndef NSFRAME_MATERIALS_CONCRETE02_PARAMETERS
#define NSFRAME_MATERIALS_CONCRETE02_PARAMETERS
namespace nsframe {

struct Concrete02 {
  static constexpr const char* name = "Concrete02";
  double fpc = 0;             // compressive strength [Pa]
  double epsc0 = 0;           // its strain [-]
  double fpcu = 0;            // crushing strength [Pa]
  double epsU = 0;            // its strain [-]
  double lambda = 0.1;        // unloading slope at epsU over the initial one [-]
  std::optional<double> ft = std::nullopt;   // tensile strength [Pa]
  std::optional<double> Ets = std::nullopt;  // tension softening [Pa], positive

  template <class T>
  struct History {
    T strain;           // [-]
    T stress;           // [Pa]
    T least_strain;     // e_m <= 0
    T largest_opening;  // largest strain above e_t so far, >= 0
  };
  KentPark envelope() const { return kent_park(fpc, epsc0, fpcu, epsU); }
  double tensile_strength() const { return ft.value_or(0.1 * std::abs(fpc)); }
  double tension_softening() const { return Ets.value_or(0.1 * std::abs(fpc / epsc0)); }
  // of the point R
  double focus_strain() const {
    const KentPark e = envelope();
    return (e.fpcu / e.initial_tangent() - lambda * e.epsU) / (1 - lambda);
  }
  History<double> virgin() const { return {0, 0, 0, 0}; }
  double initial_tangent() const { return envelope().initial_tangent(); }
  double yield_strain() const { return std::abs(epsc0); }
  void check() const { envelope().check(); }
  template <class Visit, class Law>
  static void visit_parameters(Visit&& visit, Law& law) {
    using namespace parameter;
    visit(required(stress("fpc", "compressive strength, negative as in OpenSees; the sign is ignored")), law.fpc);
    visit(required(strain("epsc0", "strain at fpc, likewise")), law.epsc0);
    visit(required(stress("fpcu", "crushing strength, likewise")), law.fpcu);
    visit(required(strain("epsU", "strain at fpcu, likewise")), law.epsU);
    visit(number("lambda", "unloading slope at epsU over the initial one", {0, 1, false, true}), law.lambda);
    visit(with_default(stress("ft", "tensile strength", range::non_negative), "0.1 fpc"), law.ft);
    visit(with_default(stress("Ets", "softening modulus in tension", range::positive), "0.1 fpc/epsc0"), law.Ets);
  }
};

}  // namespace nsframe
#endif

HWY_BEFORE_NAMESPACE();
namespace nsframe {
namespace HWY_NAMESPACE {

// Tension at an opening >= 0 measured from e_t: elastic up to ft, then softening at -Ets to nothing.
template <class T>
HWY_INLINE Branch<T> respond_in_tension(const Concrete02& law, T opening) {
  const double Ec = law.initial_tangent(), ft = law.tensile_strength(), Ets = law.tension_softening();
  const double cracking = ft / Ec;
  const T softened = T(ft) - T(Ets) * (opening - T(cracking));
  const auto elastic = opening <= T(cracking), open = softened <= T(0.0);
  return {select(elastic, T(Ec) * opening, max(softened, T(0.0))),
          select(elastic, T(Ec), select(open, T(0.0), T(-Ets)))};
}

template <class T>
HWY_INLINE Response<T, Concrete02> respond(const Concrete02& law, T strain, const Concrete02::History<T>& committed) {
  const KentPark envelope = law.envelope();
  const double Ec = law.initial_tangent();
  const double focus_strain = law.focus_strain();
  const T zero(0.0);

  // the line through R; one division serves Er and 1/Er. R lies in compression where lambda < fpcu/(Ec epsU): then
  // a line from just beyond R falls, and the initial slope takes its place
  const T least = committed.least_strain, least_stress = respond(envelope, least).stress;
  const T rise = least_stress - T(Ec * focus_strain), run = least - T(focus_strain);
  const auto rises = rise * run > zero;
  const T inverse = T(1.0) / select(rises, rise * run, T(1.0));
  const T Er = select(rises, rise * rise * inverse, T(Ec));
  const T closing = least - least_stress * select(rises, run * run * inverse, T(1 / Ec));  // e_t

  const T trial = committed.stress + T(Ec) * (strain - committed.strain);
  const T lower = Er * (strain - closing), upper = T(0.5) * lower;
  const T inside = max(lower, min(upper, trial));
  const T inside_tangent = select(trial <= lower, Er, select(trial >= upper, T(0.5) * Er, T(Ec)));

  const T opening = strain - closing;
  const T largest = committed.largest_opening;
  const auto reopening = opening <= largest;
  const Branch<T> cracked = respond_in_tension(law, max(opening, largest));
  const T secant = select(largest > zero, cracked.stress / select(largest > zero, largest, T(1.0)), T(Ec));

  const Branch<T> crushing = respond(envelope, min(strain, zero));
  const auto deeper = strain < least, closed = strain <= closing;
  const T tension = select(reopening, secant * opening, cracked.stress);
  const T tension_tangent = select(reopening, secant, cracked.tangent);
  const T stress = select(deeper, crushing.stress, select(closed, inside, tension));
  const T tangent = select(deeper, crushing.tangent, select(closed, inside_tangent, tension_tangent));
  return {stress, tangent, {strain, stress, min(strain, least), select(closed, largest, max(opening, largest))}};
}

}  // namespace HWY_NAMESPACE
}  // namespace nsframe
HWY_AFTER_NAMESPACE();

#endif
