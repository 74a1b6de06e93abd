// Constraints by transformation u = T q: lever arms, masses, loads, and frames with rigid slabs.
#include <doctest/doctest.h>


#include "assembly/assembler.hpp"
#include "integrators/static_analysis.hpp"
#include "modal/modes.hpp"
#include "tests/support/numbers.hpp"
#include "tests/support/small_models.hpp"

using namespace nsframe;
using namespace nsframe::test;

namespace {

// Node "m" at the origin, free, and slaves "1", "2", ... at the given arms.
ModelDescription body(ConstraintKind kind, const std::vector<Vector3>& arms) {
  ModelDescription d;
  StructureDescription s;
  s.name = "a";
  s.may_move_freely = true;
  s.nodes = {node("m", 0, 0, 0)};
  s.masses = {mass("m", 1, Vector3::Ones())};
  std::vector<std::string> slaves;
  for (const Vector3& arm : arms) {
    slaves.push_back(std::to_string(slaves.size() + 1));
    s.nodes.push_back({slaves.back(), {}, arm});
  }
  s.constraints = {constraint(kind, "m", slaves)};
  d.structures = {s};
  return d;
}

// A one-story frame of four columns, plan 3.2 x 2.2, eccentric mass; its slab: a rigid body of center "c" and four
// corners, or very stiff links between them.
ModelDescription slab_frame(double link_factor) {
  ModelDescription d;
  d.sections = {elastic_section("column", {210e9, 81e9, 3e-3, 1e-5, 4e-6, 8e-8}),
                elastic_section("link", {210e9 * link_factor, 81e9 * link_factor, 3e-3, 1e-5, 1e-5, 1e-5})};
  StructureDescription s;
  s.name = "a";
  s.nodes = {node("c", 1.6, 1.1, 2.5)};
  const std::array<std::array<double, 2>, 4> plan{{{0, 0}, {3.2, 0}, {3.2, 2.2}, {0, 2.2}}};
  std::vector<std::string> corners;
  for (std::size_t i = 0; i < 4; ++i) {
    const std::string base = "b" + std::to_string(i), top = "t" + std::to_string(i);
    s.nodes.push_back(node(base, plan[i][0], plan[i][1], 0));
    s.nodes.push_back(node(top, plan[i][0], plan[i][1], 2.5));
    s.supports.push_back(fixed(base));
    s.elements.push_back(beam("col" + std::to_string(i), base, top, "column"));
    if (link_factor > 0) s.elements.push_back(beam("link" + std::to_string(i), "c", top, "link"));
    s.masses.push_back(mass(top, 500 + 100 * static_cast<double>(i)));
    corners.push_back(top);
  }
  s.masses.push_back(mass("c", 2000, Vector3(10, 20, 30)));
  if (link_factor == 0) s.constraints = {constraint(ConstraintKind::rigid_body, "c", corners)};
  d.structures = {s};
  if (link_factor == 0) d.sections.pop_back();
  return d;
}

VectorX frequencies(const Model& model) {
  const Assembler assembler(model);
  return solve_modes(assembler.tangent(), model.mass, 6).circular_frequency;
}

}  // namespace

TEST_CASE("a corner of a rigid body moves by the master's translation plus its rotation times the lever arm") {
  const Vector3 arm(1.5, -2, 0.5);
  const Model model = build(body(ConstraintKind::rigid_body, {arm}));
  REQUIRE(model.dofs.size() == 6);
  Vector6 q;
  q << 0.1, 0.2, 0.3, 0.01, -0.02, 0.03;
  const VectorX u = model.dofs.expand(q);
  // by hand: r x arm = (-0.02*0.5 - 0.03*(-2), 0.03*1.5 - 0.01*0.5, 0.01*(-2) - (-0.02)*1.5) = (0.05, 0.04, 0.01)
  Vector6 expected;
  expected << 0.15, 0.24, 0.31, 0.01, -0.02, 0.03;
  CHECK((u.segment<6>(full_dof(model, "a.1", 0)) - expected).norm() < 8 * epsilon);
}

TEST_CASE("a node of a diaphragm follows in the plane and about z, and is free out of it") {
  ModelDescription d = body(ConstraintKind::diaphragm, {{3, 2, 0.1}});
  d.structures[0].masses.push_back(mass("1", 1, Vector3::Ones()));
  const Model model = build(d);
  REQUIRE(model.dofs.size() == 9);
  VectorX q = VectorX::Zero(9);
  q.head<6>() << 0.1, 0.2, 0.3, 0.01, 0.02, 0.05;
  const VectorX u = model.dofs.expand(q);
  Vector6 expected;
  expected << 0.1 - 0.05 * 2, 0.2 + 0.05 * 3, 0, 0, 0, 0.05;
  CHECK((u.segment<6>(full_dof(model, "a.1", 0)) - expected).norm() < 8 * epsilon);
}

