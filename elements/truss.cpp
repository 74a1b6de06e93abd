#include "elements/truss.hpp"

namespace nsframe {

void Trusses::add(const ElementNodes& nodes, std::string id, const BeamFrame& frame, const UniaxialLaw& law, double area,
                  double pretension) {
  Members::add(nodes, std::move(id), frame, history_size(law));
  elements_.push_back({frame.length, law, area, pretension});
}

void Trusses::initialize_basic(int element, double* history) const {
  nsframe::initialize_history(elements_[static_cast<std::size_t>(element)].law, history);
}

// Axial force [N] and stiffness by elongation [N/m]; a slack cable has neither.
UniaxialPoint Trusses::axial(const Element& e, double elongation, const double* committed, double* trial) const {
  const UniaxialPoint point = nsframe::respond(e.law, elongation / e.length, committed, trial);
  const double force = e.pretension + point.stress * e.area;
  if (kind_ == Kind::cable && force < 0) return {0, 0};
  return {force, point.tangent * e.area / e.length};
}

void Trusses::respond_basic(int element, const Vector6& deformation, const ActingLoad&, double, const double* committed,
                            double* trial, Vector6& force, Matrix6* tangent) const {
  const UniaxialPoint point = axial(elements_[static_cast<std::size_t>(element)], deformation[0], committed, trial);
  force = point.stress * Vector6::Unit(0);
  if (!tangent) return;
  tangent->setZero();
  (*tangent)(0, 0) = point.tangent;
}

RateEnergy Trusses::respond_rate(int element, const Vector12& displacement, const double* committed, double* trial,
                                 const StepSpan& step, Vector12& force, Matrix12& tangent) const {
  const Element& e = elements_[static_cast<std::size_t>(element)];
  const double elongation = geometry().deformation(frame(element), displacement, committed, trial)[0];
  const RatePoint point = nsframe::respond_rate(e.law, elongation / e.length, basic_history(element, committed),
                                                basic_history(element, trial), step);
  Matrix6 basic_tangent = Matrix6::Zero();
  basic_tangent(0, 0) = point.tangent * e.area / e.length;
  geometry().to_global(frame(element), displacement, committed, point.stress * e.area * Vector6::Unit(0), basic_tangent, force,
                       &tangent);
  const double volume = e.area * e.length;
  return {volume * point.energy.dissipated, volume * point.energy.stored};
}

Vector12 Trusses::rate_force(int element, const Vector12& displacement, const double* history) const {
  const Element& e = elements_[static_cast<std::size_t>(element)];
  const double axial = rate_stress(e.law, basic_history(element, history)) * e.area;
  Vector12 force;
  geometry().to_global(frame(element), displacement, history, axial * Vector6::Unit(0), Matrix6::Zero(), force, nullptr);
  return force;
}

std::vector<SectionResult> Trusses::basic_sections(int element, const Vector6& deformation, const ActingLoad&,
                                                   const double* history) const {
  const Element& e = elements_[static_cast<std::size_t>(element)];
  std::vector<double> scratch(static_cast<std::size_t>(history_size(e.law)));
  SectionResult result;
  result.position = 0.5;
  result.deformation[0] = deformation[0] / e.length;
  result.force[0] = axial(e, deformation[0], history, scratch.data()).stress + rate_stress(e.law, history) * e.area;
  result.peak_strain_ratio = std::abs(result.deformation[0]) / yield_strain(e.law);
  const double stress = (result.force[0] - e.pretension) / e.area;
  result.yielded = kind_ != Kind::cable && has_yielded(e.law, result.deformation[0], stress) ? 1 : 0;
  return {result};
}

}  // namespace nsframe
