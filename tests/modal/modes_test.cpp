// Modes: published frames, and the dense solver against the sparse one where matrices are singular.
#include <doctest/doctest.h>


#include "assembly/assembler.hpp"
#include "modal/modes.hpp"
#include "tests/support/numbers.hpp"
#include "tests/support/small_models.hpp"

using namespace nsframe;
using namespace nsframe::test;

namespace {

SparseMatrix sparse(const MatrixX& matrix) { return matrix.sparseView(); }

SparseMatrix stiffness_of(const Model& model) { return Assembler(model).tangent(); }

// Both solvers: ascending frequencies that agree, shapes normalised by mass, K phi = w^2 M phi.
void check_both(const SparseMatrix& K, const SparseMatrix& M, int count, int expected, double tolerance) {
  const Modes dense = solve_modes_dense(K, M, count), lanczos = solve_modes_sparse(K, M, count);
  CHECK(dense.size() == expected);
  CHECK(lanczos.size() == expected);
  const int common = std::min(dense.size(), lanczos.size());
  const double largest = dense.circular_frequency[common - 1];
  CHECK((dense.circular_frequency.head(common) - lanczos.circular_frequency.head(common)).norm() < tolerance * largest);
  for (const Modes& modes : {dense, lanczos}) {
    const MatrixX unit = modes.shape.transpose() * (M * modes.shape);
    CHECK((unit - MatrixX::Identity(modes.size(), modes.size())).norm() < 1e-8);  // Lanczos stops at 1e-12 of the eigenvalue
    const MatrixX squared = modes.circular_frequency.cwiseAbs2().asDiagonal();
    const MatrixX residual = K * modes.shape - M * (modes.shape * squared);
    CHECK(residual.norm() < std::max(tolerance, 1e-7) * (K * modes.shape.cwiseAbs()).norm());
    for (int i = 1; i < modes.size(); ++i) CHECK(modes.circular_frequency[i] >= modes.circular_frequency[i - 1] * (1 - tolerance));
  }
}

// Springs k between masses m in a row, the first to the ground.
std::pair<SparseMatrix, SparseMatrix> chain(const std::vector<double>& k, const std::vector<double>& m) {
  const auto n = static_cast<Eigen::Index>(m.size());
  MatrixX K = MatrixX::Zero(n, n), M = MatrixX::Zero(n, n);
  for (Eigen::Index i = 0; i < n; ++i) {
    K(i, i) += k[static_cast<std::size_t>(i)];
    M(i, i) = m[static_cast<std::size_t>(i)];
    if (i == 0) continue;
    K(i - 1, i - 1) += k[static_cast<std::size_t>(i)];
    K(i, i - 1) = K(i - 1, i) = -k[static_cast<std::size_t>(i)];
  }
  return {sparse(K), sparse(M)};
}

// Bathe and Wilson's plane frame: 10 bays of 20 ft, 9 floors of 10 ft; A = 3, E = 432000, I = 1, mass 3 per length, lumped.
ModelDescription bathe_wilson() {
  ModelDescription d;
  d.sections = {elastic_section("s", {432000, 1, 3, 1, 1, 1})};
  StructureDescription s;
  s.name = "frame";
  const auto name = [](int column, int floor) { return std::to_string(100 * column + floor); };
  std::array<std::array<double, 10>, 11> mass_at{};
  const auto connect = [&](int c1, int f1, int c2, int f2, double length) {
    s.elements.push_back(beam(name(c1, f1) + "-" + name(c2, f2), name(c1, f1), name(c2, f2), "s"));
    mass_at[static_cast<std::size_t>(c1)][static_cast<std::size_t>(f1)] += 1.5 * length;
    mass_at[static_cast<std::size_t>(c2)][static_cast<std::size_t>(f2)] += 1.5 * length;
  };
  for (int column = 0; column <= 10; ++column) {
    for (int floor = 0; floor <= 9; ++floor) {
      s.nodes.push_back(node(name(column, floor), 20 * column, 0, 10 * floor));
      s.supports.push_back(floor == 0 ? fixed(name(column, 0)) : fixed(name(column, floor), {false, true, false, true, false, true}));
      if (floor > 0) connect(column, floor - 1, column, floor, 10);
      if (floor > 0 && column > 0) connect(column - 1, floor, column, floor, 20);
    }
  }
  for (int column = 0; column <= 10; ++column) {
    for (int floor = 1; floor <= 9; ++floor) {
      s.masses.push_back(mass(name(column, floor), mass_at[static_cast<std::size_t>(column)][static_cast<std::size_t>(floor)]));
    }
  }
  d.structures = {s};
  return d;
}

// NAFEMS FV2: eight arms of 5 m in one plane, pinned at their ends; 0.125 m square, E = 200e9, 8000 kg/m3.
ModelDescription pin_ended_cross(int elements) {
  ModelDescription d;
  const double a = 0.125, I = a * a * a * a / 12, length = 5.0 / elements;
  d.sections = {elastic_section("s", {200e9, 80e9, a * a, I, I, 2 * I})};
  StructureDescription s;
  s.name = "cross";
  s.nodes = {node("0", 0, 0, 0)};
  const std::array<bool, 6> out_of_plane{false, true, false, true, false, true};
  s.supports = {fixed("0", out_of_plane)};
  s.masses = {mass("0", 8 * 0.5 * 8000 * a * a * length)};
  for (int arm = 0; arm < 8; ++arm) {
    std::string previous = "0";
    for (int i = 1; i <= elements; ++i) {
      const std::string id = std::to_string(100 * (arm + 1) + i);
      const double r = i * length, angle = arm * pi / 4;
      s.nodes.push_back(node(id, r * std::cos(angle), 0, r * std::sin(angle)));
      s.elements.push_back(beam(id, previous, id, "s"));
      s.supports.push_back(fixed(id, i < elements ? out_of_plane : std::array<bool, 6>{true, true, true, true, false, true}));
      if (i < elements) s.masses.push_back(mass(id, 8000 * a * a * length));
      previous = id;
    }
  }
  d.structures = {s};
  return d;
}

}  // namespace

