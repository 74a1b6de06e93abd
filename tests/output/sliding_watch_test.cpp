// The constant directions of contact against the exact gap of a corner and a turned edge.
#include "output/sliding_watch.hpp"

#include <doctest/doctest.h>

#include <cmath>

#include "models/snapshot.hpp"
#include "tests/models/descriptions.hpp"

using namespace nsframe;
using namespace nsframe::test;

namespace {

constexpr double turn = 0.01, slide = 0.2;  // [rad], [m]

// The narrow slab of "left" before the wide edge of "right", 10 cm apart.
Model corner_and_edge() {
  ModelDescription d = two_slabs();
  for (const int i : {0, 1}) d.structures[1].nodes[static_cast<std::size_t>(i)].position.y() -= 1;
  for (const int i : {2, 3}) d.structures[1].nodes[static_cast<std::size_t>(i)].position.y() += 1;
  ContactDescription c = slab_contact();
  c.kind = ContactKind::slab_edges;
  d.contacts = {c};
  return build(d);
}

// `right` turned about its centre and shifted along y and x.
State moved(const Model& model, double angle, double along, double closer) {
  State state;
  state.time = 1.5;
  state.displacement = VectorX::Zero(model.dofs.size());
  state.impulse = VectorX::Zero(model.contacts.size());
  for (int i = 0; i < model.dofs.size(); ++i) {
    const FreeDof& dof = model.dofs.free[static_cast<std::size_t>(i)];
    if (!model.nodes.id[static_cast<std::size_t>(dof.node)].starts_with("right")) continue;
    if (dof.direction == 0) state.displacement[i] = -closer;
    if (dof.direction == 1) state.displacement[i] = along;
    if (dof.direction == 5) state.displacement[i] = angle;
  }
  return state;
}

}  // namespace

TEST_CASE("the error that sliding along a turned face makes is the difference to the exact gap") {
  const Model model = corner_and_edge();
  const State state = moved(model, turn, slide, 0.1);
  SlidingWatch watch;
  watch.start(model, state);
  watch.step(state, state, {}, {});
  const VectorX gap = model.contacts.jacobian * state.displacement + model.contacts.initial_gap;
  // exact: the left face of right through (2.1, y) about its centre (3.1, 0.5), turned and shifted
  const auto exact = [](const Vector2& corner) {
    const Vector2 outward(-std::cos(turn), -std::sin(turn)), on_face = Vector2(3.1 - 0.1, 0.5 + slide) + outward;
    return outward.dot(corner - on_face);
  };
  CHECK(watch.faults()[0].gap_error == 0);  // 5 mm open: farther than the error
  // the angle squared times lengths of a metre is left out: 0.1 mm of 2 mm
  CHECK(watch.faults()[1].gap_error == doctest::Approx(std::abs(exact({2, 1}) - gap[1])).epsilon(0.1));
  REQUIRE(watch.warnings().size() == 1);
  CHECK(watch.warnings()[0].find("makes the gap of 'left.1:3|right.1:4-1' wrong by 1.9 mm at t = 1.5 s (sliding_error = 1 mm)") != std::string::npos);
}

TEST_CASE("small sliding, sliding far away and sliding without turning are not warned of") {
  const Model model = corner_and_edge();
  for (const State& state : {moved(model, turn, 0.05, 0.1), moved(model, turn, slide, 0), moved(model, 0, slide, 0.11)}) {
    SlidingWatch watch;
    watch.start(model, state);
    watch.step(state, state, {}, {});
    CHECK(watch.warnings().empty());
  }
}

TEST_CASE("a corner that touches beyond the end of its edge is told, and kept over a resumption") {
  const Model model = corner_and_edge();
  const State state = moved(model, 0, 1.3, 0.12);  // the edge ends 1 m beside the corner
  SlidingWatch watch;
  watch.start(model, state);
  watch.step(state, state, {}, {});
  REQUIRE(watch.warnings().size() == 1);
  CHECK(watch.warnings()[0] == "pair 'left.1:2|right.1:4-1' touches after one side has slid 3e+02 mm beyond the other (t = 1.5 s): in truth "
                               "they miss");
  Snapshot snapshot;
  watch.save(snapshot);
  SlidingWatch again;
  again.resume(model, state, snapshot);
  CHECK(again.warnings() == watch.warnings());
  const State open = moved(model, 0, 1.3, 0);
  SlidingWatch apart;
  apart.start(model, open);
  apart.step(open, open, {}, {});
  CHECK(apart.warnings().empty());
}
