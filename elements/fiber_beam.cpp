#include "elements/fiber_beam.hpp"

namespace nsframe {

void FiberBeams::add(const ElementNodes& nodes, std::string id, const BeamFrame& frame,
                     std::shared_ptr<const FiberSection> section, SectionOutline outline) {
  Members::add(nodes, std::move(id), frame, head_size() + points() * section->history_size);
  elements_.push_back({frame.length, std::move(section), std::move(outline)});
}

ElementShape FiberBeams::shape(int element) const {
  return member_shape(element, &element_at(element).outline);
}

SectionResult FiberBeams::section_result(int element, int point, const Vector3& deformation,
                                         const double* history) const {
  const FiberSection& section = *element_at(element).section;
  const double* const committed = section_history(element, history, point);
  std::vector<double> scratch(static_cast<std::size_t>(section.history_size));
  SectionResult result;
  result.position = rule_.position[static_cast<std::size_t>(point)];
  result.deformation = deformation;
  result.force = nsframe::respond(section, deformation, committed, scratch.data()).force;
  result.peak_strain_ratio = peak_strain_ratio(section, deformation);
  result.yielded = has_yielded(section, deformation, committed) ? 1 : 0;
  return result;
}

Matrix6 with_torsion(const Matrix5& stiffness, double torsion) {
  Matrix6 all = Matrix6::Zero();
  all.topLeftCorner<5, 5>() = stiffness;
  all(5, 5) = torsion;
  return all;
}

}  // namespace nsframe
