// Concrete with Popovics' (1973) curve as used by Mander, Priestley and Park (1988), OpenSees' Concrete04:
//   s = fc x r/(r - 1 + x^r),  x = e/ec,  r = Ec/(Ec - fc/ec),  down to ecu, and nothing beyond;
// unloading and reloading after Karsan and Jirsa. Tension is elastic up to fct, then decays exponentially to beta fct
// at et, and unloads towards the origin. Compression is negative; fc, ec, ecu of either sign are taken as compression.
#if defined(NSFRAME_MATERIALS_CONCRETE04_HPP) == defined(HWY_TARGET_TOGGLE)
#ifdef NSFRAME_MATERIALS_CONCRETE04_HPP
#undef NSFRAME_MATERIALS_CONCRETE04_HPP
#else
#define NSFRAME_MATERIALS_CONCRETE04_HPP
#endif

#include "materials/karsan_jirsa.hpp"
#include "materials/law.hpp"
#include "materials/number.hpp"

#ifndef NSFRAME_MATERIALS_CONCRETE04_PARAMETERS
#define NSFRAME_MATERIALS_CONCRETE04_PARAMETERS
namespace nsframe {

struct Concrete04 {
  static constexpr const char* name = "Concrete04";
  double fc = 0;      // compressive strength [Pa]
  double ec = 0;      // its strain [-]
  double ecu = 0;     // strain at crushing [-]
  double Ec = 0;      // initial modulus [Pa]
  double fct = 0;     // tensile strength [Pa]
  double et = 0;      // ultimate strain in tension [-]
  double beta = 0.1;  // stress at et over fct [-]

  template <class T>
  struct History {
    T strain;           // [-]
    T least_strain;     // e_m <= 0
    T plastic_strain;   // e_p <= 0
    T unloading_slope;  // [Pa]
    T largest_strain;   // >= 0
  };
  double secant() const { return std::abs(fc) / std::abs(ec); }
  KarsanJirsa unloading() const { return {-std::abs(ec), -std::abs(ecu), Ec}; }
  History<double> virgin() const { return {0, 0, 0, Ec, 0}; }
  double initial_tangent() const { return Ec; }
  double yield_strain() const { return std::abs(ec); }
  void check() const {
    require(fc != 0, "fc must not be 0");
    require(ec != 0, "ec must not be 0");
    require(std::abs(ecu) > std::abs(ec), "ecu must be farther out than ec");
    require(Ec > secant(), "Ec must be above the secant modulus fc/ec");
    require(fct == 0 || et > fct / Ec, "et must be above fct/Ec");
  }
  template <class Visit, class Law>
  static void visit_parameters(Visit&& visit, Law& law) {
    using namespace parameter;
    visit(required(stress("fc", "compressive strength, negative as in OpenSees; the sign is ignored")), law.fc);
    visit(required(strain("ec", "strain at fc, likewise")), law.ec);
    visit(required(strain("ecu", "strain at crushing, likewise")), law.ecu);
    visit(required(stress("Ec", "initial modulus, above fc/ec", range::positive)), law.Ec);
    visit(stress("fct", "tensile strength", range::non_negative), law.fct);
    visit(strain("et", "ultimate strain in tension", range::non_negative), law.et);
    visit(number("beta", "stress at et over fct", {0, 1, true, false}), law.beta);
  }
};

}  // namespace nsframe
#endif

HWY_BEFORE_NAMESPACE();
namespace nsframe {
namespace HWY_NAMESPACE {

// At strain <= 0.
template <class T>
HWY_INLINE Branch<T> popovics(const Concrete04& law, T strain) {
  const double r = law.Ec / (law.Ec - law.secant());
  const T ratio = abs(strain) * T(1 / std::abs(law.ec));
  const T power = pow(ratio, T(r));
  const T inverse = T(1.0) / (T(r - 1) + power);
  const auto crushed = strain < T(-std::abs(law.ecu));
  const T stress = T(law.secant() * r) * strain * inverse;
  const T tangent = T(law.secant() * r * (r - 1)) * (T(1.0) - power) * inverse * inverse;
  return {select(crushed, T(0.0), stress), select(crushed, T(0.0), tangent)};
}

// At strain >= 0.
template <class T>
HWY_INLINE Branch<T> stretch(const Concrete04& law, T strain, T largest) {
  const double cracking = law.fct / law.Ec, decay = law.fct > 0 ? std::log(law.beta) / (law.et - cracking) : 0;
  const T reached = max(strain, largest);
  const T decayed = T(law.fct) * exp(T(decay) * max(T(0.0), min(reached, T(law.et)) - T(cracking)));
  const auto elastic = reached <= T(cracking), broken = reached > T(law.et);
  const T softened = select(broken, T(0.0), decayed);
  const T secant = select(elastic, T(law.Ec), softened / select(elastic, T(1.0), reached));
  const auto inside = either(elastic, strain < largest);
  return {select(inside, secant * strain, softened), select(inside, secant, T(decay) * softened)};
}

template <class T>
HWY_INLINE Response<T, Concrete04> respond(const Concrete04& law, T strain, const Concrete04::History<T>& committed) {
  const T zero(0.0);
  Concrete04::History<T> h = committed;
  h.strain = strain;
  h.largest_strain = max(strain, committed.largest_strain);
  const T shortening = min(strain, zero);
  const Branch<T> compression = compress(law.unloading(), shortening, popovics(law, shortening), h);
  if (law.fct == 0) return {compression.stress, select(strain > zero, zero, compression.tangent), h};
  const Branch<T> tension = stretch(law, max(strain, zero), committed.largest_strain);
  const auto stretched = strain > zero;
  return {select(stretched, tension.stress, compression.stress),
          select(stretched, tension.tangent, compression.tangent), h};
}

}  // namespace HWY_NAMESPACE
}  // namespace nsframe
HWY_AFTER_NAMESPACE();

#endif
