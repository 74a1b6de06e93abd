#include <doctest/doctest.h>

#include "output/warnings.hpp"

using namespace nsframe;

namespace {

// Two nodes with a gap of 20 mm and e = 0.6, corners of flexible slabs unless said otherwise.
struct Run {
  Model model;
  Summary summary;

  Run() {
    model.contacts.pairs.resize(1);
    ContactPair& pair = model.contacts.pairs[0];
    pair.name = "left.1|right.1";
    pair.a = node_point(0, Vector3::Zero(), false);
    pair.b = node_point(1, Vector3::Zero(), false);
    pair.rigid_bodies = true;
    model.contacts.initial_gap = VectorX::Constant(1, 0.02);
    model.contacts.restitution = VectorX::Constant(1, 0.6);
    model.nodal_mass = VectorX::Constant(6 * 10, 1.0);
    summary.scheme = "moreau-jean";
    summary.dt = 1e-3;
    summary.theta = 0.5;
    summary.steps = 1000;
    summary.pairs = {"left.1|right.1"};
    summary.poundings = {pounding(0.6)};
  }
  static Pounding pounding(double restitution) { return {1.25, 0, 0, 0.4, 100, restitution, 2}; }
  std::vector<std::string> warnings() const { return run_warnings(model, summary); }
  void shake(double sample, double frequency) {
    GroundMotion motion;
    motion.dt = sample;
    model.motions = {motion};
    summary.modes = {{"left", "L2", frequency, 0.02, 0.02, frequency, 0.2, {0.2, 0, 0}}};
  }
};

}  // namespace

TEST_CASE("a run of rigid bodies that part with e of the scene gives no warning") { CHECK(Run().warnings().empty()); }

TEST_CASE("a pounding that does not part with e of the scene is named") {
  Run run;
  run.summary.poundings.push_back(Run::pounding(0.2));
  run.summary.poundings.push_back(Run::pounding(0.56));
  REQUIRE(run.warnings().size() == 1);
  CHECK(run.warnings()[0] ==
        "1 of 3 poundings did not part with the restitution of the scene: at t = 1.25 s, left.1|right.1 parted with 0.20 in place "
        "of 0.60, over 2 impacts");
  run.summary.poundings[1].approach_velocity = 0;  // began in resting contact: there is no restitution to compare
  CHECK(run.warnings().empty());
}

TEST_CASE("restitution at a light corner of a flexible slab is told with the corner's share of the mass") {
  Run run;
  run.model.contacts.pairs[0].rigid_bodies = false;
  Slab slab;
  slab.corners = {0, 2, 3, 4};
  slab.center = 5;
  run.model.nodal_mass[6 * 5] = 4;  // half of the slab: a corner has an eighth
  run.model.slabs = {slab};
  REQUIRE(run.warnings().size() == 1);
  CHECK(run.warnings()[0] ==
        "the restitution acts on points of flexible slabs or of columns, each with its share of the mass (down to 12 % of a slab): that of "
        "the poundings came out as 0.60; rigid slabs against each other would have that of the scene");
  run.summary.poundings.clear();
  CHECK(run.warnings().empty());
}

TEST_CASE("a penetration of more than a twentieth of the smallest gap is told") {
  Run run;
  run.summary.max_penetration = 0.9e-3;
  CHECK(run.warnings().empty());
  run.summary.max_penetration = 2e-3;
  REQUIRE(run.warnings().size() == 1);
  CHECK(run.warnings()[0] == "the largest penetration, 2 mm, is 10 % of the smallest gap, 20 mm: a smaller dt lessens it");
}

TEST_CASE("a ground motion too coarse for a mode is told with what is left of it") {
  Run run;
  run.shake(0.02, 8);  // sinc(0.16)^2 = 0.919
  CHECK(run.warnings().empty());
  run.shake(0.02, 12.5);
  run.model.motions[0].direction = Vector3::UnitZ();  // does not shake the mode
  CHECK(run.warnings().empty());
  run.shake(0.02, 12.5);  // sinc(1/4)^2 = 8/pi^2 = 0.811
  REQUIRE(run.warnings().size() == 1);
  CHECK(run.warnings()[0] ==
        "the ground motion has a sample each 20 ms: straight lines between them keep only 81 % of what shakes mode L2 of 'left' "
        "(12.5 Hz)");
}

