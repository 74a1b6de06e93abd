// Linear elastic law.
#if defined(NSFRAME_MATERIALS_ELASTIC_HPP) == defined(HWY_TARGET_TOGGLE)
#ifdef NSFRAME_MATERIALS_ELASTIC_HPP
#undef NSFRAME_MATERIALS_ELASTIC_HPP
#else
#define NSFRAME_MATERIALS_ELASTIC_HPP
#endif

#include "materials/law.hpp"
#include "materials/number.hpp"

#ifndef NSFRAME_MATERIALS_ELASTIC_PARAMETERS
#define NSFRAME_MATERIALS_ELASTIC_PARAMETERS
namespace nsframe {

struct Elastic {
  static constexpr const char* name = "Elastic";
  double E = 0;  // [Pa]

  template <class T>
  struct History {
    T strain;  // [-], kept so that every law can report where it stands
  };
  History<double> virgin() const { return {0}; }
  bool is_linear() const { return true; }
  double initial_tangent() const { return E; }
  double yield_strain() const { return std::numeric_limits<double>::infinity(); }
  template <class Visit, class Law>
  static void visit_parameters(Visit&& visit, Law& law) {
    using namespace parameter;
    visit(required(stress("E", "elastic modulus; of a spring's law: stiffness in N/m or N m/rad", range::positive)), law.E);
  }
};

}  // namespace nsframe
#endif

HWY_BEFORE_NAMESPACE();
namespace nsframe {
namespace HWY_NAMESPACE {

template <class T>
HWY_INLINE Response<T, Elastic> respond(const Elastic& law, T strain, const Elastic::History<T>&) {
  return {T(law.E) * strain, T(law.E), {strain}};
}

}  // namespace HWY_NAMESPACE
}  // namespace nsframe
HWY_AFTER_NAMESPACE();

#endif
