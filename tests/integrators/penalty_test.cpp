// Contact laws of force in the theta scheme: the local problem, order, energy, what a contact is told as, against an integration
// that knows nothing of the program, with the laws written down again from Table 1 of Langlade et al. (2021).
#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <random>

#include "base/errors.hpp"
#include "integrators/force_problem.hpp"
#include "integrators/scheme_choice.hpp"
#include "tests/integrators/penalty_models.hpp"
#include "tests/support/numbers.hpp"
#include "tests/support/reference_data.hpp"
#include "tests/verification/closed_forms.hpp"

using namespace nsframe;
using namespace nsframe::test;

namespace {

std::string refusal(const ModelDescription& d, const std::string& scheme) {
  AnalysisOptions o = options(0.5, 1e-3, 0.1);
  o.scheme = scheme;
  try {
    run(d, o);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

}  // namespace

TEST_CASE("the local problem of contact forces is solved to rounding, coupled pairs, stiff ones and large mass ratios included") {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> unit(0, 1);
  for (int trial = 0; trial < 300; ++trial) {
    const int n = 1 + trial % 4;
    MatrixX half(n, n + 1);
    for (Eigen::Index i = 0; i < half.size(); ++i) half.data()[i] = (unit(random) - 0.5) * std::pow(10, -3 * unit(random));
    ForceProblem problem;
    problem.delassus = half * half.transpose() + 1e-9 * MatrixX::Identity(n, n);
    problem.free.resize(n);
    for (int a = 0; a < n; ++a) {
      const TableLaw& law = table()[static_cast<std::size_t>(1 + (trial + a) % 5)];  // those that never pull: one solution
      ForcePair pair;
      pair.law = contact_force_law(law.name);
      pair.stiffness = law.stiffness * std::pow(10, 6 * unit(random) - 3);
      pair.damping = damping_constant(*pair.law, pair.stiffness, 1 / problem.delassus(a, a), 0.6, {});
      pair.rate = unit(random) - 0.7;
      pair.gap = 2e-3 * (unit(random) - 0.5);
      pair.approach = std::max(0.0, -pair.rate);
      pair.h = 1e-3;
      pair.theta = trial % 2 == 0 ? 0.5 : 1;
      problem.pairs.push_back(pair);
      problem.free[a] = pair.rate + 0.1 * (unit(random) - 0.5);
    }
    const ForceSolution found = solve_forces(problem, {}, VectorX::Zero(n));
    CAPTURE(trial);
    REQUIRE(found.converged);
    const VectorX w = problem.free + problem.delassus * found.impulse;
    const double size = (problem.delassus.cwiseAbs() * found.impulse.cwiseAbs()).maxCoeff() + problem.free.cwiseAbs().maxCoeff();
    for (int a = 0; a < n; ++a) {
      const ForcePair& pair = problem.pairs[static_cast<std::size_t>(a)];
      CHECK(found.impulse[a] >= 0);
      // p lies between the law's values at rates that rounding (and the tolerance 1e-12) cannot tell from w
      const double off = 1e-11 * size;
      const double most = pair.impulse(std::min(w[a], pair.parting_rate() - 1e-15) - off), least = pair.impulse(w[a] + off);
      CHECK(found.impulse[a] <= most * (1 + 1e-9) + off / problem.delassus(a, a));
      CHECK(found.impulse[a] >= least * (1 - 1e-9) - off / problem.delassus(a, a));
    }
    // Newton's method and sweeps alone come to the same
    ForceProblem again = problem;
    const ForceSolution other = solve_forces(again, {}, 10 * found.impulse + VectorX::Ones(n));
    REQUIRE(other.converged);
    CHECK((problem.delassus * (other.impulse - found.impulse)).cwiseAbs().maxCoeff() < 1e-10 * size);
  }
}

TEST_CASE("with each law of Table 1 the ball and the pull-back follow an independent integration, ever closer as the step shrinks") {
  for (const TableLaw& law : table()) {
    CAPTURE(law.name);
    const PenaltyMotion exact = integrate(pull_back_pair(law), 1e-3, 1);
    REQUIRE(exact.contacts.size() >= 2);
    double before = 0;
    for (const int parts : {1, 4, 16}) {
      const double error = largest_difference(run(pull_back(choice(law)), options(0.5, 1e-3 / parts, 1)), exact, 2, parts);
      MESSAGE(std::string(law.name), ", pull-back, dt = 1 ms / ", parts, ": ", error, " m");
      // where the force begins with a jump, the error is first order by where in a step the contact begins
      const bool jumps = contact_force_law(law.name)->stiffness == ContactStiffness::linear;
      if (parts > 1 && !jumps) CHECK(error < before / 3);
      CHECK(error < (jumps ? 1.5e-4 : 1.2e-4) / parts);
      before = error;
    }
    PenaltyPair drop;
    drop.mass[1] = std::numeric_limits<double>::infinity();
    drop.load = {2, 0};
    drop.open = 1;
    const double k = 2e-3 * law.stiffness;
    drop.force = [&](double d, double rate, double v) { return law.force(k, 1, d, rate, v); };
    TableLaw soft = law;
    soft.stiffness = k;
    const PenaltyMotion bounces = integrate(drop, 1e-3, 2.4);
    const Run run_of_ball = run(ball(choice(soft)), options(0.5, 2.5e-4, 2.4));
    const double error = largest_difference(run_of_ball, bounces, 1, 4);
    MESSAGE(std::string(law.name), ", ball, dt = 0.25 ms: ", error, " m");
    CHECK(error < (contact_force_law(law.name)->stiffness == ContactStiffness::linear ? 5e-3 : 1e-3));
    CHECK(run_of_ball.summary.max_penetration == doctest::Approx(bounces.penetration).epsilon(0.01));
  }
}

TEST_CASE("theta = 1/2 is second order through Hertzian contacts, of 1.5 at least through Jankowski's, and theta = 1 first order") {
  const auto order = [](const TableLaw& law, double theta) {
    const PenaltyMotion exact = integrate(pull_back_pair(law), 1e-3, 1);
    const double coarse = largest_difference(run(pull_back(choice(law)), options(theta, 2.5e-4, 1)), exact, 2, 4);
    const double fine = largest_difference(run(pull_back(choice(law)), options(theta, 3.125e-5, 1)), exact, 2, 32);
    return std::log(coarse / fine) / std::log(8.0);
  };
  for (int law = 2; law < 6; ++law) {
    CAPTURE(law);
    CHECK(order(table()[static_cast<std::size_t>(law)], 0.5) > (law < 4 ? 1.9 : 1.4));  // delta^1/4 has no slope at 0
  }
  CHECK(order(table()[2], 1) == doctest::Approx(1).epsilon(0.15));
  CHECK(order(table()[0], 1) == doctest::Approx(1).epsilon(0.15));
}

TEST_CASE("a mass on a Kelvin-Voigt wall is a damped oscillator") {
  const double m = 3, k = 2000, xi = 0.2, v = 0.5, w = std::sqrt(k / m), wd = w * std::sqrt(1 - xi * xi), h = 1e-5;
  ModelDescription d = single_mass(m, 0, v);
  d.structures[0].may_move_freely = true;
  d.contacts = {wall("s.1", 0, 0.6)};
  d.contacts[0].law = {.name = "linear-viscoelastic", .stiffness = k, .damping_ratio = xi};
  const double ends = pi / wd;
  const Run result = run(d, options(0.5, h, ends + 0.01));
  double error = 0;
  for (const State& state : result.states) {
    const double t = std::min(state.time, ends), e = std::exp(-xi * w * t);
    const double parted = -v * std::exp(-xi * w * ends) * std::max(0.0, state.time - ends);
    error = std::max(error, std::abs(state.displacement[0] - v / wd * e * std::sin(wd * t) - parted));
  }
  CHECK(error < 2 * v * h);  // the end of the contact is met within a step
  REQUIRE(result.summary.impacts.size() == 1);
  const Impact& impact = result.summary.impacts[0];
  const double e = std::exp(-xi * pi / std::sqrt(1 - xi * xi));
  CHECK(impact.rate_after / impact.approach_velocity == doctest::Approx(e).epsilon(1e-3));
  CHECK(impact.duration == doctest::Approx(ends).epsilon(1e-3));
  CHECK(impact.time == doctest::Approx(ends).epsilon(1e-3));
  CHECK(impact.impulse == doctest::Approx(m * v * (1 + e)).epsilon(1e-3));
  CHECK(result.summary.energy.contact == doctest::Approx(0.5 * m * v * v * (1 - e * e)).epsilon(2e-3));
  CHECK(result.summary.max_penetration == doctest::Approx(v / w * std::exp(-xi / std::sqrt(1 - xi * xi) * std::acos(xi))).epsilon(1e-3));
}

TEST_CASE("two free masses lose (1 - e^2)/2 of their reduced mass times the squared approach velocity to a penalty law") {
  for (const TableLaw& law : table()) {
    CAPTURE(law.name);
    ModelDescription d = two_free_masses(0.6);
    d.contacts[0].law = choice(law);
    const Run result = run(d, options(0.5, 1e-6, 0.075));
    REQUIRE(result.summary.impacts.size() == 1);
    const Impact& impact = result.summary.impacts[0];
    const double e = collide_free_masses(1.2, 1.5, [&](double p, double rate) { return law.force(law.stiffness, 1.2, p, rate, 1.5); }).restitution;
    CHECK(impact.rate_after / impact.approach_velocity == doctest::Approx(e).epsilon(2e-3));
    CHECK(impact.approach_velocity == doctest::Approx(1.5));
    CHECK(impact.impulse == doctest::Approx((1 + e) * 1.2 * 1.5).epsilon(2e-3));
    CHECK(result.summary.energy.contact == doctest::Approx(0.5 * 1.2 * 1.5 * 1.5 * (1 - e * e)).epsilon(5e-3).scale(0.01));
    CHECK(result.summary.worst_balance_error < 1e6 * epsilon);
  }
}

TEST_CASE("the energy of penalty contacts balances to rounding whatever the law, the step and theta") {
  for (const TableLaw& law : table()) {
    for (const double theta : {0.5, 0.7, 1.0}) {
      for (const double stiffer : {1.0, 1e4}) {  // the second within less than a step
        CAPTURE(law.name);
        CAPTURE(theta);
        CAPTURE(stiffer);
        TableLaw stiff = law;
        stiff.stiffness *= stiffer;
        const Run result = run(pull_back(choice(stiff)), options(theta, 1e-3, 1));
        CHECK(result.summary.completed);
        CHECK(result.summary.impacts.size() >= 1);
        CHECK(result.summary.worst_balance_error < 1e5 * epsilon);
        CHECK(result.summary.halved_steps == 0);
        CHECK(result.summary.factorizations == 1);
      }
    }
  }
}

TEST_CASE("Newton's impacts and contact forces act in one scene: three masses in a row") {
  const TableLaw& law = table()[4];
  for (const double e : {0.0, 0.6}) {
    ModelDescription d = pull_back(choice(law));
    d.structures.push_back(linear_oscillator(2000, 3e6, 0.01).structures[0]);
    d.structures[2].name = "t";
    ContactDescription c = wall("r.1", 2e-4, e);
    c.b = Reference{"t.1", {}};
    d.contacts.push_back(c);
    const Run fine = run(d, options(0.5, 4e-6, 0.3)), coarse = run(d, options(0.5, 1e-4, 0.3)), middle = run(d, options(0.5, 2e-5, 0.3));
    REQUIRE_MESSAGE(fine.summary.completed, fine.summary.stop_reason);
    REQUIRE_MESSAGE(coarse.summary.completed, coarse.summary.stop_reason);
    const auto difference = [&](const Run& other, std::size_t every) {
      double most = 0;
      for (std::size_t i = 0; i < other.states.size(); ++i) {
        most = std::max(most, (other.states[i].displacement - fine.states[every * i].displacement).cwiseAbs().maxCoeff());
      }
      return most;
    };
    MESSAGE("mixed row, e = ", e, ": ", difference(coarse, 25), " m at 0.1 ms, ", difference(middle, 5), " at 0.02 ms");
    // of first order in the mean: an impact is late by any part of a step
    CHECK(difference(coarse, 25) < 5e-6);
    CHECK(difference(middle, 5) < 1e-6);
    CHECK(coarse.summary.worst_balance_error < 1e5 * epsilon);
    long both = 0;
    for (std::size_t i = 1; i < coarse.states.size(); ++i) {
      const State &before = coarse.states[i - 1], &after = coarse.states[i];
      const double p = after.impulse[0], q = after.impulse[1];
      both += p > 0 && q > 0;
      const auto rate = [](const State& s, int pair) { return s.velocity[pair + 1] - s.velocity[pair]; };
      CHECK(q >= 0);
      if (q > 0) CHECK(std::abs(rate(after, 1) + e * rate(before, 1)) < 1e-9);
      const double u = 0.5 * (rate(before, 0) + rate(after, 0)), penetration = -(0.02 + before.displacement[1] - before.displacement[0] + 5e-5 * u);
      // m* is that of the two masses of the pair
      const double force = penetration > 0 ? law.force(law.stiffness, 4600.0 * 3500 / 8100, penetration, -u, 1) : 0;
      CHECK(p == doctest::Approx(1e-4 * force).epsilon(1e-8).scale(1));
    }
    CHECK(both > (e == 0 ? 20 : 0));
  }
}

TEST_CASE("auto leaves penalty laws to Moreau-Jean and says why; the schemes that locate impacts refuse them") {
  const ModelDescription d = pull_back(choice(table()[0]));
  AnalysisOptions o = options(0.5, 1e-3, 0.1);
  o.scheme = "auto";
  const Summary summary = run(d, o).summary;
  CHECK(summary.scheme == "moreau-jean");
  CHECK(summary.scheme_reason == "not exact: contact pair 's.1|r.1' has the law of force 'linear-viscoelastic', which moreau-jean alone can take");
  for (const char* scheme : {"exact", "exponential"}) {
    CHECK(refusal(d, scheme).find("takes no penalty laws: contact pair 's.1|r.1' has the law of force 'linear-viscoelastic'; use scheme = "
                                  "\"moreau-jean\"") != std::string::npos);
  }
}

TEST_CASE("k_s as a multiple of the stiffer body's stiffness, and m* of the pair, are those of the masses and springs") {
  ContactLawChoice by_ratio{.name = "anagnostopoulos", .stiffness_ratio = 0.5}, by_value{.name = "linear-viscoelastic", .stiffness = 0.5 * 5.31e6};
  by_value.effective_mass = 4600.0 * 3500 / 8100;
  const Run a = run(pull_back(by_ratio), options(0.5, 1e-3, 0.3)), b = run(pull_back(by_value), options(0.5, 1e-3, 0.3));
  CHECK((a.states.back().displacement - b.states.back().displacement).cwiseAbs().maxCoeff() < 1e-12);
  CHECK(refusal(ball({.name = "anagnostopoulos", .stiffness_ratio = 2}), "moreau-jean").find("may move freely or are fixed; give stiffness") !=
        std::string::npos);
  // a massless node in contact has no m* of its own
  ModelDescription light = pull_back({.name = "linear-viscoelastic", .stiffness = 1e6});
  light.structures[1].masses.clear();
  CHECK(refusal(light, "moreau-jean").find("its damping needs effective_mass") != std::string::npos);
  light.contacts[0].law.effective_mass = 2000;
  CHECK(refusal(light, "moreau-jean").empty());
}

TEST_CASE("a contact that the run's end cuts off is told, and a run that goes on from a snapshot within it has the same bits") {
  const ModelDescription d = pull_back(choice(table()[3]));
  const AnalysisOptions o = options(0.5, 1e-3, 0.135), longer = options(0.5, 1e-3, 0.25);
  const Model model = build(d);
  Snapshot kept;
  RunControl control;
  control.keep_snapshot = [&kept](const Snapshot& snapshot) { kept = snapshot; };
  Simulation first(model, o);
  const Summary cut = first.run({}, control);
  REQUIRE(cut.impacts.size() == 1);
  CHECK(cut.impacts[0].time == doctest::Approx(0.135));
  CHECK(cut.impacts[0].duration > 5e-3);
  RunControl go_on;
  go_on.resume = &kept;
  Simulation second(model, longer), whole(model, longer);
  const Summary resumed = second.run({}, go_on), straight = whole.run({});
  REQUIRE(resumed.impacts.size() == straight.impacts.size());
  for (std::size_t i = 0; i < straight.impacts.size(); ++i) {
    CHECK(resumed.impacts[i].impulse == straight.impacts[i].impulse);
    CHECK(resumed.impacts[i].duration == straight.impacts[i].duration);
    CHECK(resumed.impacts[i].rate_after == straight.impacts[i].rate_after);
  }
  CHECK(second.state().displacement == whole.state().displacement);
}

TEST_CASE("the pull-back with OpenSees' ViscoelasticGap, HertzDamp and JankowskiImpact has their displacements") {
  const std::pair<const char*, const char*> counterparts[] = {{"viscoelastic_gap", "linear-viscoelastic"}, {"hertz_damp", "hertz-damped"}, {"jankowski_impact", "jankowski"}};
  for (const auto& [reference, name] : counterparts) {
    CAPTURE(reference);
    const auto law = std::find_if(table().begin(), table().end(), [&](const TableLaw& t) { return t.name == std::string(name); });
    const Run result = run(pull_back(choice(*law)), options(0.5, 2e-5, 0.5));
    double error = 0;
    for (const auto& row : read_reference(std::string("penalty_") + reference)) {
      const State& state = result.states[static_cast<std::size_t>(std::lround(row[0] / 2e-5))];
      for (int m = 0; m < 2; ++m) error = std::max(error, std::abs(state.displacement[m] - row[static_cast<std::size_t>(1 + m)]));
    }
    MESSAGE(std::string(reference), ": ", error, " m");
    CHECK(error < 2e-6);  // second and first order at 0.02 ms
  }
}

TEST_CASE("penalty laws tuned to the ball's answer are as far off as the paper's best, 7.7 mm at 1 ms and 2.0 mm at 0.1 ms") {
  const auto error = [](const char* law, double stiffness, double dt) {
    ModelDescription d = ball({.name = law, .hertz_stiffness = stiffness});
    d.contacts[0].restitution = 0.5;
    const Run result = run(d, options(0.5, dt, 3.5));
    double most = 0;
    for (const State& state : result.states) most = std::max(most, std::abs(1 - state.displacement[0] - bouncing_ball_height(state.time)));
    return most;
  };
  // the best of stiffnesses from 100 to 1e8 N/m^1.5, four a decade (two at 0.1 ms)
  CHECK(error("jankowski", std::pow(10, 6.5), 1e-3) == doctest::Approx(7.0e-3).epsilon(0.05));
  CHECK(error("khatami", std::pow(10, 7.5), 1e-4) == doctest::Approx(2.8e-3).epsilon(0.05));
}
