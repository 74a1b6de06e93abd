// A gap that closes in tension (Fy > 0) or in compression (Fy < 0) on an elastic-plastic body with hardening ratio eta
// (OpenSees' ElasticPPGap). Without damage the gap closes again where it was first; with damage it keeps growing by
// the plastic deformation, so that contact comes later.
// Differs from OpenSees in one point: without damage, strain that goes back over the whole gap in one step brings the
// contact back to the first gap; OpenSees keeps what the last committed strain inside left, which depends on the step.
#if defined(NSFRAME_MATERIALS_ELASTIC_PP_GAP_HPP) == defined(HWY_TARGET_TOGGLE)
#ifdef NSFRAME_MATERIALS_ELASTIC_PP_GAP_HPP
#undef NSFRAME_MATERIALS_ELASTIC_PP_GAP_HPP
#else
#define NSFRAME_MATERIALS_ELASTIC_PP_GAP_HPP
#endif

#include "materials/law.hpp"
#include "materials/number.hpp"

#ifndef NSFRAME_MATERIALS_ELASTIC_PP_GAP_PARAMETERS
#define NSFRAME_MATERIALS_ELASTIC_PP_GAP_PARAMETERS
namespace nsframe {

struct ElasticPPGap {
  static constexpr const char* name = "ElasticPPGap";
  double E = 0;         // [Pa]
  double Fy = 0;        // yield stress, its sign says on which side the gap closes [Pa]
  double gap = 0;       // of the sign of Fy [-]
  double eta = 0;       // hardening ratio [-]
  bool damage = false;  // plastic deformation widens the gap

  template <class Visit, class Law>
  static void visit_parameters(Visit&& visit, Law& law) {
    using namespace parameter;
    visit(required(stress("E", "elastic modulus of the closed gap", range::positive)), law.E);
    visit(required(stress("Fy", "yield stress; positive: the gap closes in tension, negative: in compression")), law.Fy);
    visit(required(strain("gap", "strain at which it closes, of the sign of Fy")), law.gap);
    visit(number("eta", "hardening ratio", {0, 1, false, true}), law.eta);
    visit(number("damage", "plastic deformation widens the gap"), law.damage);
  }
  void check() const {
    require(Fy != 0, "Fy must not be zero");
    require(gap == 0 || (gap > 0) == (Fy > 0), "gap must have the sign of Fy");
  }
  // In the mirror of a gap in compression all is positive.
  double side() const { return Fy < 0 ? -1 : 1; }

  template <class T>
  struct History {
    T strain;   // [-]
    T contact;  // strain at which the gap closes, mirrored to the positive side [-]
    T yield;    // strain at which it yields next, the same
  };
  History<double> virgin() const { return {0, side() * gap, side() * (gap + Fy / E)}; }
  double initial_tangent() const { return gap == 0 ? E : 0; }
  double yield_strain() const { return std::abs(gap) + std::abs(Fy) / E; }
  bool has_yielded(double strain, double stress) const {
    return stress != 0 && side() * (strain - stress / E - gap) > 0.1 * std::abs(Fy) / E;
  }
};

}  // namespace nsframe
#endif

HWY_BEFORE_NAMESPACE();
namespace nsframe {
namespace HWY_NAMESPACE {

template <class T>
HWY_INLINE Response<T, ElasticPPGap> respond(const ElasticPPGap& law, T strain, const ElasticPPGap::History<T>& committed) {
  const double gap = std::abs(law.gap), yield = std::abs(law.Fy) / law.E, hardening = law.eta * law.E;
  const T side(law.side()), zero(0.0), E(law.E);
  const T x = side * strain;
  const auto yields = x > committed.yield;
  const auto open = x < committed.contact;
  const T stress = select(yields, T(law.E * yield) + T(hardening) * (x - T(gap + yield)), E * (x - committed.contact));
  ElasticPPGap::History<T> h{strain, committed.contact, committed.yield};
  h.contact = select(yields, x - stress / E, h.contact);
  h.yield = select(yields, x, h.yield);
  if (!law.damage) {
    // contact follows the strain back to the first gap; yield is where the new elastic line meets the hardening line
    const T contact = max(x, T(gap));
    h.contact = select(open, contact, h.contact);
    h.yield = select(open, (contact - T(law.eta * gap)) * T(1 / (1 - law.eta)) + T(yield), h.yield);
  }
  return {side * select(open, zero, stress), select(open, zero, select(yields, T(hardening), E)), h};
}

}  // namespace HWY_NAMESPACE
}  // namespace nsframe
HWY_AFTER_NAMESPACE();

#endif
