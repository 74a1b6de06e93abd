#include "elements/truss.hpp"

namespace nsframe {

void Trusses::add(const ElementNodes& nodes, std::string id, const BeamFrame& frame, const UniaxialLaw& law, double area,
                  double pretension) {
  ElementGroup::add(nodes, std::move(id));
  history_begin_.push_back(history_begin_.back() + history_size(law));
  elements_.push_back({frame, law, area, pretension});
}

void Trusses::initialize_history(int element, double* history) const {
  nsframe::initialize_history(elements_[static_cast<std::size_t>(element)].law, history);
}

// Axial force [N] and stiffness by elongation [N/m]; a slack cable has neither.
UniaxialPoint Trusses::axial(const Element& e, const Vector12& displacement, const double* committed,
                             double* trial) const {
  const double strain = e.frame.compatibility.row(0).dot(displacement) / e.frame.length;
  const UniaxialPoint point = nsframe::respond(e.law, strain, committed, trial);
  const double force = e.pretension + point.stress * e.area;
  if (kind_ == Kind::cable && force < 0) return {0, 0};
  return {force, point.tangent * e.area / e.frame.length};
}

void Trusses::respond(int element, const Vector12& displacement, const double* committed, double* trial,
                      Vector12& force, Matrix12* tangent) const {
  const Element& e = elements_[static_cast<std::size_t>(element)];
  const UniaxialPoint point = axial(e, displacement, committed, trial);
  Vector6 basic_force = Vector6::Zero();
  Matrix6 basic_tangent = Matrix6::Zero();
  basic_force[0] = point.stress;
  basic_tangent(0, 0) = point.tangent;
  to_global(e.frame, p_delta_, displacement, basic_force, basic_tangent, force, tangent);
}

ElementShape Trusses::shape(int element) const {
  const Element& e = elements_[static_cast<std::size_t>(element)];
  return {false, e.frame.axes, e.frame.length, nullptr};
}

std::vector<SectionResult> Trusses::sections(int element, const Vector12& displacement, const double* history) const {
  const Element& e = elements_[static_cast<std::size_t>(element)];
  std::vector<double> scratch(static_cast<std::size_t>(history_size(e.law)));
  SectionResult result;
  result.position = 0.5;
  result.deformation[0] = e.frame.compatibility.row(0).dot(displacement) / e.frame.length;
  result.force[0] = axial(e, displacement, history, scratch.data()).stress;
  result.peak_strain_ratio = std::abs(result.deformation[0]) / yield_strain(e.law);
  const double stress = (result.force[0] - e.pretension) / e.area;
  result.yielded = kind_ != Kind::cable && has_yielded(e.law, result.deformation[0], stress) ? 1 : 0;
  return {result};
}

}  // namespace nsframe
