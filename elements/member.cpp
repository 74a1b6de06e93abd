#include "elements/member.hpp"

#include <vector>

namespace nsframe {

void Members::add(const ElementNodes& nodes, std::string id, const BeamFrame& frame, int history_size, bool loaded) {
  ElementGroup::add(nodes, std::move(id));
  frames_.push_back(frame);
  Place& place = places_.back();
  place.own = own_offset(loaded);
  place.loaded = loaded;
  place.factor = loaded && !linear();
  const int end = place.begin + place.own + history_size;
  places_.push_back({end});
}

void Members::initialize_history(int element, double* history) const {
  geometry_.initialize_history(history);
  if (double* const factor = load_factor(element, history)) *factor = 0;
  initialize_basic(element, history + own_begin(element));
}

void Members::start_step(int element, const double* committed, double* trial) const {
  const int own = own_begin(element);
  if (double* const factor = load_factor(element, trial)) *factor = committed[own - 1];
  start_basic(element, committed + own, trial + own);
}

void Members::respond(int element, const Vector12& displacement, const double* committed, double* trial,
                      Vector12& force, Matrix12* tangent) const {
  const BeamFrame& frame = this->frame(element);
  const int own = own_begin(element);
  const double part = load_part(element, trial);
  Vector6 basic_force;
  Matrix6 basic_tangent;
  const Vector6 deformation = geometry_.deformation(frame, displacement, committed, trial);
  respond_basic(element, deformation, part, geometry_.rounding(displacement), committed + own, trial + own, basic_force,
                tangent ? &basic_tangent : nullptr);
  geometry_.to_global(frame, displacement, committed, basic_force, basic_tangent, force, tangent);
  if (loaded(element)) geometry_.add_load(frame, *load(element), part, displacement, committed, force, tangent);
}

Matrix12 Members::geometric_change(int element, const Vector12& displacement, const Vector12& step,
                                   const double* committed, double* trial) const {
  const BeamFrame& frame = this->frame(element);
  const int own = own_begin(element);
  const double part = load_part(element, trial);
  Vector6 basic_force;
  Matrix6 basic_tangent;
  const Vector6 deformation = geometry_.deformation(frame, displacement, committed, trial);
  respond_basic(element, deformation, part, geometry_.rounding(displacement), committed + own, trial + own, basic_force, &basic_tangent);
  const auto tangent_at = [&](const Vector12& u) {
    const Vector6 change = geometry_.deformation(frame, u, committed, trial) - deformation;
    Vector12 force;
    Matrix12 tangent;
    geometry_.to_global(frame, u, committed, basic_force + basic_tangent * change, basic_tangent, force, &tangent);
    if (loaded(element)) geometry_.add_load(frame, *load(element), part, u, committed, force, &tangent);
    return tangent;
  };
  return 0.5 * (tangent_at(displacement + step) - tangent_at(displacement - step));
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
  return basic_sections(element, deformation, load_part(element, history), history + own_begin(element));
}

}  // namespace nsframe
