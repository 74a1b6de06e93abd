#include <algorithm>
#include <cmath>

#include "output/beam_shapes.hpp"
#include "output/frame_geometry.hpp"
#include "output/member_forces.hpp"

namespace nsframe {
namespace {

void store(std::vector<double>& field, int index, const Vector3& value) {
  std::copy_n(value.data(), 3, field.begin() + 3 * static_cast<std::ptrdiff_t>(index));
}

void evaluate_points(const FrameGeometry& geometry, const VectorX& displacement, const VectorX& velocity,
                     FrameFields& fields) {
  const VectorX moved = geometry.station_motion * displacement;
  const VectorX moving = geometry.station_motion * velocity;
  const auto size = 3 * static_cast<std::size_t>(geometry.points());
  fields.displacement.resize(size);
  fields.rotation.resize(size);
  fields.velocity.resize(size);
  for (int point = 0; point < geometry.points(); ++point) {
    const Eigen::Index first = 6 * geometry.station[static_cast<std::size_t>(point)];
    const Vector3& arm = geometry.arm[static_cast<std::size_t>(point)];
    const Vector3 rotation = moved.segment<3>(first + 3), spin = moving.segment<3>(first + 3);
    store(fields.displacement, point, moved.segment<3>(first) + rotation.cross(arm));
    store(fields.rotation, point, rotation);
    store(fields.velocity, point, moving.segment<3>(first) + spin.cross(arm));
  }
}

// Beams at large rotations: between their ends by the shape functions along the present chord, with the sections turned
// by the whole rotation. The field `rotation` stays that of the nodes' DOFs.
void evaluate_finite(const FrameGeometry& geometry, const Model& model, const State& state,
                     const VectorX& displacement, const VectorX& velocity, FrameFields& fields) {
  for (const FiniteMember& member : geometry.finite) {
    const ElementGroup& group = *model.groups[member.group];
    const ElementShape shape = group.shape(member.element);
    const ElementPose pose = group.pose(member.element, element_displacement(group, member.element, displacement),
                                        element_history(model, member.group, member.element, state));
    const Vector12 rate = element_displacement(group, member.element, velocity);
    const int first_station = geometry.station[static_cast<std::size_t>(member.first_point)];
    for (int point = member.first_point; point < member.last_point; ++point) {
      const auto i = static_cast<std::size_t>(point);
      const double along = double(geometry.station[i] - first_station) / member.segments;
      const SectionPlace place = finite_place(shape, pose, rate, along);
      const Vector3 arm = place.turn * geometry.arm[i];
      store(fields.displacement, point, place.displacement + arm - geometry.arm[i]);
      store(fields.velocity, point, place.velocity + place.spin.cross(arm));
    }
  }
}

const SectionResult& nearest_section(const std::vector<SectionResult>& sections, double along) {
  return *std::min_element(sections.begin(), sections.end(), [along](const auto& a, const auto& b) {
    return std::abs(a.position - along) < std::abs(b.position - along);
  });
}

void evaluate_members(const FrameGeometry& geometry, const Model& model, const State& state,
                      const VectorX& displacement, FrameFields& fields) {
  EndForces end_forces;
  for (const auto& drawn : geometry.drawn) {
    const Vector12& forces = end_forces.evaluate(model, drawn.group, drawn.element, state, displacement);
    const ElementGroup& group = *model.groups[drawn.group];
    const double* const history = element_history(model, drawn.group, drawn.element, state);
    const Vector12 at_nodes = element_displacement(group, drawn.element, displacement);
    const auto sections = group.sections(drawn.element, at_nodes, history);
    const MemberLoad load = present_load(group, drawn.element, at_nodes, history);
    const double length = group.shape(drawn.element).length, part = group.load_part(drawn.element, history);
    for (int cell = drawn.first_cell; cell < drawn.last_cell; ++cell) {
      const auto i = static_cast<std::size_t>(cell);
      const SectionForce at = section_force(forces, geometry.along[i], load, part, length);
      store(fields.force, cell, at.force);
      store(fields.moment, cell, at.moment);
      if (sections.empty()) continue;
      const SectionResult& section = nearest_section(sections, geometry.along[i]);
      fields.peak_strain_ratio[i] = section.peak_strain_ratio;
      fields.yielded[i] = section.yielded > 0 ? 1 : 0;
    }
  }
}

void evaluate_contacts(const FrameGeometry& geometry, const Model& model, const State& state,
                       const VectorX& interval_impulse, FrameFields& fields) {
  if (model.contacts.size() == 0) return;
  const VectorX gap = model.contacts.jacobian * state.displacement + model.contacts.initial_gap;
  for (std::size_t i = 0; i < geometry.pair.size(); ++i) {
    const int pair = geometry.pair[i];
    if (pair < 0) continue;
    fields.gap[i] = gap[pair];
    if (pair < interval_impulse.size()) fields.impulse[i] = interval_impulse[pair];
  }
}

}  // namespace

void evaluate_frame(const FrameGeometry& geometry, const Model& model, const State& state,
                    const VectorX& interval_impulse, FrameFields& fields) {
  const auto cells = static_cast<std::size_t>(geometry.cells());
  fields.force.assign(3 * cells, 0.0);
  fields.moment.assign(3 * cells, 0.0);
  fields.peak_strain_ratio.assign(cells, 0.0);
  fields.gap.assign(cells, 0.0);
  fields.impulse.assign(cells, 0.0);
  fields.yielded.assign(cells, 0);
  const VectorX displacement = model.dofs.expand(state.displacement);
  const VectorX velocity = model.dofs.expand(state.velocity);
  evaluate_points(geometry, displacement, velocity, fields);
  evaluate_finite(geometry, model, state, displacement, velocity, fields);
  evaluate_members(geometry, model, state, displacement, fields);
  evaluate_contacts(geometry, model, state, interval_impulse, fields);
}

}  // namespace nsframe
