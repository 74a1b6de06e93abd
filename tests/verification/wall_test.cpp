// Walls as wide columns against closed forms of Timoshenko's beam and an assembly of coupled walls of its own, G' k G.
#include <doctest/doctest.h>

#include "base/decompositions.hpp"
#include "integrators/static_analysis.hpp"
#include "models/wall.hpp"
#include "tests/support/small_models.hpp"

using namespace nsframe;
using namespace nsframe::test;

namespace {

constexpr double concrete_E = 30e9, concrete_poisson = 0.2, concrete_G = concrete_E / 2.4;  // [Pa]
constexpr double wall_length = 4, wall_thickness = 0.25, story_height = 3;                  // [m]
constexpr int wall_stories = 4;
constexpr double wall_I = wall_thickness * wall_length * wall_length * wall_length / 12;
constexpr double wall_shear_area = 5.0 / 6 * wall_thickness * wall_length;

// The wall called `id` with nodes id0, id1, ... from the foot at `at`; returns the structure's last node.
std::string stand_wall(const std::string& id, const Vector3& at, const Vector3& direction, ElementKind kind, StructureDescription& s) {
  Wall wall;
  wall.member.id = id;
  wall.member.kind = kind;
  wall.section = {{"wall", {}}};
  wall.direction = direction;
  wall.length = wall_length;
  for (int floor = 0; floor <= wall_stories; ++floor) {
    wall.nodes.push_back({id + std::to_string(floor), {}});
    s.nodes.push_back(node(wall.nodes.back().name, at.x(), at.y(), at.z() + floor * story_height));
  }
  REQUIRE(faults(wall, s).empty());
  expand(wall, s);
  s.supports.push_back(fixed(wall.nodes.front().name));
  return wall.nodes.back().name;
}

ModelDescription cantilever_wall(const Vector3& direction, ElementKind kind = ElementKind::elastic_beam) {
  ModelDescription d;
  d.sections = {elastic_section("wall", wall_section(wall_length, wall_thickness, concrete_E, concrete_poisson))};
  StructureDescription& s = d.structures.emplace_back();
  s.name = "a";
  stand_wall("w", Vector3(1, 2, 0.5), direction, kind, s);
  return d;
}

// Displacements of all nodes under a force at one of them.
VectorX displaced_by(const Model& model, const std::string& at, const Vector3& force) {
  System system(model, 1);
  State state = virgin_state(system);
  VectorX load = VectorX::Zero(model.dofs.full);
  load.segment<3>(full_dof(model, at, 0)) = force;
  solve_static(system, model.dofs.transformation_transposed * load, {}, state);
  return model.dofs.expand(state.displacement);
}

}  // namespace

TEST_CASE("a cantilever wall bends and shears as Timoshenko's beam in its plane and across, its edges follow rigidly") {
  const double H = wall_stories * story_height, F = 1e5, GA = concrete_G * wall_shear_area;
  for (const Vector3& direction : {Vector3(1, 0, 0), Vector3(0, -1, 0), Vector3(0.6, 0.8, 0)}) {
    const Model model = build(cantilever_wall(direction));
    CHECK(model.dofs.size() == 6 * wall_stories);
    const Vector3 across = Vector3::UnitZ().cross(direction);
    const double weak = wall_length * wall_thickness * wall_thickness * wall_thickness / 12;
    for (const auto& [push, inertia] : {std::pair{direction, wall_I}, {across, weak}}) {
      const VectorX u = displaced_by(model, "a.w4", F * push);
      const Vector3 top = u.segment<3>(full_dof(model, "a.w4", 0)), turn = u.segment<3>(full_dof(model, "a.w4", 3));
      const double EI = concrete_E * inertia, deflection = F * H * H * H / (3 * EI) + F * H / GA, slope = F * H * H / (2 * EI);
      CHECK((top - deflection * push).norm() < 1e-9 * deflection);
      CHECK((turn - slope * Vector3::UnitZ().cross(push)).norm() < 1e-9 * slope);
      // the rotation takes the leading edge down and the other up
      for (const auto& [edge, to_edge] : {std::pair{"a.w4+", wall_length / 2}, {"a.w4-", -wall_length / 2}}) {
        const Vector3 moved = u.segment<3>(full_dof(model, edge, 0)), expected = top + turn.cross(Vector3(to_edge * direction));
        CHECK((moved - expected).norm() < 1e-12 * deflection);
        if (push == direction) CHECK(moved.z() == doctest::Approx(-to_edge * slope).epsilon(1e-9));
      }
    }
  }
}

