#include "models/story_frame.hpp"

#include <doctest/doctest.h>

#include <map>
#include <set>

#include "base/errors.hpp"

using namespace nsframe;

namespace {

// Structure 1 of the calibrated two-story pair, about the centre of its plan.
StoryFrame two_story() {
  StoryFrame frame;
  frame.name = "left";
  frame.stories = 2;
  frame.height = {2.5};
  frame.plan = {std::vector{3.2}, std::vector{2.2}};
  frame.origin = Vector3(-1.6, -1.1, 0);
  frame.columns.section = {{"HEA100", {}}};
  frame.columns.element = BeamKind::force_based;
  frame.beams.emplace().section = {{"beam", {}}};
  frame.slab = {SlabKind::links, {"slab", {}}, 0.12};
  frame.braces =
      FrameBraces{{BracePlane::x_low, BracePlane::x_high}, BarKind::truss, {"cable", {}}, {1.61229e-4, 2.44428e-4}, 0};
  frame.base = {BaseKind::spring, 2.23047e7};
  frame.mass.floor = {4600};
  frame.mass.centre_inertia = {588.573, 585.454};
  return frame;
}

using Pair = std::pair<std::string, std::string>;

std::set<Pair> connections(const StructureDescription& s, const std::string& section_or_material) {
  std::set<Pair> out;
  for (const ElementDescription& e : s.elements)
    if (e.section.name == section_or_material || e.material.name == section_or_material)
      out.emplace(e.node_i.name, e.node_j.name);
  return out;
}

const ElementDescription& element(const StructureDescription& s, const std::string& id) {
  for (const ElementDescription& e : s.elements)
    if (e.id == id) return e;
  throw std::out_of_range(id);
}

std::map<std::string, Vector3> positions(const StructureDescription& s) {
  std::map<std::string, Vector3> out;
  for (const NodeDescription& n : s.nodes) out.emplace(n.id, n.position);
  return out;
}

}  // namespace

TEST_CASE("a two-story frame has the paper's 14 nodes and 32 elements at their places") {
  const StructureDescription s = expand(two_story());
  REQUIRE(s.nodes.size() == 14);
  REQUIRE(s.elements.size() == 32);
  const auto position = positions(s);
  const double x[] = {-1.6, 1.6, 1.6, -1.6, 0}, y[] = {-1.1, -1.1, 1.1, 1.1, 0};  // [m]
  for (int floor = 0; floor <= 2; ++floor)
    for (int i = 0; i < (floor ? 5 : 4); ++i) {
      const Vector3 expected(x[i], y[i], 2.5 * floor);
      CHECK((position.at(std::to_string(floor * 10 + i + 1)) - expected).norm() < 1e-15);  // a rounding of 3.2 - 1.6
    }
}

TEST_CASE("members of the two-story frame connect the nodes of the calibrated model") {
  const StructureDescription s = expand(two_story());
  CHECK(
      connections(s, "HEA100") ==
      std::set<Pair>{
          {"1", "11"}, {"2", "12"}, {"3", "13"}, {"4", "14"}, {"11", "21"}, {"12", "22"}, {"13", "23"}, {"14", "24"}});
  CHECK(connections(s, "beam") == std::set<Pair>{{"11", "12"},
                                                 {"14", "13"},
                                                 {"12", "13"},
                                                 {"11", "14"},
                                                 {"21", "22"},
                                                 {"24", "23"},
                                                 {"22", "23"},
                                                 {"21", "24"}});
  CHECK(connections(s, "slab") == std::set<Pair>{{"15", "11"},
                                                 {"15", "12"},
                                                 {"15", "13"},
                                                 {"15", "14"},
                                                 {"25", "21"},
                                                 {"25", "22"},
                                                 {"25", "23"},
                                                 {"25", "24"}});
  CHECK(
      connections(s, "cable") ==
      std::set<Pair>{
          {"1", "14"}, {"4", "11"}, {"2", "13"}, {"3", "12"}, {"11", "24"}, {"14", "21"}, {"12", "23"}, {"13", "22"}});
  CHECK(element(s, "1").kind == ElementKind::force_beam);
  CHECK(element(s, "1").points == 5);
  CHECK_FALSE(element(s, "1").orientation);
  CHECK(element(s, "5").section.name == "beam");
  CHECK(element(s, "5").kind == ElementKind::elastic_beam);
  CHECK(element(s, "13").kind == ElementKind::truss);
  CHECK(element(s, "13").area == 1.61229e-4);
  CHECK(element(s, "17").node_i.name == "11");
  CHECK(element(s, "32").area == 2.44428e-4);
}

