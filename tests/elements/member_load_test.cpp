// Loads between the ends of members: textbook beams, and the members' ways to carry them against each other.
#include <doctest/doctest.h>

#include "elements/displacement_beam.hpp"
#include "elements/elastic_beam.hpp"
#include "elements/force_beam.hpp"

using namespace nsframe;

namespace {

constexpr double L = 4, E = 30e9, G = 12e9;
const ElasticSection section{E, G, 0.12, 1.6e-3, 9e-4, 1.9e-3};

BeamFrame level_frame() {  // local y upwards, local z against global y
  const Vector3 end(L, 0, 0);
  return {Vector3::Zero(), end, beam_axes(Vector3::Zero(), end, {})};
}

// The same constants by four elastic fibers.
FiberMember fiber_member(const MemberLoad& load, const Releases& releases = {}, int points = 4) {
  const double y = std::sqrt(section.Iz / section.A), z = std::sqrt(section.Iy / section.A), A = section.A / 4;
  const Elastic law{E};
  const std::vector<Fiber> fibers{{y, z, A, law}, {-y, z, A, law}, {y, -z, A, law}, {-y, -z, A, law}};
  const auto built = std::make_shared<const FiberSection>(fibers, G * section.J);
  return {level_frame(), gauss_lobatto(points), std::vector(static_cast<std::size_t>(points), built), {}, load,
          releases};
}

struct Answer {
  Vector12 force;  // of the nodes on the ends, local axes
  std::vector<SectionResult> sections;
};

Answer answer(const ElementGroup& group, const Vector12& displacement = Vector12::Zero()) {
  VectorX committed = VectorX::Zero(std::max(1, group.history_begin(1))), trial = committed;
  group.initialize_history(0, committed.data());
  if (double* const factor = group.load_factor(0, committed.data())) *factor = 1;
  Answer out;
  trial = committed;
  group.start_step(0, committed.data(), trial.data());
  group.respond(0, displacement, committed.data(), trial.data(), out.force, nullptr);
  for (int block = 0; block < 12; block += 3)
    out.force.segment<3>(block) = (group.shape(0).axes * out.force.segment<3>(block)).eval();
  out.sections = group.sections(0, displacement, trial.data());
  return out;
}

template <class Group, class Member>
Answer answer_of(const Member& member, const Vector12& displacement = Vector12::Zero()) {
  Group group(Geometry::linear);
  group.add({0, 1}, "e", member);
  return answer(group, displacement);
}

// Of the three kinds, clamped at both ends.
std::vector<Answer> clamped(const MemberLoad& load) {
  return {answer_of<ElasticBeams>(ElasticMember{level_frame(), section, {}, load, {}}),
          answer_of<DisplacementBeams>(fiber_member(load)), answer_of<ForceBeams>(fiber_member(load))};
}

const SectionResult& middle(const Answer& answer) { return answer.sections[answer.sections.size() / 2]; }

}  // namespace

TEST_CASE("a clamped beam under w has end moments wL^2/12 and shears wL/2, in every kind of member and both planes") {
  const double w = 5e3;
  for (const Answer& a : clamped({Vector3(0, -w, 0), {}})) {
    CHECK(a.force[1] == doctest::Approx(w * L / 2).epsilon(1e-12));
    CHECK(a.force[7] == doctest::Approx(w * L / 2).epsilon(1e-12));
    CHECK(a.force[5] == doctest::Approx(w * L * L / 12).epsilon(1e-12));
    CHECK(a.force[11] == doctest::Approx(-w * L * L / 12).epsilon(1e-12));
  }
  for (const Answer& a : clamped({Vector3(0, 0, -w), {}})) {
    CHECK(a.force[2] == doctest::Approx(w * L / 2).epsilon(1e-12));
    CHECK(a.force[4] == doctest::Approx(-w * L * L / 12).epsilon(1e-12));
    CHECK(a.force[10] == doctest::Approx(w * L * L / 12).epsilon(1e-12));
  }
}

TEST_CASE("midspan of a clamped beam has the moment wL^2/24: elastic, and force-based by equilibrium") {
  const double w = 5e3;
  const MemberLoad load{Vector3(0, -w, 0), {}};
  const Answer elastic = answer_of<ElasticBeams>(ElasticMember{level_frame(), section, {}, load, {}});
  const Answer force = answer_of<ForceBeams>(fiber_member(load, {}, 5));  // with a point in the middle
  for (const Answer& a : {elastic, force}) {
    CHECK(middle(a).position == doctest::Approx(0.5));
    CHECK(middle(a).force[1] == doctest::Approx(w * L * L / 24).epsilon(1e-11));
    CHECK(a.sections.front().force[1] == doctest::Approx(-w * L * L / 12).epsilon(1e-11));
  }
}

TEST_CASE("a clamped beam under P at a has end moments P a b^2/L^2 and P a^2 b/L^2") {
  const double P = 8e3, a = 0.3 * L, b = L - a;
  const MemberLoad load{Vector3::Zero(), {{0.3, Vector3(0, -P, 0)}}};
  for (const Answer& found : {answer_of<ElasticBeams>(ElasticMember{level_frame(), section, {}, load, {}}),
                              answer_of<DisplacementBeams>(fiber_member(load))}) {
    CHECK(found.force[5] == doctest::Approx(P * a * b * b / (L * L)).epsilon(1e-12));
    CHECK(found.force[11] == doctest::Approx(-P * a * a * b / (L * L)).epsilon(1e-12));
    CHECK(found.force[1] == doctest::Approx(P * b * b * (3 * a + b) / (L * L * L)).epsilon(1e-12));
  }
  // the kink of the moment isn't a polynomial: Gauss points see it to about 1/points^2
  const Answer force = answer_of<ForceBeams>(fiber_member(load, {}, 10));
  CHECK(force.force[5] == doctest::Approx(P * a * b * b / (L * L)).epsilon(0.03));
  CHECK(force.force[1] + force.force[7] == doctest::Approx(P).epsilon(1e-12));
}

