// The iteration matrix: sparse factors with Woodbury's modal damping against dense ones.
#include <doctest/doctest.h>


#include "integrators/iteration_matrix.hpp"
#include "integrators/static_analysis.hpp"
#include "tests/integrators/oscillators.hpp"
#include "tests/support/numbers.hpp"

using namespace nsframe;
using namespace nsframe::test;

namespace {

// Two towers of ten elements, or more, with modal damping and a dashpot, in contact at their tops.
ModelDescription towers(Geometry geometry, int elements = 10) {
  ModelDescription d;
  d.sections = {elastic_section("c", {210e9, 81e9, 3e-3, 1e-5, 4e-6, 8e-8})};
  for (int b = 0; b < 2; ++b) {
    StructureDescription s;
    s.name = std::string(b == 0 ? "a" : "b");
    for (int i = 0; i <= elements; ++i) s.nodes.push_back(node(std::to_string(i), 0.5 * b, 0, 0.3 * i));
    s.supports = {fixed("0")};
    for (int i = 0; i < elements; ++i) {
      s.elements.push_back(beam(std::to_string(i), std::to_string(i), std::to_string(i + 1), "c"));
      s.elements.back().geometry = geometry;
      s.masses.push_back(mass(std::to_string(i + 1), 100 + 10 * i));
    }
    s.damping.kind = DampingKind::modal;
    s.damping.ratios = {0.05, 0.02, 0.03, 0.01};
    SpringDescription dashpot = ground_spring("d", "5", Vector6::Zero());
    dashpot.damping[1] = 300;
    s.springs = {dashpot};
    d.structures.push_back(s);
  }
  ContactDescription c = wall("a." + std::to_string(elements), 0.01, 0.6);
  c.b = Reference{"b." + std::to_string(elements), {}};
  d.contacts = {c};
  d.gravity.acceleration = Vector3(0, 0, -9.81);
  return d;
}

}  // namespace

TEST_CASE("sparse factors with Woodbury's identity solve like dense ones with the damping inside") {
  for (const Geometry geometry : {Geometry::linear, Geometry::p_delta}) {
    const Model model = build(towers(geometry));
    Simulation simulation(model, options(1, 1e-3, 1));
    System& system = simulation.system();
    CHECK(system.assembler.symmetric() == (geometry == Geometry::linear));
    CHECK(system.linear() == (geometry == Geometry::linear));
    // at a lateral displacement, where P-Delta's tangent is not symmetric
    State bent = simulation.state();
    for (Eigen::Index i = 0; i < bent.displacement.size(); ++i) bent.displacement[i] += 1e-2 * std::sin(3.0 * static_cast<double>(i));
    system.assembler.internal_force(bent.displacement, simulation.state().history, bent.history, bent.internal_force);
    const SparseMatrix K = system.assembler.tangent();
    if (geometry == Geometry::p_delta) CHECK((MatrixX(K) - MatrixX(K).transpose()).norm() > 0);
    for (const double a : {1e-4, 1e-3, 1e-2}) {
      IterationMatrix dense(system), sparse(system, {0});
      dense.factor(system, K, a);
      sparse.factor(system, K, a);
      VectorX rhs(model.dofs.size()), x(rhs.size()), y(rhs.size());
      for (Eigen::Index i = 0; i < rhs.size(); ++i) rhs[i] = std::sin(1.0 + 7.0 * static_cast<double>(i));
      dense.solve(rhs, x);
      sparse.solve(rhs, y);
      MatrixX J = MatrixX(model.mass) + a * MatrixX(system.damping.viscous) + a * a * MatrixX(K);
      for (std::size_t s = 0; s < 2; ++s) {
        const BlockRange range = system.assembler.blocks()[s];
        REQUIRE(system.damping.modal[s].cols() == 4);
        J.block(range.first, range.first, range.size(), range.size()) += a * system.damping.modal[s] * system.damping.modal[s].transpose();
      }
      const double condition = J.norm() * J.inverse().norm();
      CHECK((x - y).norm() < 4 * epsilon * condition * x.norm());
      CHECK((J * x - rhs).norm() < 64 * epsilon * J.norm() * x.norm());
      CHECK((J * y - rhs).norm() < 64 * epsilon * J.norm() * y.norm());
      CHECK((dense.response(model.contacts, 0).vector() - sparse.response(model.contacts, 0).vector()).norm() < 4 * epsilon * condition * x.norm());
    }
  }
}

