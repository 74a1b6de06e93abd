// Contact pairs found by geometry: against rigid-body kinematics by hand, beam formulas, and each other.
#include <doctest/doctest.h>

#include <cmath>

#include "tests/integrators/oscillators.hpp"
#include "tests/models/descriptions.hpp"

using namespace nsframe;
using namespace nsframe::test;

namespace {

// A rigid slab of length x width about (x, y), free in all directions, node 5 its centre; corners counter-clockwise.
StructureDescription slab(const std::string& name, const Vector3& centre, double length, double width, double turn = 0) {
  StructureDescription s;
  s.name = name;
  s.at = at(60);
  const double c = std::cos(turn), n = std::sin(turn);
  const auto place = [&](double x, double y) { return Vector3(centre.x() + c * x - n * y, centre.y() + n * x + c * y, centre.z()); };
  const double x = length / 2, y = width / 2;
  const Vector3 corners[] = {place(-x, -y), place(x, -y), place(x, y), place(-x, y)};
  for (int i = 0; i < 4; ++i) s.nodes.push_back({std::to_string(i + 1), {}, corners[i]});
  s.nodes.push_back({"5", {}, centre});
  s.constraints = {constraint(ConstraintKind::rigid_body, "5", {"1", "2", "3", "4"})};
  s.masses = {mass("5", 1000, Vector3(300, 400, 700))};
  s.slabs.push_back({"s", at(61), {{"1", {}}, {"2", {}}, {"3", {}}, {"4", {}}}, Reference{"5", {}}, 0.2, true});
  s.may_move_freely = true;
  return s;
}

ModelDescription two(StructureDescription a, StructureDescription b, ContactKind kind) {
  ModelDescription d;
  d.structures = {std::move(a), std::move(b)};
  ContactDescription c = slab_contact();
  c.a.name = d.structures[0].name;
  c.b->name = d.structures[1].name;
  c.kind = kind;
  d.contacts = {c};
  return d;
}

void turn(ModelDescription& d, double angle) {
  const Matrix3 R = Eigen::AngleAxisd(angle, Vector3::UnitZ()).toRotationMatrix();
  for (StructureDescription& s : d.structures) {
    for (NodeDescription& n : s.nodes) n.position = R * n.position;
  }
  for (ContactDescription& c : d.contacts) c.direction = R * c.direction;
}

// Moves every free DOF of a rigid slab "name.5": displacement of its centre, rotation.
VectorX motion(const Model& model, const std::string& name, const Vector6& centre) {
  VectorX q = VectorX::Zero(model.dofs.size());
  for (int i = 0; i < model.dofs.size(); ++i) {
    const FreeDof& dof = model.dofs.free[static_cast<std::size_t>(i)];
    if (model.nodes.id[static_cast<std::size_t>(dof.node)] == name + ".5") q[i] = centre[dof.direction];
  }
  return q;
}

std::vector<std::string> pair_names(const Model& model) {
  std::vector<std::string> names;
  for (const ContactPair& pair : model.contacts.pairs) names.push_back(pair.name);
  return names;
}

constexpr double rounding = 1e-13;  // of some ten operations on numbers of order one

}  // namespace

TEST_CASE("slab edges: the corners of the narrower slab meet the edge of the wider one") {
  const Model model = build(two(slab("a", {0, 0, 3}, 4, 3), slab("b", {4.05, 0.2, 3}, 4, 6), ContactKind::slab_edges));
  CHECK(pair_names(model) == std::vector<std::string>{"a.s:2|b.s:4-1", "a.s:3|b.s:4-1"});
  CHECK((model.contacts.initial_gap.array() - 0.05).abs().maxCoeff() < rounding);
  // by hand: the corner of a is at (2, -1.5) from its centre; the point of b's edge opposite it at (-2, -1.7) from b's
  const Vector6 of_a = (Vector6() << 0.3, 0.2, -0.1, 0.02, -0.03, 0.05).finished();
  const Vector6 of_b = (Vector6() << -0.2, 0.4, 0.6, -0.01, 0.07, -0.04).finished();
  const VectorX g = model.contacts.jacobian * (motion(model, "a", of_a) + motion(model, "b", of_b));
  CHECK(std::abs(g[0] - ((of_b[0] - of_b[5] * -1.7) - (of_a[0] - of_a[5] * -1.5))) < rounding);
  CHECK(std::abs(g[1] - ((of_b[0] - of_b[5] * 1.3) - (of_a[0] - of_a[5] * 1.5))) < rounding);
}