TEST_CASE("a beam loaded along its axis between clamped ends shares the load by distance") {
  const double w = 3e3, P = 7e3;
  for (const Answer& a : clamped({Vector3(w, 0, 0), {{0.25, Vector3(P, 0, 0)}}})) {
    CHECK(a.force[0] + a.force[6] == doctest::Approx(-w * L - P).epsilon(1e-12));
  }
  const Answer elastic = clamped({Vector3(w, 0, 0), {{0.25, Vector3(P, 0, 0)}}}).front();
  CHECK(elastic.force[0] == doctest::Approx(-w * L / 2 - 0.75 * P).epsilon(1e-12));
  CHECK(elastic.sections.front().force[0] == doctest::Approx(w * L / 2 + 0.75 * P).epsilon(1e-12));
  CHECK(elastic.sections.back().force[0] == doctest::Approx(-w * L / 2 - 0.25 * P).epsilon(1e-12));
}

TEST_CASE("a beam clamped at one end and hinged at the other has wL^2/8 at the clamp and none at the hinge") {
  const double w = 5e3;
  const MemberLoad load{Vector3(0, -w, 0), {}};
  Releases at_j;
  at_j.basic[2] = true;
  for (const Answer& a :
       {answer_of<ElasticBeams>(ElasticMember{level_frame(), section, {}, load, at_j}),
        answer_of<DisplacementBeams>(fiber_member(load, at_j)), answer_of<ForceBeams>(fiber_member(load, at_j))}) {
    CHECK(a.force[5] == doctest::Approx(w * L * L / 8).epsilon(1e-11));
    CHECK(std::abs(a.force[11]) < 1e-11 * w * L * L);
    CHECK(a.force[1] == doctest::Approx(5 * w * L / 8).epsilon(1e-11));
    CHECK(a.force[7] == doctest::Approx(3 * w * L / 8).epsilon(1e-11));
  }
}

TEST_CASE(
    "hinges at both ends leave the simply supported beam: no moments, and no force under rotations of the nodes") {
  const double w = 5e3;
  const MemberLoad load{Vector3(0, -w, 0), {}};
  const Releases both{{false, true, true, true, true, false}};
  Vector12 turned = Vector12::Zero();
  turned[5] = 0.01;
  turned[10] = -0.02;
  for (const Answer& a : {answer_of<ElasticBeams>(ElasticMember{level_frame(), section, {}, load, both}, turned),
                          answer_of<DisplacementBeams>(fiber_member(load, both), turned),
                          answer_of<ForceBeams>(fiber_member(load, both, 5), turned)}) {
    for (const int moment : {4, 5, 10, 11}) CHECK(std::abs(a.force[moment]) < 1e-11 * w * L * L);
    CHECK(a.force[1] == doctest::Approx(w * L / 2).epsilon(1e-11));
  }
  const Answer force = answer_of<ForceBeams>(fiber_member(load, both, 5));
  CHECK(middle(force).force[1] == doctest::Approx(w * L * L / 8).epsilon(1e-11));
}

TEST_CASE("released torsion and axial force carry nothing, the rest is as before") {
  Vector12 moved;
  moved << 1e-4, 2e-4, -1e-4, 1e-3, 2e-3, -1e-3, 3e-4, -2e-4, 1e-4, -2e-3, 1e-3, 2e-3;
  const Releases free{{true, false, false, false, false, true}};
  const Vector12 tied = answer_of<ElasticBeams>(ElasticMember{level_frame(), section, {}, {}, {}}, moved).force;
  for (const Answer& a : {answer_of<ElasticBeams>(ElasticMember{level_frame(), section, {}, {}, free}, moved),
                          answer_of<DisplacementBeams>(fiber_member({}, free), moved),
                          answer_of<ForceBeams>(fiber_member({}, free), moved)}) {
    for (int k = 0; k < 12; ++k) {
      const bool released = k % 6 == 0 || k % 6 == 3;
      CHECK(a.force[k] == doctest::Approx(released ? 0 : tied[k]).epsilon(1e-10).scale(1e-3));
    }
  }
}

TEST_CASE("the loads of a member on rigid arms are in equilibrium with the forces of its nodes") {
  const std::array<Vector3, 2> arms{Vector3(0.3, 0.1, -0.2), Vector3(-0.4, 0.2, 0.5)};
  const Vector3 start(1, 2, 3), end(4, 3, 5);
  const Matrix3 axes = beam_axes(start, end, {});
  const MemberLoad load{Vector3(100, -300, 200), {{0.3, Vector3(50, 400, -90)}}};
  ElasticBeams beams(Geometry::linear);
  beams.add({0, 1}, "e", {BeamFrame(start, end, axes, arms), section, {}, load, {}});
  Vector12 f;
  beams.respond(0, Vector12::Zero(), nullptr, nullptr, f, nullptr);
  const double length = (end - start).norm();
  const Vector3 uniform = axes.transpose() * load.uniform * length, force = axes.transpose() * load.points[0].force;
  const Vector3 i = start - arms[0], j = end - arms[1];  // nodes
  const Vector3 moment = f.segment<3>(3) + f.segment<3>(9) + i.cross(f.segment<3>(0).eval()) + j.cross(f.segment<3>(6).eval()) +
                         Vector3((start + end) / 2).cross(uniform) + Vector3(start + 0.3 * (end - start)).cross(force);
  CHECK((f.segment<3>(0) + f.segment<3>(6) + uniform + force).norm() < 1e-12 * f.norm());
  CHECK(moment.norm() < 1e-11 * f.norm());
}