TEST_CASE("a diaphragm normal to any axis moves as a rigid body in its plane") {
  const Vector3 arm(3, 2, -1.5);
  for (int normal = 0; normal < 3; ++normal) {
    CAPTURE(normal);
    ModelDescription d = body(ConstraintKind::diaphragm, {arm});
    d.structures[0].constraints[0].normal = Vector3::Unit(normal);
    d.structures[0].masses.push_back(mass("1", 1, Vector3::Ones()));
    const Model model = build(d);
    REQUIRE(model.dofs.size() == 9);
    VectorX q = VectorX::Zero(9);
    q.head<6>() << 0.1, 0.2, 0.3, 0.01, 0.02, 0.05;
    const Vector3 axis = Vector3::Unit(normal), in_plane = Vector3::Ones() - axis, turn = q[3 + normal] * axis;
    Vector6 expected;
    expected << in_plane.cwiseProduct(q.head<3>() + turn.cross(arm)), turn;
    CHECK((model.dofs.expand(q).segment<6>(full_dof(model, "a.1", 0)) - expected).norm() < 8 * epsilon);
  }
}

TEST_CASE("a diaphragm with any normal moves as a rigid body in its plane, and is free out of it") {
  const Vector3 arm(3, 2, -1.5);
  for (const Vector3& normal : {Vector3(0.3, -0.5, 2), Vector3(1, 0.2, 0.4), Vector3(-0.3, 1, 0.99)}) {
    ModelDescription d = body(ConstraintKind::diaphragm, {arm});
    d.structures[0].constraints[0].normal = normal;
    d.structures[0].masses.push_back(mass("1", 1, Vector3::Ones()));
    const Model model = build(d);
    REQUIRE(model.dofs.size() == 9);
    VectorX q(9);
    q << 0.1, 0.2, 0.3, 0.01, 0.02, 0.05, -0.4, 0.03, -0.07;
    const VectorX u = model.dofs.expand(q);
    const Vector6 master = u.segment<6>(full_dof(model, "a.m", 0)), slave = u.segment<6>(full_dof(model, "a.1", 0));
    const Vector3 n = normal.normalized();
    const Matrix3 in_plane = Matrix3::Identity() - n * n.transpose();
    const Vector3 spin = n.dot(master.tail<3>()) * n;
    CHECK((in_plane * (slave.head<3>() - master.head<3>() - spin.cross(arm))).norm() < 16 * epsilon);
    CHECK(std::abs(n.dot(slave.tail<3>() - master.tail<3>())) < 16 * epsilon);
    // three directions of its own: the motion along n and two rotations
    CHECK(n.dot(slave.head<3>() - master.head<3>()) != doctest::Approx(0));
  }
}

TEST_CASE("equal DOFs are equal, the others stay free") {
  ModelDescription d = body(ConstraintKind::equal_dof, {{3, 2, 1}});
  d.structures[0].constraints[0].dofs = {true, false, true, false, false, true};
  d.structures[0].masses.push_back(mass("1", 1, Vector3::Ones()));
  const Model model = build(d);
  REQUIRE(model.dofs.size() == 9);
  VectorX q = VectorX::Zero(9);
  q.head<6>() << 1, 2, 3, 4, 5, 6;
  Vector6 expected;
  expected << 1, 0, 3, 0, 0, 6;
  CHECK(model.dofs.expand(q).segment<6>(full_dof(model, "a.1", 0)) == expected);
}

TEST_CASE("a chain of rigid bodies moves as one body") {
  ModelDescription d = body(ConstraintKind::rigid_body, {{1, 0, 0}});
  d.structures[0].nodes.push_back(node("far", 1, 2, 3));
  d.structures[0].constraints.push_back(constraint(ConstraintKind::rigid_body, "1", {"far"}));
  const Model chain = build(d), direct = build(body(ConstraintKind::rigid_body, {{1, 0, 0}, {1, 2, 3}}));
  CHECK(MatrixX(chain.dofs.transformation) == MatrixX(direct.dofs.transformation));
}