TEST_CASE("a step longer than that of the ground motion is told") {
  Run run;
  run.shake(0.02, 1);
  run.summary.dt = 0.02;
  CHECK(run.warnings().empty());
  run.summary.dt = 0.025;
  REQUIRE(run.warnings().size() == 1);
  CHECK(run.warnings()[0] == "dt = 25 ms steps over samples of the ground motion, which are 20 ms apart");
}

TEST_CASE("a ringing of struck points that steps do not follow is told where there are impacts") {
  Run run;
  run.summary.struck_frequency = 400;
  run.summary.dt = 1e-3;
  CHECK(run.warnings().empty());
  run.summary.impacts.push_back({1, 0, 0.4, 100, -0.4, 0.24});
  REQUIRE(run.warnings().size() == 1);
  CHECK(run.warnings()[0].find("struck points ring at up to 400 Hz, which steps of 1 ms do not follow") == 0);
  run.summary.dt = 1e-4;
  CHECK(run.warnings().empty());
}

TEST_CASE("steps of alpha-OS that stiffening made implicit are told") {
  Run run;
  run.summary.steps = 100;
  run.summary.stiffened_steps = 24;
  REQUIRE(run.warnings().size() == 1);
  CHECK(run.warnings()[0].find("members stiffened beyond their stiffness at rest: alpha-OS would be unstable, and 24 of 100 steps") == 0);
}

TEST_CASE("modes that are left out are told where they hold much of the mass") {
  Run run;
  run.summary.left_out_modes = 20;
  run.summary.kept_mass = 0.95;
  CHECK(run.warnings().empty());
  run.summary.kept_mass = 0.84;
  REQUIRE(run.warnings().size() == 1);
  CHECK(run.warnings()[0] == "modes up to highest_frequency hold only 84 % of the mass that the motion shakes: forces and drifts may come out too low");
}

TEST_CASE("force-based members whose sections softened are told") {
  Run run;
  run.summary.softened_members = {"left.c1"};
  REQUIRE(run.warnings().size() == 1);
  CHECK(run.warnings()[0].find("in 1 force-based member (left.c1) a section softened") == 0);
  run.summary.softened_members.push_back("left.c2");
  CHECK(run.warnings()[0].find("in 2 force-based members (left.c1, ...)") == 0);
}

TEST_CASE("halved steps are told when they are not rare") {
  Run run;
  run.summary.halved_steps = 9;
  CHECK(run.warnings().empty());
  run.summary.halved_steps = 10;
  REQUIRE(run.warnings().size() == 1);
  CHECK(run.warnings()[0] ==
        "steps did not converge and were halved 10 times in 1000 steps: a smaller dt would be more accurate and not slower");
}

TEST_CASE("energy that restitution creates is told with the law that creates none") {
  Run run;
  run.summary.energy.initial = 100;
  run.summary.created = {0.009, 0.009, 2};
  CHECK(run.warnings().empty());
  run.summary.created = {1.5, 1.2, 2.25};
  REQUIRE(run.warnings().size() == 1);
  CHECK(run.warnings()[0] ==
        "Newton's law of restitution created 1.5 J where several pairs collided at once, 1.2 J of it at t = 2.25 s: impact_law = "
        "\"poisson\" creates none");
}

TEST_CASE("contacts of penalty laws that steps do not resolve are told, and deep ones ask for a stiffer law") {
  Run run;
  run.model.contacts.pairs[0].law.name = "hertz";
  for (const double duration : {0.012, 0.004, 0.0025}) run.summary.impacts.push_back({1, 0, 0.4, 100, -0.4, 0.24, duration});
  REQUIRE(run.warnings().size() == 1);
  CHECK(run.warnings()[0] ==
        "2 of 3 contacts with penalty laws lasted less than 10 steps, the shortest 2.5 (left.1|right.1, hertz): steps, and not the law, rule how "
        "they part; take a smaller dt, or a softer law");
  run.summary.dt = 1e-4;
  CHECK(run.warnings().empty());
  run.summary.max_penetration = 0.005;
  REQUIRE(run.warnings().size() == 1);
  CHECK(run.warnings()[0].find("a stiffer law of contact lessens it") != std::string::npos);
  run.model.contacts.pairs[0].law.name = "newton";
  run.summary.dt = 1e-3;
  REQUIRE(run.warnings().size() == 1);
  CHECK(run.warnings()[0].find("a smaller dt lessens it") != std::string::npos);
}
