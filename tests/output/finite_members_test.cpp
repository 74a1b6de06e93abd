// Corotational members as drawn and as reported: a cantilever rolled up to a circle, and one turned as a whole.
#include <doctest/doctest.h>

#include <cmath>

#include "base/rotation.hpp"
#include "models/state.hpp"
#include "output/frame_geometry.hpp"
#include "output/member_forces.hpp"
#include "tests/support/small_models.hpp"

using namespace nsframe;
using namespace nsframe::test;

namespace {

constexpr int elements = 16;
constexpr double radius = 1 / (2 * pi);

// Free, of length 1 along x, local y upwards in the plane of the circle.
ModelDescription ring(const std::array<Vector3, 2>& offset = {Vector3::Zero(), Vector3::Zero()}) {
  ModelDescription d;
  d.sections = {elastic_section("c", {1.0, 1.0, 1e4, 1.0, 1.0, 1.0})};
  d.sections[0].outline = {{-0.01, -0.02}, {0.01, -0.02}, {0.01, 0.02}, {-0.01, 0.02}};
  StructureDescription s;
  s.name = "a";
  s.may_move_freely = true;
  for (int i = 0; i <= elements; ++i) {
    s.nodes.push_back(node(std::to_string(i), double(i) / elements, 0, 0));
    s.masses.push_back(mass(std::to_string(i), 1, Vector3::Ones()));
  }
  for (int i = 0; i < elements; ++i) {
    s.elements.push_back(beam(std::to_string(i), std::to_string(i), std::to_string(i + 1), "c"));
    s.elements.back().geometry = Geometry::corotational;
    s.elements.back().orientation = Vector3::UnitZ();
    s.elements.back().offset = offset;
  }
  d.structures = {s};
  return d;
}

State state_of(const Model& model, const VectorX& displacement, const VectorX& velocity) {
  State state;
  state.displacement = displacement;
  state.velocity = velocity;
  state.impulse = VectorX::Zero(0);
  state.history = VectorX::Zero(model.history_size());
  const ElementGroup& beams = *model.groups.front();
  for (int e = 0; e < beams.size(); ++e) beams.initialize_history(e, state.history.data() + beams.history_begin(e));
  return state;
}

Vector3 at(const std::vector<double>& field, int i) { return Eigen::Map<const Vector3>(&field[3 * static_cast<std::size_t>(i)]); }

}  // namespace

TEST_CASE("a cantilever rolled up to a circle is drawn as a ring with its sections across") {
  const Model model = build(ring());
  const Vector3 centre(0, radius, 0), spin(0.3, -0.5, 2);
  VectorX u = VectorX::Zero(model.dofs.full), v = u;
  for (int i = 0; i <= elements; ++i) {
    const double s = double(i) / elements, t = 2 * pi * s;
    const Vector3 place(radius * std::sin(t), radius * (1 - std::cos(t)), 0);
    u.segment<3>(6 * i) = place - Vector3(s, 0, 0);
    u[6 * i + 5] = t;
    v.segment<3>(6 * i) = spin.cross(place - centre);
    v.segment<3>(6 * i + 3) = spin;
  }
  const FrameGeometry geometry = frame_geometry(model);
  FrameFields fields;
  evaluate_frame(geometry, model, state_of(model, u, v), VectorX(), fields);
  REQUIRE(geometry.finite.size() == elements);
  double farthest = 0;
  for (int point = 0; point < geometry.points(); ++point) {
    const Vector3& start = geometry.position[static_cast<std::size_t>(point)];
    const Vector3 place = start + at(fields.displacement, point) - centre;
    // the cubic between the ends of a 22.5-degree arc is 1e-4 of the radius off across and 5e-4 along
    CHECK(std::abs(place.head<2>().norm() - (radius - start.y())) < 3e-4 * radius);
    CHECK(std::abs(place.z() - start.z()) < 1e-12);
    const double t = 2 * pi * start.x();  // the section stands at its own angle
    CHECK(std::abs(place.x() * std::cos(t) + place.y() * std::sin(t)) < 1e-3 * radius);
    CHECK((at(fields.velocity, point) - spin.cross(place)).norm() < 1e-12);
    farthest = std::max(farthest, at(fields.rotation, point).z());
  }
  CHECK(farthest == doctest::Approx(2 * pi));
}

TEST_CASE("end forces of a corotational member with rigid arms are those at its ends, in its present axes") {
  const std::array<Vector3, 2> offset{Vector3(0.01, 0.02, -0.01), Vector3(-0.02, 0.01, 0.03)};
  ModelDescription d = ring(offset);
  d.structures[0].elements.resize(1);
  d.structures[0].elements[0].node_j = {"16", {}};
  d.structures[0].nodes = {d.structures[0].nodes.front(), d.structures[0].nodes.back()};
  d.structures[0].masses = {d.structures[0].masses.front(), d.structures[0].masses.back()};
  const Model model = build(d);
  // stretched by 1e-3 and bent by equal end rotations of 0.1 about local z, then turned as a whole
  const double elongation = 1e-3, bend = 0.1;
  const Vector3 end_i = offset[0], end_j = Vector3::UnitX() + offset[1], chord = end_j - end_i;
  const Matrix3 axes = beam_axes(end_i, end_j, Vector3::UnitZ());
  const Quaternion turn = rotation_exponential(Vector3(1.1, -0.7, 1.6)), curl = rotation_exponential(bend * axes.row(2).transpose());
  const Quaternion total = turn * curl;
  const Vector3 new_i(2, 3, 4), new_j = new_i + turn * (chord * (1 + elongation / chord.norm()));
  VectorX u = VectorX::Zero(12);
  u.segment<3>(0) = new_i - total * offset[0];
  u.segment<3>(6) = new_j - total * offset[1] - Vector3::UnitX();
  u.segment<3>(3) = u.segment<3>(9) = rotation_logarithm(total.toRotationMatrix());
  EndForces end_forces;
  const Vector12 f = end_forces.evaluate(model, 0, 0, state_of(model, u, VectorX::Zero(12)), u);
  const double L = chord.norm(), moment = 6 / L * bend;  // 4 EI/L + 2 EI/L
  Vector12 expected = Vector12::Zero();
  expected[0] = -1e4 * elongation / L;
  expected[6] = -expected[0];
  expected[5] = expected[11] = moment;
  expected[1] = 2 * moment / (L + elongation);
  expected[7] = -expected[1];
  CHECK((f - expected).norm() < 1e-10);
}
