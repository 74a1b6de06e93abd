// How the choices of a scene are spelled.
#pragma once

#include <array>
#include <string_view>
#include <utility>

#include "models/analysis.hpp"
#include "scene/tables.hpp"

namespace nsframe {

template <class Enum, std::size_t n>
using Names = std::array<std::pair<std::string_view, Enum>, n>;

constexpr auto names_of(BeamKind) {
  return Names<BeamKind, 3>{{{"elastic", BeamKind::elastic},
                             {"displacement", BeamKind::displacement},
                             {"force-based", BeamKind::force_based}}};
}
constexpr auto names_of(BarKind) { return Names<BarKind, 2>{{{"truss", BarKind::truss}, {"cable", BarKind::cable}}}; }
constexpr auto names_of(Geometry) {
  return Names<Geometry, 3>{{{"linear", Geometry::linear},
                             {"p-delta", Geometry::p_delta},
                             {"corotational", Geometry::corotational}}};
}
constexpr auto names_of(LoadAxes) {
  return Names<LoadAxes, 2>{{{"global", LoadAxes::global}, {"local", LoadAxes::local}}};
}
constexpr auto names_of(Dof) {
  return Names<Dof, 6>{
      {{"ux", Dof::ux}, {"uy", Dof::uy}, {"uz", Dof::uz}, {"rx", Dof::rx}, {"ry", Dof::ry}, {"rz", Dof::rz}}};
}
constexpr auto names_of(SlabKind) {
  return Names<SlabKind, 3>{
      {{"links", SlabKind::links}, {"rigid", SlabKind::rigid}, {"diaphragm", SlabKind::diaphragm}}};
}
constexpr auto names_of(PlanAxis) { return Names<PlanAxis, 2>{{{"x", PlanAxis::x}, {"y", PlanAxis::y}}}; }
constexpr auto names_of(BracePlane) {
  return Names<BracePlane, 4>{
      {{"-x", BracePlane::x_low}, {"+x", BracePlane::x_high}, {"-y", BracePlane::y_low}, {"+y", BracePlane::y_high}}};
}
constexpr auto names_of(BaseKind) {
  return Names<BaseKind, 3>{{{"fixed", BaseKind::fixed}, {"pinned", BaseKind::pinned}, {"spring", BaseKind::spring}}};
}
constexpr auto names_of(DampingKind) {
  return Names<DampingKind, 3>{
      {{"none", DampingKind::none}, {"modal", DampingKind::modal}, {"rayleigh", DampingKind::rayleigh}}};
}
constexpr auto names_of(AccelerationUnit) {
  return Names<AccelerationUnit, 6>{{{"g", AccelerationUnit::g},
                                     {"m/s2", AccelerationUnit::metres},
                                     {"cm/s2", AccelerationUnit::centimetres},
                                     {"mm/s2", AccelerationUnit::millimetres},
                                     {"in/s2", AccelerationUnit::inches},
                                     {"ft/s2", AccelerationUnit::feet}}};
}
constexpr auto names_of(MotionQuantity) {
  return Names<MotionQuantity, 2>{{{"acceleration", MotionQuantity::acceleration}, {"displacement", MotionQuantity::displacement}}};
}
constexpr auto names_of(ArcKind) {
  return Names<ArcKind, 2>{{{"spherical", ArcKind::spherical}, {"cylindrical", ArcKind::cylindrical}}};
}
constexpr auto names_of(DampingStiffness) {
  return Names<DampingStiffness, 3>{{{"initial", DampingStiffness::initial},
                                     {"committed", DampingStiffness::committed},
                                     {"current", DampingStiffness::current}}};
}
constexpr auto names_of(ContactSolverKind) {
  return Names<ContactSolverKind, 2>{
      {{"active-set", ContactSolverKind::active_set}, {"gauss-seidel", ContactSolverKind::gauss_seidel}}};
}

constexpr auto names_of(ImpactLaw) {
  return Names<ImpactLaw, 2>{{{"newton", ImpactLaw::newton}, {"poisson", ImpactLaw::poisson}}};
}

}  // namespace nsframe