TEST_CASE("a chain of three masses has the published eigenvalues") {
  const auto [K, M] = chain({30, 20, 10}, {11.1, 22.2, 33.3});
  const Modes modes = solve_modes(K, M, 3);
  REQUIRE(modes.size() == 3);
  // OpenSees verification; seven decimals printed
  CHECK(std::pow(modes.circular_frequency[0], 2) == doctest::Approx(0.1393006).epsilon(1e-6));
  CHECK(std::pow(modes.circular_frequency[1], 2) == doctest::Approx(1.0586531).epsilon(1e-7));
  CHECK(std::pow(modes.circular_frequency[2], 2) == doctest::Approx(4.9582024).epsilon(1e-7));
}

TEST_CASE("Bathe and Wilson's frame has the published eigenvalues") {
  const Model model = build(bathe_wilson());
  const Modes modes = solve_modes(stiffness_of(model), model.mass, 3);
  // OpenSees verification; six digits printed
  CHECK(std::pow(modes.circular_frequency[0], 2) == doctest::Approx(0.589541).epsilon(2e-6));
  CHECK(std::pow(modes.circular_frequency[1], 2) == doctest::Approx(5.52695).epsilon(2e-6));
  CHECK(std::pow(modes.circular_frequency[2], 2) == doctest::Approx(16.5878).epsilon(5e-6));
}