TEST_CASE("slab edges of equal, aligned slabs are the pairs of slab corners") {
  const auto d = [](ContactKind kind) { return two(slab("a", {0, 0, 3}, 4, 3), slab("b", {4.05, 0, 3}, 4, 3), kind); };
  const Model corners = build(d(ContactKind::slab_corners)), edges = build(d(ContactKind::slab_edges));
  REQUIRE(edges.contacts.size() == 2);
  CHECK(MatrixX(corners.contacts.jacobian) == MatrixX(edges.contacts.jacobian));
  CHECK(corners.contacts.initial_gap == edges.contacts.initial_gap);
}

TEST_CASE("a corner of a turned slab meets an edge along the edge's normal") {
  const double angle = pi / 4, half = std::sqrt(2.0);  // half the diagonal of a square of 2 m
  const Model model = build(two(slab("a", {0, 0, 3}, 2, 2, angle), slab("b", {half + 0.1 + 2, 0.4, 3}, 4, 4), ContactKind::slab_edges));
  REQUIRE(model.contacts.size() == 1);
  CHECK((model.contacts.pairs[0].normal - Vector3::UnitX()).norm() < rounding);
  CHECK(std::abs(model.contacts.initial_gap[0] - 0.1) < rounding);
  CHECK(model.contacts.pairs[0].name == "a.s:2|b.s:4-1");
  CHECK(model.contacts.pairs[0].room[0].least == doctest::Approx(-2.4).epsilon(1e-12));  // b may move down until its upper end passes
  CHECK(model.contacts.pairs[0].room[0].most == doctest::Approx(1.6).epsilon(1e-12));
}

TEST_CASE("a scene turned by 30 degrees has the same impacts") {
  const auto impacts = [](double angle, ContactKind kind) {
    ModelDescription d = two(slab("a", {0, 0, 3}, 4, 3), slab("b", {4.05, 0.3, 3}, 4, kind == ContactKind::slab_corners ? 3 : 5), kind);
    const Vector3 v = Eigen::AngleAxisd(angle, Vector3::UnitZ()).toRotationMatrix() * Vector3(1.0, 0.1, 0);
    turn(d, angle);
    d.structures[0].initial_velocities = {{{"5", {}}, 0, v.x()}, {{"5", {}}, 1, v.y()}, {{"5", {}}, 5, 0.05}};
    return run(d, options(0.5, 1e-3, 0.2)).observed;
  };
  for (const ContactKind kind : {ContactKind::slab_corners, ContactKind::slab_edges}) {
    const auto straight = impacts(0, kind), turned = impacts(pi / 6, kind);
    REQUIRE(straight.size() >= 1);
    REQUIRE(straight.size() == turned.size());
    for (std::size_t i = 0; i < straight.size(); ++i) {
      CHECK(straight[i].time == turned[i].time);
      CHECK(straight[i].pair == turned[i].pair);
      CHECK(turned[i].impulse == doctest::Approx(straight[i].impulse).epsilon(1e-9));  // rounding over 200 steps
    }
  }
}