TEST_CASE("the mass of a floor is shared as in a uniform plate") {
  const StructureDescription s = expand(two_story());
  REQUIRE(s.masses.size() == 10);
  Vector3 total = Vector3::Zero();
  for (const MassDescription& m : s.masses) {
    total += m.mass;
    const bool centre = m.node.name.back() == '5';
    CHECK(m.mass.x() == doctest::Approx(centre ? 2 * 4600 / 3.0 : 4600 / 12.0).epsilon(1e-15));
    CHECK(m.mass.y() == m.mass.x());
    CHECK(m.mass.z() == (centre ? 0 : 1150));
    CHECK(m.inertia.z() == (m.node.name == "15" ? 588.573 : m.node.name == "25" ? 585.454 : 0));
  }
  CHECK((total - Vector3::Constant(9200)).norm() < 1e-11);  // some roundings of 9200
}

TEST_CASE("spring bases hold the rotations about x and y, and fix the rest") {
  const StructureDescription s = expand(two_story());
  REQUIRE(s.supports.size() == 4);
  REQUIRE(s.springs.size() == 4);
  for (const SupportDescription& support : s.supports)
    CHECK(support.fixed == std::array{true, true, true, false, false, true});
  for (const SpringDescription& spring : s.springs) {
    CHECK_FALSE(spring.node_j);
    CHECK(spring.stiffness == (Vector6() << 0, 0, 0, 2.23047e7, 2.23047e7, 0).finished());
  }
  StoryFrame frame = two_story();
  frame.base.kind = BaseKind::pinned;
  CHECK(expand(frame).supports[0].fixed == std::array{true, true, true, false, false, false});
  frame.base.kind = BaseKind::fixed;
  CHECK(expand(frame).supports[0].fixed == std::array{true, true, true, true, true, true});
  CHECK(expand(frame).springs.empty());
}

TEST_CASE("a floor has one slab with its outer corners, in order around it") {
  const StructureDescription s = expand(two_story());
  REQUIRE(s.slabs.size() == 2);
  CHECK(s.slabs[1].corners[0].name == "21");
  CHECK(s.slabs[1].corners[3].name == "24");
  CHECK(s.slabs[1].center->name == "25");
  CHECK_FALSE(s.slabs[1].rigid);
  CHECK(s.constraints.empty());
}

TEST_CASE("rigid slabs and diaphragms tie every column line to the centre") {
  StoryFrame frame = two_story();
  frame.bays = {2, 1};
  for (const SlabKind kind : {SlabKind::rigid, SlabKind::diaphragm}) {
    frame.slab.kind = kind;
    const StructureDescription s = expand(frame);
    REQUIRE(s.constraints.size() == 2);
    CHECK(s.constraints[0].kind == (kind == SlabKind::rigid ? ConstraintKind::rigid_body : ConstraintKind::diaphragm));
    CHECK(s.constraints[0].master.name == "15");
    CHECK(s.constraints[0].slaves.size() == 6);
    CHECK(s.slabs[0].rigid);
    CHECK(connections(s, "slab").empty());
  }
}

