// Concrete without tension (OpenSees' Concrete01): the Kent-Park envelope in compression; from the least strain on it,
// unloading and reloading on one line after Karsan and Jirsa. Compression is negative; parameters of either sign are
// taken as compression.
#if defined(NSFRAME_MATERIALS_CONCRETE01_HPP) == defined(HWY_TARGET_TOGGLE)
#ifdef NSFRAME_MATERIALS_CONCRETE01_HPP
#undef NSFRAME_MATERIALS_CONCRETE01_HPP
#else
#define NSFRAME_MATERIALS_CONCRETE01_HPP
#endif

#include "materials/karsan_jirsa.hpp"
#include "materials/kent_park.hpp"
#include "materials/law.hpp"
#include "materials/number.hpp"

#ifndef NSFRAME_MATERIALS_CONCRETE01_PARAMETERS
#define NSFRAME_MATERIALS_CONCRETE01_PARAMETERS
namespace nsframe {

struct Concrete01 {
  static constexpr const char* name = "Concrete01";
  double fpc = 0;    // compressive strength [Pa]
  double epsc0 = 0;  // its strain [-]
  double fpcu = 0;   // crushing strength [Pa]
  double epsU = 0;   // its strain [-]

  template <class T>
  struct History {
    T strain;           // [-]
    T least_strain;     // e_m <= 0
    T plastic_strain;   // e_p <= 0
    T unloading_slope;  // [Pa]
  };
  KentPark envelope() const { return kent_park(fpc, epsc0, fpcu, epsU); }
  KarsanJirsa unloading() const { return {-std::abs(epsc0), -std::abs(epsU), initial_tangent()}; }
  History<double> virgin() const { return {0, 0, 0, initial_tangent()}; }
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
  }
};

}  // namespace nsframe
#endif

HWY_BEFORE_NAMESPACE();
namespace nsframe {
namespace HWY_NAMESPACE {

template <class T>
HWY_INLINE Response<T, Concrete01> respond(const Concrete01& law, T strain, const Concrete01::History<T>& committed) {
  Concrete01::History<T> h = committed;
  h.strain = strain;
  const T shortening = min(strain, T(0.0));
  const Branch<T> answer = compress(law.unloading(), shortening, respond(law.envelope(), shortening), h);
  // compress() takes a virgin point at zero for one on the envelope, which it is, but tension has no tangent
  return {answer.stress, select(strain > T(0.0), T(0.0), answer.tangent), h};
}

}  // namespace HWY_NAMESPACE
}  // namespace nsframe
HWY_AFTER_NAMESPACE();

#endif