namespace {

// A column of 4 m in two pieces with lumped mass at mid-height, or in one, beside a free slab at that height.
ModelDescription slab_and_column(bool split) {
  StructureDescription tower;
  tower.name = "b";
  tower.at = at(70);
  tower.nodes = {node("0", 3.02, 0, 0), node("2", 3.02, 0, 4)};
  tower.supports = {fixed("0")};
  tower.masses = {mass("2", 5000, Vector3(200, 200, 200))};
  if (split) {
    tower.nodes.push_back(node("1", 3.02, 0, 2));
    tower.masses.push_back(mass("1", 150, Vector3(20, 20, 20)));
    tower.elements = {beam("1", "0", "1", "c"), beam("2", "1", "2", "c")};
  } else {
    tower.elements = {beam("1", "0", "2", "c")};
  }
  ModelDescription d = two(slab("a", {1, 0, 2}, 4, 3), tower, ContactKind::slab_columns);
  d.sections = {elastic_section("c", {210e9, 81e9, 3e-3, 1e-5, 4e-6, 8e-8})};
  return d;
}

// W = H M^-1 H' of the one pair.
double mobility(const Model& model) {
  double sum = 0;
  for (int i = 0; i < model.dofs.size(); ++i) {
    const double h = model.contacts.jacobian.coeff(0, i);
    if (h != 0) sum += h * h / model.mass.coeff(i, i);
  }
  return sum;
}

}  // namespace

TEST_CASE("a slab meets a column at mid-height: at its node, or by the beam's shape functions") {
  const Model own_node = build(slab_and_column(true)), shapes = build(slab_and_column(false));
  REQUIRE(own_node.contacts.size() == 1);
  REQUIRE(shapes.contacts.size() == 1);
  CHECK(own_node.contacts.pairs[0].name == "a.s:2-3|b.1");
  CHECK(shapes.contacts.pairs[0].name == "a.s:2-3|b.1@z=2");
  CHECK(std::abs(own_node.contacts.initial_gap[0] - 0.02) < rounding);
  CHECK(std::abs(shapes.contacts.initial_gap[0] - 0.02) < rounding);
  // by hand: the middle of the slab's edge has the slab's 1000 kg, the node 150 kg
  CHECK(mobility(own_node) == doctest::Approx(1 / 1000.0 + 1 / 150.0).epsilon(1e-12));
  // the middle of a beam: half its end's displacement, and L/8 of its rotation
  CHECK(mobility(shapes) == doctest::Approx(1 / 1000.0 + 0.25 / 5000 + 0.25 / 200).epsilon(1e-12));
}

TEST_CASE("a slab that meets a column with a pinned head bends it as a propped cantilever, and does not turn the joint") {
  ModelDescription d = slab_and_column(false);
  d.structures[1].elements[0].releases.basic = {false, false, true, false, true, false};
  // by hand: (3 x^2 - x^3) / 2 of the head's displacement at half the height
  CHECK(mobility(build(d)) == doctest::Approx(1 / 1000.0 + 0.3125 * 0.3125 / 5000).epsilon(1e-12));
  d.structures[1].elements[0].releases.basic = {false, true, true, true, true, false};  // a strut: straight between its ends
  d.structures[1].supports[0] = fixed("0", {true, true, true, false, false, false});
  CHECK(mobility(build(d)) == doctest::Approx(1 / 1000.0 + 0.25 / 5000).epsilon(1e-12));
}

TEST_CASE("two masses in one impact: slab against the node of a column part as by momentum and restitution") {
  ModelDescription d = slab_and_column(true);
  d.structures[0].initial_velocities = {{{"5", {}}, 0, 1.0}};
  d.contacts[0].restitution = 0.6;
  const double h = 1e-5;
  const auto result = run(d, options(0.5, h, 0.03));
  REQUIRE(!result.observed.empty());
  // p = (1 + e) v m M / (m + M); the column's stiffness adds forces of the order of h w, w < 1e3 rad/s
  CHECK(result.observed[0].impulse == doctest::Approx(1.6 * 1000 * 150 / 1150.0).epsilon(0.01));
}

TEST_CASE("facing takes slabs at one level by their edges, and others against columns") {
  ModelDescription d = slab_and_column(true);
  d.contacts[0].kind = ContactKind::facing;
  CHECK(pair_names(build(d)) == std::vector<std::string>{"a.s:2-3|b.1"});
  d = two(slab("a", {0, 0, 3}, 4, 3), slab("b", {4.05, 0, 3.1}, 4, 3), ContactKind::facing);  // they overlap in height
  CHECK(pair_names(build(d)) == std::vector<std::string>{"a.s:2|b.s:1", "a.s:3|b.s:4"});
}

