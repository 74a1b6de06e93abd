#include "output/member_forces.hpp"

namespace nsframe {

Vector12 element_displacement(const ElementGroup& group, int element, const VectorX& full_displacement) {
  Vector12 displacement = Vector12::Zero();
  const ElementNodes& nodes = group.nodes(element);
  if (nodes[0] >= 0) displacement.head<6>() = full_displacement.segment<6>(6 * nodes[0]);
  if (nodes[1] >= 0) displacement.tail<6>() = full_displacement.segment<6>(6 * nodes[1]);
  return displacement;
}

const double* element_history(const Model& model, std::size_t group, int element, const State& state) {
  return state.history.data() + model.history_begin[group] + model.groups[group]->history_begin(element);
}

const Vector12& EndForces::evaluate(const Model& model, std::size_t group, int element, const State& state,
                                    const VectorX& full_displacement) {
  const ElementGroup& elements = *model.groups[group];
  const auto history_size =
      static_cast<std::size_t>(elements.history_begin(elements.size()) - elements.history_begin(element));
  if (trial_.size() < history_size) trial_.resize(history_size);
  const double* committed = element_history(model, group, element, state);
  elements.start_step(element, committed, trial_.data());
  const Vector12 displacement = element_displacement(elements, element, full_displacement);
  elements.respond(element, displacement, committed, trial_.data(), force_, nullptr);
  if (elements.rate_dependent()) force_ += elements.rate_force(element, displacement, committed);
  const ElementPose pose = elements.pose(element, displacement, committed);
  for (const int end : {0, 1}) {
    const Vector3 force = force_.segment<3>(6 * end), moment = force_.segment<3>(6 * end + 3);
    force_.segment<3>(6 * end) = pose.axes * force;
    force_.segment<3>(6 * end + 3) = pose.axes * (moment - pose.arm[static_cast<std::size_t>(end)].cross(force));
  }
  return force_;
}

SectionForce section_force(const Vector12& end_forces, double along) {
  return {-(1 - along) * end_forces.segment<3>(0) + along * end_forces.segment<3>(6),
          -(1 - along) * end_forces.segment<3>(3) + along * end_forces.segment<3>(9)};
}

MemberLoad present_load(const ElementGroup& group, int element, const Vector12& displacement, const double* history) {
  const MemberLoad* const load = group.load(element);
  if (!load) return {};
  return load->dead() ? load->in(group.pose(element, displacement, history).axes) : *load;
}

SectionForce section_force(const Vector12& end_forces, double along, const MemberLoad& load, double part, double length) {
  SectionForce at = section_force(end_forces, along);
  if (load.empty() || part == 0) return at;
  const LoadedSection here = section_forces(load, along, length), start = section_forces(load, 0, length);
  at.force = -end_forces.head<3>() + part * (here.force - start.force);
  at.moment += part * here.moment;
  return at;
}

}  // namespace nsframe
