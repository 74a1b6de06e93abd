// Elastic, perfectly plastic law with different yield strains in tension and compression (OpenSees' ElasticPP).
#if defined(NSFRAME_MATERIALS_ELASTIC_PP_HPP) == defined(HWY_TARGET_TOGGLE)
#ifdef NSFRAME_MATERIALS_ELASTIC_PP_HPP
#undef NSFRAME_MATERIALS_ELASTIC_PP_HPP
#else
#define NSFRAME_MATERIALS_ELASTIC_PP_HPP
#endif

#include "materials/law.hpp"
#include "materials/number.hpp"

#ifndef NSFRAME_MATERIALS_ELASTIC_PP_PARAMETERS
#define NSFRAME_MATERIALS_ELASTIC_PP_PARAMETERS
namespace nsframe {

struct ElasticPP {
  static constexpr const char* name = "ElasticPP";
  double E = 0;     // [Pa]
  double epsyP = 0; // yield strain in tension [-]
  double epsyN = 0; // yield strain in compression, negative [-]; 0: -epsyP
  double eps0 = 0;  // initial strain [-]

  template <class T>
  struct History {
    T strain;          // [-]
    T plastic_strain;  // [-]
  };
  double compression_yield() const { return epsyN < 0 ? epsyN : -epsyP; }
  History<double> virgin() const { return {0, 0}; }
  template <class T>
  struct QuietHistory {};
  double quiet_limit(double) const { return 1; }
  History<double> opened(double strain, const QuietHistory<double>&) const { return {strain, 0}; }
  double initial_tangent() const { return E; }
  double yield_strain() const { return std::min(epsyP, -compression_yield()); }
  bool has_yielded(double strain, double stress) const {
    return std::abs(strain - eps0 - stress / E) > 0.1 * yield_strain();
  }

  template <class Visit, class Law>
  static void visit_parameters(Visit&& visit, Law& law) {
    using namespace parameter;
    visit(required(stress("E", "elastic modulus", range::positive)), law.E);
    visit(required(strain("epsyP", "yield strain in tension", range::positive)), law.epsyP);
    visit(strain("epsyN", "yield strain in compression, negative; 0: -epsyP", range::non_positive), law.epsyN);
    visit(strain("eps0", "initial strain"), law.eps0);
  }
};

}  // namespace nsframe
#endif

HWY_BEFORE_NAMESPACE();
namespace nsframe {
namespace HWY_NAMESPACE {

template <class T>
HWY_INLINE Response<T, ElasticPP> respond(const ElasticPP& law, T strain, const ElasticPP::History<T>& committed) {
  const T trial = T(law.E) * (strain - T(law.eps0) - committed.plastic_strain);
  const T stress = max(T(law.E * law.compression_yield()), min(T(law.E * law.epsyP), trial));
  const T plastic_strain = committed.plastic_strain + (trial - stress) * T(1 / law.E);
  return {stress, select(stress == trial, T(law.E), T(0.0)), {strain, plastic_strain}};
}

template <class T>
HWY_INLINE auto stays_linear(const ElasticPP& law, double, T, T strain, ElasticPP::QuietHistory<T>&) {
  const T elastic = strain - T(law.eps0);
  return both(elastic < T(law.epsyP), elastic > T(law.compression_yield()));
}

template <class T>
HWY_INLINE T linear_reach(const ElasticPP& law, double, T strain, const ElasticPP::QuietHistory<T>&) {
  const T elastic = strain - T(law.eps0);
  return min(T(law.epsyP) - elastic, elastic - T(law.compression_yield()));
}

}  // namespace HWY_NAMESPACE
}  // namespace nsframe
HWY_AFTER_NAMESPACE();

#endif
