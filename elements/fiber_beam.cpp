#include "elements/fiber_beam.hpp"

namespace nsframe {

void FiberBeams::add(const ElementNodes& nodes, std::string id, const BeamFrame& frame,
                     std::shared_ptr<const FiberSection> section, SectionOutline outline) {
  ElementGroup::add(nodes, std::move(id));
  history_begin_.push_back(history_begin_.back() + head_size() + points() * section->history_size);
  elements_.push_back({frame, std::move(section), std::move(outline)});
}

ElementShape FiberBeams::shape(int element) const {
  const Element& e = element_at(element);
  return {true, e.frame.axes, e.frame.length, &e.outline};
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

std::vector<FiberPlace> FiberBeams::fiber_places(int element) const {
  std::vector<FiberPlace> places;
  for (int point = 0; point < points(); ++point) {
    for (FiberPlace place : nsframe::fiber_places(*element_at(element).section)) {
      place.point = point;
      place.position = rule_.position[static_cast<std::size_t>(point)];
      places.push_back(place);
    }
  }
  return places;
}

std::vector<FiberState> FiberBeams::fiber_states(int element, const Vector12& displacement, const double* history) const {
  std::vector<FiberState> states;
  const std::vector<SectionResult> results = sections(element, displacement, history);
  for (int point = 0; point < points(); ++point) {
    const Vector3& deformation = results[static_cast<std::size_t>(point)].deformation;
    const auto at_point = nsframe::fiber_states(*element_at(element).section, deformation, section_history(element, history, point));
    states.insert(states.end(), at_point.begin(), at_point.end());
  }
  return states;
}

Matrix6 with_torsion(const Matrix5& stiffness, double torsion) {
  Matrix6 all = Matrix6::Zero();
  all.topLeftCorner<5, 5>() = stiffness;
  all(5, 5) = torsion;
  return all;
}

}  // namespace nsframe
