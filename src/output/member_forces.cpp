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
  elements.respond(element, element_displacement(elements, element, full_displacement), committed, trial_.data(),
                   force_, nullptr);
  const Matrix3 axes = elements.shape(element).axes;
  for (Eigen::Index block = 0; block < 12; block += 3)
    force_.segment<3>(block) = (axes * force_.segment<3>(block)).eval();
  return force_;
}

SectionForce section_force(const Vector12& end_forces, double along) {
  return {-(1 - along) * end_forces.segment<3>(0) + along * end_forces.segment<3>(6),
          -(1 - along) * end_forces.segment<3>(3) + along * end_forces.segment<3>(9)};
}

}  // namespace nsframe