TEST_CASE("a wall is met by the facing corners of a slab, by its plane or by given gaps") {
  ModelDescription d;
  d.structures = {slab("a", {0, 0, 3}, 4, 3)};
  ContactDescription c;
  c.at = at(50);
  c.kind = ContactKind::wall;
  c.a = {"a", at(51)};
  c.wall = Vector3(2.07, 9, 9);
  d.contacts = {c};
  const Model plane = build(d);
  CHECK(pair_names(plane) == std::vector<std::string>{"a.s:2|wall", "a.s:3|wall"});
  CHECK((plane.contacts.initial_gap.array() - 0.07).abs().maxCoeff() < rounding);
  CHECK((plane.contacts.pairs[0].b.position - Vector3(2.07, -1.5, 3)).norm() < rounding);
  d.contacts[0].wall.reset();
  d.contacts[0].gap = {0.01, 0.02};
  CHECK(build(d).contacts.initial_gap == (VectorX(2) << 0.01, 0.02).finished());
  d.contacts[0].gap.clear();
  CHECK(error_of(d) == "s.toml:50:3: error: a wall needs its gap, or a point of its plane");
  d.contacts[0].wall = Vector3(7, 0, 0);
  CHECK(error_of(d) == "s.toml:50:3: error: no corner of a slab of 'a' faces the wall; the nearest are 5 m apart, beyond the reach of 1 m");
}

TEST_CASE("restitution may differ by pair, listed as gaps are") {
  ModelDescription d = two(slab("a", {0, 0, 3}, 4, 3), slab("b", {4.05, 0, 3}, 4, 3), ContactKind::slab_corners);
  d.contacts[0].restitutions = {0.2, 0.7};
  CHECK(build(d).contacts.restitution == (VectorX(2) << 0.2, 0.7).finished());
  d.contacts[0].restitutions = {0.2, 0.7, 0.1};
  CHECK(error_of(d) == "s.toml:50:3: error: 3 restitutions for 2 pairs on 1 floor: give one, or 2");
}

TEST_CASE("a name of a contact stands before the names of its pairs") {
  ModelDescription d = two(slab("a", {0, 0, 3}, 4, 3), slab("b", {4.05, 0, 3}, 4, 3), ContactKind::slab_corners);
  d.contacts[0].name = "joint";
  CHECK(pair_names(build(d)) == std::vector<std::string>{"joint:a.2|b.1", "joint:a.3|b.4"});
}

TEST_CASE("errors of contact geometry: gaps against coordinates, reach, nothing at the level, itself") {
  ModelDescription d = two(slab("a", {0, 0, 3}, 4, 3), slab("b", {4.05, 0, 3}, 4, 3), ContactKind::slab_edges);
  d.contacts[0].gap = {5};
  CHECK(errors_of(d).front() == "s.toml:50:3: error: contact 'a.s:2|b.s:1': a gap of 5 m is given, but the coordinates are 0.05 m apart; they "
                                "may differ by gap_tolerance = 0.5 m");
  d.contacts[0].gap_tolerance = 5;
  CHECK(error_of(d) == "no error");
  d = two(slab("a", {0, 0, 3}, 4, 3), slab("b", {7, 0, 3}, 4, 3), ContactKind::slab_edges);
  CHECK(error_of(d) == "s.toml:50:3: error: no corner of a slab of 'a' or 'b' faces an edge of the other along the direction; the nearest are "
                       "3 m apart, beyond the reach of 1 m");
  d.contacts[0].reach = 4;
  CHECK(error_of(d) == "no error");
  d = two(slab("a", {0, 0, 3}, 4, 3), slab("b", {4.05, 0, 5}, 4, 3), ContactKind::slab_columns);
  CHECK(error_of(d) == "s.toml:50:3: error: no slab of 'a' or 'b' faces a column of the other between its floors");
  d.contacts[0].b->name = "a";
  CHECK(error_of(d) == "s.toml:52:3: error: structure 'a' cannot pound against itself");
}