TEST_CASE("the pin-ended cross of NAFEMS FV2 has one mode of turning and seven equal ones, twice") {
  const Model model = build(pin_ended_cross(8));
  const SparseMatrix K = stiffness_of(model);
  const Modes modes = solve_modes(K, model.mass, 16);
  REQUIRE(modes.size() == 16);
  const auto frequency = [&](int i) { return modes.circular_frequency[i] / (2 * pi); };
  CHECK(frequency(0) == doctest::Approx(11.336).epsilon(5e-4));  // lumped masses, eight elements an arm
  for (int i = 1; i < 8; ++i) CHECK(frequency(i) == doctest::Approx(17.709).epsilon(2e-3));
  CHECK(frequency(8) == doctest::Approx(45.345).epsilon(2e-3));
  for (int i = 9; i < 16; ++i) CHECK(frequency(i) == doctest::Approx(57.390).epsilon(1e-2));
  check_both(K, model.mass, 16, 16, 1e-9);  // repeated eigenvalues, massless rotations
}

TEST_CASE("the dense and the sparse solver agree on the modes of a frame") {
  const Model model = build(bathe_wilson());
  check_both(stiffness_of(model), model.mass, 8, 8, 1e-9);
}

TEST_CASE("the dense and the sparse solver agree on one DOF") {
  const SparseMatrix K = sparse(MatrixX::Constant(1, 1, 5.0)), M = sparse(MatrixX::Constant(1, 1, 2.0));
  check_both(K, M, 4, 1, 8 * epsilon);
  CHECK(solve_modes_sparse(K, M, 1).circular_frequency[0] == doctest::Approx(std::sqrt(2.5)).epsilon(4 * epsilon));
}

TEST_CASE("the dense and the sparse solver agree when all modes are asked for") {
  const auto [K, M] = chain({30, 20, 10, 5}, {11.1, 22.2, 33.3, 1});
  check_both(K, M, 4, 4, 1e-9);
}

TEST_CASE("massless DOFs have no mode and follow statically") {
  const auto [K, M] = chain({30, 20, 10, 40, 7, 9}, {1, 0, 2, 0, 0, 3});
  check_both(K, M, 6, 3, 1e-9);
}

TEST_CASE("a floating chain has one mode of frequency zero, before its others") {
  const auto [K, M] = chain({0, 20, 10, 40, 7, 9}, {1, 2, 2, 1, 5, 3});
  check_both(K, M, 4, 4, 1e-8);
  CHECK(solve_modes_dense(K, M, 3).circular_frequency[0] == 0);
  CHECK(solve_modes_sparse(K, M, 3).circular_frequency[0] == 0);
  CHECK(solve_modes_dense(K, M, 3).circular_frequency[1] > 0);
}

TEST_CASE("a floating frame of beams has its rigid-body modes in both solvers") {
  ModelDescription d = bathe_wilson();
  StructureDescription& s = d.structures[0];
  s.may_move_freely = true;
  for (SupportDescription& support : s.supports) support.fixed = {false, true, false, true, false, true};
  for (int column = 0; column <= 10; ++column) s.masses.push_back(mass(std::to_string(100 * column), 15));
  const Model model = build(d);
  const SparseMatrix K = stiffness_of(model);
  const Modes dense = solve_modes_dense(K, model.mass, 6), lanczos = solve_modes_sparse(K, model.mass, 6);
  for (const Modes& modes : {dense, lanczos}) {
    REQUIRE(modes.size() == 6);
    // zeros of w^2 to rounding of the largest eigenvalue of K against M: EA / m l^2 = 1e4 and more
    for (int i = 0; i < 3; ++i) CHECK(modes.circular_frequency[i] < 1e-4 * modes.circular_frequency[3]);
  }
  CHECK((dense.circular_frequency.tail(3) - lanczos.circular_frequency.tail(3)).norm() < 1e-8 * dense.circular_frequency[3]);
}

TEST_CASE("a body without mass has no modes") {
  const SparseMatrix K = sparse(MatrixX::Identity(3, 3)), M(3, 3);
  CHECK(solve_modes_dense(K, M, 2).size() == 0);
  CHECK(solve_modes_sparse(K, M, 2).size() == 0);
}