TEST_CASE("plans of several bays keep the names of corners and centre") {
  StoryFrame frame = two_story();
  frame.plan = {std::vector{3.0, 5.0}, std::vector{2.2}};
  frame.bays = {1, 2};
  frame.origin = Vector3::Zero();
  const StructureDescription s = expand(frame);
  const auto position = positions(s);
  CHECK(s.nodes.size() == 9 + 2 * 10);  // nine column lines, and a centre that is none of them
  CHECK(position.at("1") == Vector3(0, 0, 0));
  CHECK(position.at("103") == Vector3(8, 2.2, 2.5));  // ten nodes a floor: a stride of 100
  CHECK(position.at("105") == Vector3(4, 1.1, 2.5));
  CHECK(position.at("106") == Vector3(3, 0, 2.5));
  CHECK(position.count("5") == 0);
  CHECK(connections(s, "HEA100").size() == 18);
  CHECK(connections(s, "beam").size() == 2 * (2 * 3 + 3 * 2));
  CHECK(connections(s, "slab").size() == 2 * 9);
  CHECK(connections(s, "cable").size() == 2 * 2 * 2 * 2);
  double vertical = 0;
  for (const MassDescription& m : s.masses) vertical += m.mass.z();
  CHECK(vertical == doctest::Approx(9200).epsilon(1e-14));
}

TEST_CASE("a column line through the centre is the slab's centre") {
  StoryFrame frame = two_story();
  frame.bays = {2, 2};
  const StructureDescription s = expand(frame);
  CHECK(s.nodes.size() == 9 * 3);
  CHECK(positions(s).at("5") == Vector3(0, 0, 0));
  CHECK(connections(s, "slab").size() == 2 * 8);
  CHECK(connections(s, "HEA100").count({"5", "15"}) == 1);
}

TEST_CASE("columns may have their depth along y, and other sections in each story") {
  StoryFrame frame = two_story();
  frame.columns.depth = PlanAxis::y;
  frame.columns.section = {{"low", {}}, {"high", {}}};
  frame.height = {3, 2};
  const StructureDescription s = expand(frame);
  CHECK(*element(s, "1").orientation == -Vector3::UnitX());
  CHECK(element(s, "1").section.name == "low");
  CHECK(element(s, "17").section.name == "high");
  CHECK(positions(s).at("21").z() == 5);
  CHECK(positions(s).at("11").z() == 3);
}

TEST_CASE("a frame whose lists don't fit its stories is refused") {
  StoryFrame frame = two_story();
  frame.height = {1, 2, 3};
  CHECK_THROWS_WITH_AS(expand(frame), "left: height has 3 values, must have one, or one for each of the 2 stories",
                       InputError);
}

TEST_CASE("beams of a frame carry their line load downwards, story by story; end sections, integration and mass reach the members") {
  StoryFrame frame = two_story();
  frame.beams->load = {5e3, 0};
  frame.beams->mass = {0, 7850, true, false};
  frame.columns.element = BeamKind::force_based;
  frame.columns.end_section = {{"weak", {}}};
  frame.columns.integration = {"hinge-radau", 0.2, 0.2, {}, {}};
  const StructureDescription s = expand(frame);
  std::size_t loaded = 0;
  for (const ElementDescription& e : s.elements) {
    if (e.section.name != "beam") continue;
    CHECK(e.mass == frame.beams->mass);
    for (const LoadDescription& load : s.loads) {
      if (load.elements.front().name != e.id) continue;
      ++loaded;
      CHECK_FALSE(load.local);
      CHECK(load.uniform == Vector3(0, 0, -5e3));
    }
  }
  CHECK(loaded == s.loads.size());
  CHECK(loaded == 4);  // one bay: four beams of the first story
  const ElementDescription& column = element(s, "1");
  REQUIRE(column.sections.size() == 3);
  CHECK(column.sections[0].name == "weak");
  CHECK(column.sections[1].name == column.section.name);
  CHECK(column.integration == frame.columns.integration);
  frame.beams->load = {1, 2, 3};
  CHECK(faults(frame).front() == "beams.load has 3 values, must have one, or one for each of the 2 stories");
}