TEST_CASE("a wall of elastic fibers bends as the solid one, and shears where its section has a law of shear") {
  const double H = wall_stories * story_height, F = 1e5;
  constexpr int cuts = 40;
  const double cut = wall_I * (1 - 1.0 / (cuts * cuts));  // of fibers without inertia of their own
  for (const ElementKind kind : {ElementKind::displacement_beam, ElementKind::force_beam}) {
    ModelDescription d = cantilever_wall(Vector3::UnitY(), kind);
    d.materials = {{"concrete", {}, Elastic{concrete_E}}, {"shear", {}, Elastic{concrete_G * wall_shear_area}}};
    FiberSectionDescription section;
    for (int i = 0; i < cuts; ++i) {
      const double y = wall_length * ((i + 0.5) / cuts - 0.5), area = wall_length * wall_thickness / cuts / 2;
      for (const double z : {-0.06, 0.06}) section.fibers.push_back({y, z, area, {"concrete", {}}});
    }
    section.torsion_stiffness = 1e9;
    const bool shears = kind == ElementKind::force_beam;
    if (shears) section.shear_y = Reference{"shear", {}};
    d.sections = {{"wall", {}, section, {}}};
    const Model model = build(d);
    const double expected = F * H * H * H / (3 * concrete_E * cut) + (shears ? F * H / (concrete_G * wall_shear_area) : 0);
    CHECK(displaced_by(model, "a.w4", Vector3(0, F, 0))[full_dof(model, "a.w4", 1)] == doctest::Approx(expected).epsilon(1e-9));
  }
}

namespace {

constexpr double lintel_span = 1.8, wall_arm = wall_length / 2;  // of lintels [m]

// Timoshenko's beam in a plane for (w1, p1, w2, p2), p = dw/dx.
MatrixX timoshenko_in_plane(double EI, double GA, double L) {
  const double shear = 12 * EI / (GA * L * L), k = EI / (L * L * L * (1 + shear));
  MatrixX out(4, 4);
  const double near = (4 + shear) * L * L, far = (2 - shear) * L * L;
  out << 12, 6 * L, -12, 6 * L,     //
      6 * L, near, -6 * L, far,     //
      -12, -6 * L, 12, -6 * L,      //
      6 * L, far, -6 * L, near;
  return k * out;
}

// Stiffness of two walls with lintels from edge to edge in their plane: u, w, p = dw/dx of the floors of the left wall, then of
// the right one; floors are not rigid along x.
MatrixX coupled_walls(const ElasticSection& lintel) {
  const int n = 6 * wall_stories;
  MatrixX K = MatrixX::Zero(n, n);
  const auto add = [&K](const MatrixX& map, const MatrixX& k) { K += map.transpose() * k * map; };
  for (int wall = 0; wall < 2; ++wall) {
    const auto dof = [wall](int floor, int k) { return 3 * (wall * wall_stories + floor - 1) + k; };
    for (int floor = 1; floor <= wall_stories; ++floor) {
      MatrixX bend = MatrixX::Zero(4, n), press = MatrixX::Zero(1, n);
      for (int end = 0; end < 2; ++end) {
        if (floor - 1 + end == 0) continue;
        bend(2 * end, dof(floor - 1 + end, 0)) = 1;
        bend(2 * end + 1, dof(floor - 1 + end, 2)) = -1;  // du/dz
        press(0, dof(floor - 1 + end, 1)) = end == 1 ? 1 : -1;
      }
      add(bend, timoshenko_in_plane(concrete_E * wall_I, concrete_G * wall_shear_area, story_height));
      add(press, MatrixX::Constant(1, 1, concrete_E * wall_length * wall_thickness / story_height));
    }
  }
  for (int floor = 0; floor < wall_stories; ++floor) {
    const int left = 3 * floor, right = 3 * (wall_stories + floor);
    MatrixX bend = MatrixX::Zero(4, n), press = MatrixX::Zero(1, n);
    bend(0, left + 1) = bend(1, left + 2) = bend(2, right + 1) = bend(3, right + 2) = 1;
    bend(0, left + 2) = wall_arm;
    bend(2, right + 2) = -wall_arm;
    press(0, left) = -1;
    press(0, right) = 1;
    add(bend, timoshenko_in_plane(concrete_E * lintel.Iz, concrete_G * lintel.Ay, lintel_span));
    add(press, MatrixX::Constant(1, 1, concrete_E * lintel.A / lintel_span));
  }
  return K;
}

ModelDescription coupled_by(const ElasticSection& lintel) {
  ModelDescription d;
  d.sections = {elastic_section("wall", wall_section(wall_length, wall_thickness, concrete_E, concrete_poisson)),
                elastic_section("lintel", lintel)};
  StructureDescription& s = d.structures.emplace_back();
  s.name = "a";
  stand_wall("l", Vector3::Zero(), Vector3::UnitX(), ElementKind::elastic_beam, s);
  stand_wall("r", Vector3(2 * wall_arm + lintel_span, 0, 0), Vector3::UnitX(), ElementKind::elastic_beam, s);
  for (int floor = 1; floor <= wall_stories; ++floor) {
    const std::string number = std::to_string(floor);
    s.elements.push_back(beam("b" + number, "l" + number + "+", "r" + number + "-", "lintel"));
    for (const std::string& axis : {"l" + number, "r" + number}) s.supports.push_back(fixed(axis, {false, true, false, true, false, true}));
  }
  return d;
}

}  // namespace