TEST_CASE("a rigid slab has its corners' mass, their static moment, and their inertia by the parallel-axis theorem") {
  const std::vector<Vector3> arms{{-1.6, -1.1, 0}, {1.6, -1.1, 0}, {1.6, 1.1, 0.2}, {-1.6, 1.1, 0}};
  ModelDescription d = body(ConstraintKind::rigid_body, arms);
  double total = 1;
  Vector3 moment = Vector3::Zero();
  Matrix3 inertia = Matrix3::Identity();
  for (std::size_t i = 0; i < arms.size(); ++i) {
    const double m = 100.0 + 10 * static_cast<double>(i), own = 3;
    d.structures[0].masses.push_back(mass(std::to_string(i + 1), m, Vector3::Constant(own)));
    total += m;
    moment += m * arms[i];
    inertia += own * Matrix3::Identity() + m * (arms[i].squaredNorm() * Matrix3::Identity() - arms[i] * arms[i].transpose());
  }
  const Model model = build(d);
  const MatrixX M(model.mass);
  const double rounding = 16 * epsilon * M.norm();
  CHECK((M.topLeftCorner<3, 3>() - total * Matrix3::Identity()).norm() < rounding);
  CHECK((M.bottomRightCorner<3, 3>() - inertia).norm() < rounding);
  Matrix3 coupling;  // momentum of a rotation r: sum m r x arm = -skew(moment) r
  coupling << 0, moment.z(), -moment.y(), -moment.z(), 0, moment.x(), moment.y(), -moment.x(), 0;
  CHECK((M.topRightCorner<3, 3>() - coupling).norm() < rounding);
  CHECK((M - M.transpose()).norm() < rounding);
  CHECK(model.total_mass() == doctest::Approx(total).epsilon(4 * epsilon));
}

TEST_CASE("the ground's acceleration loads a rigid slab by its mass and by the moment of its eccentric masses") {
  ModelDescription d = body(ConstraintKind::rigid_body, {{0, 2, 0.5}});
  d.structures[0].masses.push_back(mass("1", 10));
  MotionDescription motion;
  motion.dt = 0.1;
  motion.acceleration = {0, 1};
  motion.direction = Vector3(0.6, 0.8, 0);
  d.motions = {motion};
  d.gravity.acceleration = Vector3(0, 0, -9.81);
  const Model model = build(d);
  // -m a at the arm (0, 2, 0.5): force -11 (0.6, 0.8, 0), moment arm x (-10 a) = -10 (-0.4, 0.3, -1.2)
  Vector6 expected;
  expected << -6.6, -8.8, 0, 4, -3, 12;
  CHECK((model.motion_load[0] - expected).norm() < 64 * epsilon);
  // gravity at the arm: moment arm x (0, 0, -98.1) = (-196.2, 0, 0)
  expected << 0, 0, -11 * 9.81, -196.2, 0, 0;
  CHECK((model.gravity_load - expected).norm() < 64 * epsilon * 200);
}

TEST_CASE("a frame with a rigid slab has the frequencies of one with stiff links, up to the ratio of stiffnesses") {
  const VectorX rigid = frequencies(build(slab_frame(0)));
  for (const double factor : {1e3, 1e5}) {
    const VectorX linked = frequencies(build(slab_frame(factor)));
    CAPTURE(factor);
    // the links have sections like the columns' and similar lengths: the relative difference is some tens of 1 / factor
    CHECK(((linked - rigid).cwiseAbs().cwiseQuotient(rigid)).maxCoeff() < 50 / factor);
    CHECK(((linked - rigid).cwiseAbs().cwiseQuotient(rigid)).maxCoeff() > 1 / factor);
  }
}

TEST_CASE("under a load, corners of a rigid slab displace as a rigid body and the columns' forces balance it") {
  const Model model = build(slab_frame(0));
  System system(model, 1);
  State state = virgin_state(system);
  VectorX full = VectorX::Zero(model.dofs.full);
  full[full_dof(model, "a.t1", 1)] = 1e4;
  solve_static(system, model.dofs.transformation_transposed * full, StaticOptions{}, state);
  const VectorX u = model.dofs.expand(state.displacement);
  const Vector3 center = u.segment<3>(full_dof(model, "a.c", 0)), rotation = u.segment<3>(full_dof(model, "a.c", 3));
  for (int i = 0; i < 4; ++i) {
    const int first = full_dof(model, "a.t" + std::to_string(i), 0);
    const Vector3 arm = model.nodes.position[static_cast<std::size_t>(first / 6)] - Vector3(1.6, 1.1, 2.5);
    CHECK((u.segment<3>(first) - center - rotation.cross(arm)).norm() < 8 * epsilon);  // displacements are below 1 m
  }
  CHECK(rotation.z() > 0);
}