TEST_CASE("many impulses at once change the velocity as the sum of their responses does") {
  ModelDescription d = towers(Geometry::linear);
  for (int i = 0; i < 40; ++i) d.contacts.push_back(d.contacts[0]);  // more than are added up one by one
  const Model model = build(d);
  Simulation simulation(model, options(1, 1e-3, 1));
  const System& system = simulation.system();
  std::vector<int> pairs(41);
  VectorX impulse(41), sum = VectorX::Zero(model.dofs.size()), x;
  for (int i = 0; i < 41; ++i) {
    pairs[static_cast<std::size_t>(i)] = i;
    impulse[i] = 1 + std::sin(i);
  }
  for (const int dense_limit : {1000, 0}) {
    IterationMatrix matrix(system, {dense_limit});
    matrix.factor(system, simulation.initial_stiffness(), 1e-3);
    sum.setZero();
    for (const int c : pairs) sum += impulse[c] * matrix.response(system.contacts(), c).vector();
    matrix.respond(system.contacts(), pairs, impulse, x);
    CHECK((x - sum).norm() < 1e-12 * sum.norm());
    matrix.respond(system.contacts(), {3}, VectorX::Constant(1, 2.0), x);
    CHECK((x - 2 * matrix.response(system.contacts(), 3).vector()).norm() < 1e-15 * x.norm());
  }
}

TEST_CASE("a response keeps what is near its pair and the modal damping: as much in a tower twice as tall, and the whole solution of J") {
  std::size_t entries = 0;
  for (const int elements : {80, 160}) {
    const Model model = build(towers(Geometry::linear, elements));
    Simulation simulation(model, options(1, 1e-3, 1));
    const Contacts& contacts = simulation.system().contacts();
    IterationMatrix matrix(simulation.system(), {0});
    matrix.factor(simulation.system(), simulation.initial_stiffness(), 1e-4);
    const VectorX row = contacts.jacobian.row(0).transpose();
    VectorX whole, x = VectorX::Constant(row.size(), 0.25);
    matrix.solve(row, whole);
    const ContactResponse& response = matrix.response(contacts, 0);
    CHECK((response.vector() - whole).cwiseAbs().maxCoeff() <= 4 * epsilon * whole.cwiseAbs().maxCoeff());
    for (int i = 0; i < 2; ++i) CHECK(whole.segment(simulation.system().assembler.blocks()[static_cast<std::size_t>(i)].first, 12).norm() > 0);
    CHECK(response.rate(contacts.jacobian, 0) == doctest::Approx(row.dot(whole)).epsilon(1e-14));
    CHECK(matrix.rates_by(contacts, 0)[0] == doctest::Approx(row.dot(whole)).epsilon(1e-14));
    response.add_to(-3, x);
    CHECK((x - VectorX::Constant(row.size(), 0.25) + 3 * whole).norm() < 1e-14 * whole.norm() + 64 * epsilon);
    CHECK(matrix.response_entries() == response.entries());
    if (entries > 0) CHECK(response.entries() < entries + entries / 10);  // masses grow with height
    entries = response.entries();
    CHECK(entries < static_cast<std::size_t>(row.size()) / 2);
  }
}

TEST_CASE("a matrix counts its factorizations and is ready for the step it was factored for only") {
  const Model model = build(towers(Geometry::linear));
  Simulation simulation(model, options(1, 1e-3, 1));
  IterationMatrix matrix(simulation.system());
  CHECK_FALSE(matrix.ready(1e-3));
  matrix.factor(simulation.system(), simulation.initial_stiffness(), 1e-3);
  CHECK(matrix.ready(1e-3));
  CHECK_FALSE(matrix.ready(5e-4));
  CHECK(matrix.factorizations() == 1);
}

TEST_CASE("a linear frame in pounding is factored exactly once") {
  ModelDescription d = towers(Geometry::linear);
  for (int i = 1; i <= 10; ++i) d.structures[0].initial_velocities.push_back({{std::to_string(i), {}}, 0, 0.1 * i});
  const Run result = run(d, options(1, 1e-3, 0.3));
  CHECK(result.summary.impacts.size() > 0);
  CHECK(result.summary.factorizations == 1);
  CHECK(result.summary.newton_iterations == 300);
}

TEST_CASE("structures of a large model are solved by several threads with the same bits") {
  ModelDescription d = towers(Geometry::linear, 100);
  for (int i = 1; i <= 100; ++i) d.structures[0].initial_velocities.push_back({{std::to_string(i), {}}, 0, 0.01 * i});
  AnalysisOptions o = options(0.5, 1e-3, 0.1);
  const Run alone = run(d, o);
  REQUIRE(alone.states.back().displacement.size() > 1000);  // else one thread does it
  CHECK(alone.summary.impacts.size() > 0);
  o.threads = 2;
  const Run together = run(d, o);
  CHECK(alone.states.back().displacement == together.states.back().displacement);
  CHECK(alone.states.back().velocity == together.states.back().velocity);
}

TEST_CASE("an iteration matrix without mass and stiffness is singular, and its structure is named") {
  ModelDescription d = single_mass(1);
  d.structures[0].may_move_freely = true;
  const Model model = build(d);
  const System system(model, 1);
  IterationMatrix matrix(system);
  SparseMatrix K(1, 1);
  K.insert(0, 0) = -1e6;  // J = 1 - a^2 1e6 = 0
  CHECK_THROWS_WITH_AS(matrix.factor(system, K, 1e-3), "structure 's': the iteration matrix is singular", ConvergenceError);
  CHECK_FALSE(matrix.ready(1e-3));
}
