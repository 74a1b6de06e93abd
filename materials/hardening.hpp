// Plasticity with linear isotropic and kinematic hardening by closest-point return (Simo, Hughes 1998, ch. 1.5;
// OpenSees' Hardening without its viscosity).
#if defined(NSFRAME_MATERIALS_HARDENING_HPP) == defined(HWY_TARGET_TOGGLE)
#ifdef NSFRAME_MATERIALS_HARDENING_HPP
#undef NSFRAME_MATERIALS_HARDENING_HPP
#else
#define NSFRAME_MATERIALS_HARDENING_HPP
#endif

#include "materials/law.hpp"
#include "materials/number.hpp"

#ifndef NSFRAME_MATERIALS_HARDENING_PARAMETERS
#define NSFRAME_MATERIALS_HARDENING_PARAMETERS
namespace nsframe {

struct Hardening {
  static constexpr const char* name = "Hardening";
  double E = 0;       // [Pa]
  double sigmaY = 0;  // yield stress [Pa]
  double H_iso = 0;   // isotropic hardening modulus [Pa]
  double H_kin = 0;   // kinematic hardening modulus [Pa]

  template <class Visit, class Law>
  static void visit_parameters(Visit&& visit, Law& law) {
    using namespace parameter;
    visit(required(stress("E", "elastic modulus", range::positive)), law.E);
    visit(required(stress("sigmaY", "yield stress", range::positive)), law.sigmaY);
    visit(required(stress("H_iso", "isotropic hardening modulus, by plastic strain", range::non_negative)), law.H_iso);
    visit(required(stress("H_kin", "kinematic hardening modulus, by plastic strain")), law.H_kin);
  }
  void check() const { require(E + H_iso + H_kin > 0, "H_kin must be above -(E + H_iso)"); }

  template <class T>
  struct History {
    T strain;          // [-]
    T plastic_strain;  // [-]
    T plastic_path;    // sum of |increments| of the plastic strain [-]
  };
  History<double> virgin() const { return {0, 0, 0}; }
  double initial_tangent() const { return E; }
  double yield_strain() const { return sigmaY / E; }
};

}  // namespace nsframe
#endif

HWY_BEFORE_NAMESPACE();
namespace nsframe {
namespace HWY_NAMESPACE {

template <class T>
HWY_INLINE Response<T, Hardening> respond(const Hardening& law, T strain, const Hardening::History<T>& committed) {
  const double sum = law.E + law.H_iso + law.H_kin;
  const T E(law.E), zero(0.0);
  const T trial = E * (strain - committed.plastic_strain);
  const T relative = trial - T(law.H_kin) * committed.plastic_strain;
  const T excess = abs(relative) - (T(law.sigmaY) + T(law.H_iso) * committed.plastic_path);
  const T path = max(excess, zero) * T(1 / sum);
  const T flow = select(relative < zero, -path, path);
  const T tangent = select(excess > zero, T(law.E * (law.H_iso + law.H_kin) / sum), E);
  return {trial - E * flow, tangent, {strain, committed.plastic_strain + flow, committed.plastic_path + path}};
}

}  // namespace HWY_NAMESPACE
}  // namespace nsframe
HWY_AFTER_NAMESPACE();

#endif
