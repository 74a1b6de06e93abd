// Elastic in compression, no tension (OpenSees' ENT).
#if defined(NSFRAME_MATERIALS_ENT_HPP) == defined(HWY_TARGET_TOGGLE)
#ifdef NSFRAME_MATERIALS_ENT_HPP
#undef NSFRAME_MATERIALS_ENT_HPP
#else
#define NSFRAME_MATERIALS_ENT_HPP
#endif

#include "materials/law.hpp"
#include "materials/number.hpp"

#ifndef NSFRAME_MATERIALS_ENT_PARAMETERS
#define NSFRAME_MATERIALS_ENT_PARAMETERS
namespace nsframe {

struct ENT {
  static constexpr const char* name = "ENT";
  double E = 0;  // [Pa]

  template <class Visit, class Law>
  static void visit_parameters(Visit&& visit, Law& law) {
    using namespace parameter;
    visit(required(stress("E", "elastic modulus in compression", range::positive)), law.E);
  }
  template <class T>
  struct History {
    T strain;  // [-]
  };
  History<double> virgin() const { return {0}; }
  double initial_tangent() const { return E; }
  double yield_strain() const { return std::numeric_limits<double>::infinity(); }
};

}  // namespace nsframe
#endif

HWY_BEFORE_NAMESPACE();
namespace nsframe {
namespace HWY_NAMESPACE {

template <class T>
HWY_INLINE Response<T, ENT> respond(const ENT& law, T strain, const ENT::History<T>&) {
  const auto open = strain > T(0.0);
  return {select(open, T(0.0), T(law.E) * strain), select(open, T(0.0), T(law.E)), {strain}};
}

}  // namespace HWY_NAMESPACE
}  // namespace nsframe
HWY_AFTER_NAMESPACE();

#endif