TEST_CASE("releases and rigid zones reach the members of a frame, along each member") {
  StoryFrame frame = two_story();
  frame.columns.rigid_ends = {0.1, 0.3};
  frame.beams->rigid_ends = {0.2, 0.15};
  frame.beams->releases.emplace().j.dofs[5] = true;
  const StructureDescription s = expand(frame);
  const auto position = positions(s);
  for (const ElementDescription& e : s.elements) {
    const bool beam = e.section.name == "beam", column = e.section.name == "HEA100";
    const Vector3 along = (position.at(e.node_j.name) - position.at(e.node_i.name)).normalized();
    const double at_i = beam ? 0.2 : column ? 0.1 : 0, at_j = beam ? 0.15 : column ? 0.3 : 0;
    CHECK((e.offset[0] - at_i * along).norm() < 1e-15);
    CHECK((e.offset[1] + at_j * along).norm() < 1e-15);
    CHECK(e.releases.basic == std::array<bool, 6>{false, false, beam, false, false, false});
  }
  frame.beams->rigid_ends = {1.2, 1.0};  // of 2.2 m
  CHECK(faults(frame) == std::vector<std::string>{"beams.rigid_ends leave nothing of a member of 2.2 m"});
  frame.beams->rigid_ends = {0, 0};
  frame.columns.rigid_ends = {2, 0.5};
  CHECK(faults(frame) == std::vector<std::string>{"columns.rigid_ends leave nothing of a member of 2.5 m"});
}

TEST_CASE("columns are split at given levels, each part with its share of the ends") {
  StoryFrame frame = two_story();
  frame.columns.split = {4.0, 1.2, 0.7};
  frame.columns.rigid_ends = {0.1, 0.2};
  frame.columns.end_section = {{"stiff", {}}};
  frame.columns.releases = EndReleases{};
  frame.columns.releases->j.dofs[5] = true;
  const StructureDescription s = expand(frame);
  CHECK(s.nodes.size() == 14 + 12);
  const auto at = positions(s);
  CHECK((at.at("2a") - (at.at("2") + Vector3(0, 0, 0.7))).norm() < 1e-15);
  CHECK((at.at("2b") - (at.at("2") + Vector3(0, 0, 1.2))).norm() < 1e-15);
  CHECK((at.at("12a") - (at.at("12") + Vector3(0, 0, 1.5))).norm() < 1e-14);
  const ElementDescription &lowest = element(s, "1"), &middle = element(s, "2"), &highest = element(s, "3");
  CHECK(lowest.node_i.name + lowest.node_j.name + middle.node_j.name + highest.node_j.name == "11a1b11");
  CHECK(lowest.sections[0].name + lowest.sections[2].name == "stiffHEA100");
  CHECK(middle.sections[0].name + middle.sections[2].name == "HEA100HEA100");
  CHECK(highest.sections[0].name + highest.sections[2].name == "HEA100stiff");
  CHECK(lowest.offset[0] == Vector3(0, 0, 0.1));
  CHECK(lowest.offset[1].norm() + middle.offset[0].norm() + middle.offset[1].norm() + highest.offset[0].norm() == 0);
  CHECK((highest.offset[1] + Vector3(0, 0, 0.2)).norm() < 1e-15);
  CHECK_FALSE(lowest.releases.any());
  CHECK_FALSE(middle.releases.any());
  CHECK(highest.releases.any());
}

TEST_CASE("columns are not split outside the frame, at floors, twice or where hinges would come between") {
  StoryFrame frame = two_story();
  const auto fault = [&](std::vector<double> split) {
    frame.columns.split = std::move(split);
    const auto found = faults(frame);
    return found.empty() ? std::string("none") : found.front();
  };
  CHECK(fault({1.0}) == "none");
  CHECK(fault({5.5}) == "columns.split = 5.5 m lies outside the frame of 5 m");
  CHECK(fault({2.5}) == "columns.split = 2.5 m is at a floor or within a rigid end, or given twice");
  CHECK(fault({1.0, 1.0}) == "columns.split = 1 m is at a floor or within a rigid end, or given twice");
  frame.columns.rigid_ends = {0.3, 0};
  CHECK(fault({2.7}) == "columns.split = 2.7 m is at a floor or within a rigid end, or given twice");
  frame.columns.integration.rule = "hinge-radau";
  CHECK(fault({1.0}) == "columns.split would put plastic hinges within the columns; use another integration");
}
