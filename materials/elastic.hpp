// Elastic law, with its own modulus in compression on request (OpenSees' Elastic without its damping tangent).
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
  double E = 0;                // [Pa]
  std::optional<double> Eneg = {};  // of compression [Pa]; none: E

  template <class Visit, class Law>
  static void visit_parameters(Visit&& visit, Law& law) {
    using namespace parameter;
    visit(required(stress("E", "elastic modulus; of a spring's law: stiffness in N/m or N m/rad", range::positive)), law.E);
    visit(with_default(stress("Eneg", "elastic modulus in compression", range::non_negative), "E"), law.Eneg);
  }
  template <class T>
  struct History {
    T strain;  // [-], kept so that every law can report where it stands
  };
  History<double> virgin() const { return {0}; }
  bool is_linear() const { return Eneg.value_or(E) == E; }
  template <class T>
  struct QuietHistory {};
  double quiet_limit(double) const { return is_linear() ? 1 : 0; }
  History<double> opened(double strain, const QuietHistory<double>&) const { return {strain}; }
  double initial_tangent() const { return std::max(E, Eneg.value_or(E)); }
  double yield_strain() const { return std::numeric_limits<double>::infinity(); }
};

}  // namespace nsframe
#endif

HWY_BEFORE_NAMESPACE();
namespace nsframe {
namespace HWY_NAMESPACE {

// At zero strain the tangent is the larger modulus.
template <class T>
HWY_INLINE Response<T, Elastic> respond(const Elastic& law, T strain, const Elastic::History<T>&) {
  if (law.is_linear()) return {T(law.E) * strain, T(law.E), {strain}};
  const double compression = *law.Eneg, at_zero = law.initial_tangent();
  const T zero(0.0);
  const T tangent = select(strain > zero, T(law.E), select(strain < zero, T(compression), T(at_zero)));
  return {tangent * strain, tangent, {strain}};
}

template <class T>
HWY_INLINE auto stays_linear(const Elastic&, double, T, T strain, Elastic::QuietHistory<T>&) {
  return strain == strain;  // all, unless it is not a number
}

template <class T>
HWY_INLINE T linear_reach(const Elastic&, double, T, const Elastic::QuietHistory<T>&) {
  return T(std::numeric_limits<double>::max());
}

}  // namespace HWY_NAMESPACE
}  // namespace nsframe
HWY_AFTER_NAMESPACE();

#endif