TEST_CASE("coupled walls move as an assembly of plane beams with rigid arms by G' k G") {
  const ElasticSection lintel = wall_section(0.6, wall_thickness, concrete_E, concrete_poisson);
  const MatrixX K = coupled_walls(lintel);
  const Model model = build(coupled_by(lintel));
  REQUIRE(model.dofs.size() == K.rows());
  const Assembler assembler(model);
  // DOF by DOF: ux, uz, ry = -dw/dx
  VectorX sign(K.rows());
  std::vector<int> place;
  for (const std::string side : {"a.l", "a.r"}) {
    for (int floor = 1; floor <= wall_stories; ++floor) {
      for (const int k : {0, 2, 4}) {
        int found = -1;
        for (int i = 0; i < model.dofs.size(); ++i) {
          const auto& free = model.dofs.free[static_cast<std::size_t>(i)];
          if (6 * free.node + free.direction == full_dof(model, side + std::to_string(floor), k)) found = i;
        }
        REQUIRE(found >= 0);
        sign[static_cast<Eigen::Index>(place.size())] = k == 4 ? -1 : 1;
        place.push_back(found);
      }
    }
  }
  const MatrixX of_model = MatrixX(assembler.tangent())(place, place);
  CHECK((sign.asDiagonal() * of_model * sign.asDiagonal() - K).norm() < 1e-12 * K.norm());
}

TEST_CASE("a lintel resists equal rotations of both walls by 6 EI/l (1 + 2 a/l)^2, sheared or not") {
  const auto resistance = [](const ElasticSection& lintel) {
    const Model with = build(coupled_by(lintel)), without = [&] {
      ModelDescription d = coupled_by(lintel);
      d.structures[0].elements.pop_back();
      return build(d);
    }();
    const auto moments = [](const Model& model) {
      VectorX turn = VectorX::Zero(model.dofs.size());
      for (int i = 0; i < model.dofs.size(); ++i) {
        const auto& free = model.dofs.free[static_cast<std::size_t>(i)];
        const std::string& id = model.nodes.id[static_cast<std::size_t>(free.node)];
        if (free.direction == 4 && (id == "a.l4" || id == "a.r4")) turn[i] = 1;
      }
      return VectorX(Assembler(model).tangent() * turn).dot(turn) / 2;  // of one wall
    };
    return moments(with) - moments(without);
  };
  ElasticSection lintel = wall_section(0.6, wall_thickness, concrete_E, concrete_poisson);
  const double shear = 12 * concrete_E * lintel.Iz / (concrete_G * lintel.Ay * lintel_span * lintel_span);
  const double factor = 1 + 2 * wall_arm / lintel_span;
  const double bending = 6 * concrete_E * lintel.Iz / lintel_span * factor * factor;
  CHECK(resistance(lintel) == doctest::Approx(bending / (1 + shear)).epsilon(1e-9));
  lintel.Ay = lintel.Az = 0;
  CHECK(resistance(lintel) == doctest::Approx(bending).epsilon(1e-9));
}
