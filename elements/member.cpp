#include "elements/member.hpp"

#include <vector>

namespace nsframe {

void Members::add(const ElementNodes& nodes, std::string id, const BeamFrame& frame, int history_size) {
  ElementGroup::add(nodes, std::move(id));
  frames_.push_back(frame);
  history_begin_.push_back(history_begin_.back() + geometry_.history_size() + history_size);
}

void Members::initialize_history(int element, double* history) const {
  geometry_.initialize_history(history);
  initialize_basic(element, history + geometry_.history_size());
}

void Members::start_step(int element, const double* committed, double* trial) const {
  start_basic(element, committed + geometry_.history_size(), trial + geometry_.history_size());
}

void Members::respond(int element, const Vector12& displacement, const double* committed, double* trial,
                      Vector12& force, Matrix12* tangent) const {
  const BeamFrame& frame = this->frame(element);
  const int own = geometry_.history_size();
  Vector6 basic_force;
  Matrix6 basic_tangent;
  const Vector6 deformation = geometry_.deformation(frame, displacement, committed, trial);
  respond_basic(element, deformation, geometry_.rounding(displacement), committed + own, trial + own, basic_force, basic_tangent);
  geometry_.to_global(frame, displacement, committed, basic_force, basic_tangent, force, tangent);
}

ElementShape Members::member_shape(int element, const SectionOutline* outline) const {
  const BeamFrame& frame = this->frame(element);
  return {outline != nullptr, geometry_.finite(), frame.axes, frame.length, frame.offset, outline};
}

ElementPose Members::pose(int element, const Vector12& displacement, const double* history) const {
  return geometry_.pose(frame(element), displacement, history);
}

std::vector<SectionResult> Members::sections(int element, const Vector12& displacement, const double* history) const {
  std::vector<double> scratch(static_cast<std::size_t>(geometry_.history_size()));
  const Vector6 deformation = geometry_.deformation(frame(element), displacement, history, scratch.data());
  return basic_sections(element, deformation, history + geometry_.history_size());
}

}  // namespace nsframe
