// Two one-bay, two-story steel frames side by side, with slabs and the paper's eight-DOF contact: what the output tests
// write to files.
#pragma once

#include <fmt/format.h>

#include <cmath>

#include "elements/catalogue.hpp"
#include "integrators/simulation.hpp"
#include "models/model.hpp"
#include "tests/support/files.hpp"

namespace nsframe::test {

inline constexpr double story_height = 2.5;              // [m]
inline constexpr double span_x = 3.2, span_y = 2.2;      // [m]
inline constexpr double sample_gap[2] = {0.050, 0.055};  // [m] at low and high y

inline SectionDescription sample_section(const std::string& name) {
  const CatalogueShape* shape = find_shape(name);
  ElasticSection section{210e9, 81e9, shape->A, shape->I_strong, shape->I_weak, shape->J};
  return {name, {}, section, shape_outline(*shape)};
}

// Nodes 1-4 at the feet, 11-14 and 21-24 at the floors, counter-clockwise from the corner at `x`, y = 0.
inline StructureDescription sample_frame(const std::string& name, double x, double floor_mass) {
  StructureDescription frame;
  frame.name = name;
  const double xs[] = {0, span_x, span_x, 0}, ys[] = {0, 0, span_y, span_y};
  for (int floor = 0; floor <= 2; ++floor) {
    SlabDescription slab;
    for (int i = 0; i < 4; ++i) {
      const std::string id = fmt::format("{}", 10 * floor + i + 1);
      frame.nodes.push_back({id, {}, Vector3(x + xs[i], ys[i], floor * story_height)});
      if (floor == 0) frame.supports.push_back({{id, {}}, {true, true, true, true, true, true}});
      if (floor == 0) continue;
      frame.masses.push_back({{id, {}}, Vector3::Constant(floor_mass / 4), Vector3::Zero()});
      slab.corners.push_back({id, {}});
      ElementDescription column, beam;
      column.id = fmt::format("c{}", id);
      column.node_i = {fmt::format("{}", 10 * (floor - 1) + i + 1), {}};
      column.node_j = {id, {}};
      column.section = {"HEA100", {}};
      column.orientation = Vector3::UnitX();
      beam.id = fmt::format("b{}", id);
      beam.node_i = {id, {}};
      beam.node_j = {fmt::format("{}", 10 * floor + (i + 1) % 4 + 1), {}};
      beam.section = {"IPE200", {}};
      frame.elements.push_back(column);
      frame.elements.push_back(beam);
    }
    slab.id = fmt::format("floor{}", floor);
    if (floor > 0) frame.slabs.push_back(slab);
  }
  frame.damping.kind = DampingKind::modal;
  frame.damping.ratios = {0.007, 0.013, 0.02};
  return frame;
}

// `pulse`: half a sine of base acceleration along x, with a lasting part along y [m/s2].
inline ModelDescription sample_description(double pulse = 3) {
  ModelDescription pair;
  pair.sections = {sample_section("HEA100"), sample_section("IPE200")};
  pair.structures = {sample_frame("left", 0, 4600), sample_frame("right", span_x + 0.0525, 3500)};
  ContactDescription contact;
  contact.a = {"left", {}};
  contact.b = Reference{"right", {}};
  contact.gap = {sample_gap[0], sample_gap[1]};
  pair.contacts = {contact};
  MotionDescription motion;
  motion.dt = 0.01;
  for (int i = 0; i <= 200; ++i) motion.acceleration.push_back(pulse * std::sin(2 * pi * 3 * 0.01 * i));
  pair.motions = {motion};
  return pair;
}

inline Model sample_pair(double pulse = 3) {
  Diagnostics diagnostics;
  return build_model(sample_description(pulse), diagnostics);
}

// A state whose DOFs are all different, and small.
inline State sample_state(const Model& model, double time = 0) {
  State state;
  state.time = time;
  const Eigen::Index n = model.dofs.size();
  state.displacement = VectorX::NullaryExpr(n, [](Eigen::Index i) { return 1e-3 * std::sin(1.0 + 0.7 * double(i)); });
  state.velocity = VectorX::NullaryExpr(n, [](Eigen::Index i) { return 1e-2 * std::cos(0.3 + 0.9 * double(i)); });
  state.internal_force = VectorX::Zero(n);
  state.history = VectorX::Zero(model.history_size());
  for (std::size_t g = 0; g < model.groups.size(); ++g) {
    for (int e = 0; e < model.groups[g]->size(); ++e) {
      model.groups[g]->initialize_history(
          e, state.history.data() + model.history_begin[g] + model.groups[g]->history_begin(e));
    }
  }
  state.impulse = VectorX::Zero(model.contacts.size());
  return state;
}

inline int node_index(const Model& model, const std::string& id) {
  for (int i = 0; i < model.nodes.size(); ++i) {
    if (model.nodes.id[static_cast<std::size_t>(i)] == id) return i;
  }
  return -1;
}

}  // namespace nsframe::test
