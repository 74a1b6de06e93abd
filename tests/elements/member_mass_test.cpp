// Mass matrices of members against the closed forms of Przemieniecki (1968) and of Friedman and Kosmatka (1993), and
// against rigid motion.
#include <doctest/doctest.h>

#include "elements/elastic_beam.hpp"
#include "elements/member_mass.hpp"

using namespace nsframe;

namespace {

constexpr double length = 2.5, m = 320;  // [m], [kg/m]
const MassSection mass_section{0.04, 2e-4, 1e-4};

MemberMass consistent(bool rotary) { return {m, 0, true, rotary}; }

// Kinetic energy of a rigid motion about the first node: translation and rotation, local axes.
double rigid_energy(const Matrix12& M, const Vector3& translation, const Vector3& rotation) {
  Vector12 v;
  v << translation, rotation, translation + rotation.cross(Vector3(length, 0, 0)), rotation;
  return 0.5 * v.dot(M * v);
}

}  // namespace

TEST_CASE("without shear deformation and rotary inertia the consistent mass is Przemieniecki's") {
  const Matrix12 M = member_mass_matrix(consistent(false), mass_section, length);
  const double u = m * length / 420;
  Eigen::Matrix4d bending;
  bending << 156, 22 * length, 54, -13 * length, 22 * length, 4 * length * length, 13 * length, -3 * length * length, 54, 13 * length, 156, -22 * length, -13 * length,
      -3 * length * length, -22 * length, 4 * length * length;
  constexpr std::array<int, 4> xy{1, 5, 7, 11}, xz{2, 4, 8, 10};
  for (std::size_t i = 0; i < 4; ++i) {
    for (std::size_t j = 0; j < 4; ++j) {
      const double expected = u * bending(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j));
      CHECK(M(xy[i], xy[j]) == doctest::Approx(expected).epsilon(1e-13));
      CHECK(M(xz[i], xz[j]) == doctest::Approx((i + j) % 2 == 0 ? expected : -expected).epsilon(1e-13));
    }
  }
  CHECK(M(0, 0) == doctest::Approx(m * length / 3));
  CHECK(M(0, 6) == doctest::Approx(m * length / 6));
  CHECK(M(3, 3) == doctest::Approx(m * (mass_section.Iy + mass_section.Iz) / mass_section.A * length / 3));
}

TEST_CASE("with shear deformation and rotary inertia it is Friedman and Kosmatka's") {
  MassSection deep = mass_section;
  const double p = 0.7, r = m * mass_section.Iz / mass_section.A;
  deep.shear_ratio_y = p;
  const Matrix12 M = member_mass_matrix(consistent(true), deep, length);
  const double a = m * length / (210 * (1 + p) * (1 + p)), b = r / (30 * (1 + p) * (1 + p) * length);
  CHECK(M(1, 1) == doctest::Approx(a * (70 * p * p + 147 * p + 78) + b * 36).epsilon(1e-13));
  CHECK(M(1, 5) == doctest::Approx(a * length / 4 * (35 * p * p + 77 * p + 44) - b * length * (15 * p - 3)).epsilon(1e-13));
  CHECK(M(1, 7) == doctest::Approx(a * (35 * p * p + 63 * p + 27) - b * 36).epsilon(1e-13));
  CHECK(M(1, 11) == doctest::Approx(-a * length / 4 * (35 * p * p + 63 * p + 26) - b * length * (15 * p - 3)).epsilon(1e-13));
  CHECK(
      M(5, 5) ==
      doctest::Approx(a * length * length / 4 * (7 * p * p + 14 * p + 8) + b * length * length * (10 * p * p + 5 * p + 4)).epsilon(1e-13));
  CHECK(
      M(5, 11) ==
      doctest::Approx(-a * length * length / 4 * (7 * p * p + 14 * p + 6) + b * length * length * (5 * p * p - 5 * p - 1)).epsilon(1e-13));
}

TEST_CASE("rigid motion of a consistent mass has the kinetic energy of the rigid bar") {
  MassSection deep = mass_section;
  deep.shear_ratio_y = 0.5;
  deep.shear_ratio_z = 1.3;
  const Matrix12 M = member_mass_matrix(consistent(true), deep, length);
  const double mass = m * length;
  for (int k = 0; k < 3; ++k)
    CHECK(rigid_energy(M, Vector3::Unit(k), Vector3::Zero()) == doctest::Approx(mass / 2).epsilon(1e-13));
  const double r = mass / mass_section.A;
  const Vector3 inertia(r * (mass_section.Iy + mass_section.Iz), mass * length * length / 3 + r * mass_section.Iy,
                        mass * length * length / 3 + r * mass_section.Iz);
  for (int k = 0; k < 3; ++k)
    CHECK(rigid_energy(M, Vector3::Zero(), Vector3::Unit(k)) == doctest::Approx(inertia[k] / 2).epsilon(1e-13));
  CHECK((M - M.transpose()).cwiseAbs().maxCoeff() < 1e-12 * M.maxCoeff());
}

TEST_CASE("a lumped mass puts half at each end, its rotary inertia where it is asked for; a density counts the area") {
  const Matrix12 M = member_mass_matrix({0, 8000, false, true}, mass_section, length);
  const double half = 8000 * mass_section.A * length / 2;
  CHECK(M.isDiagonal());
  CHECK(M(0, 0) == doctest::Approx(half));
  CHECK(M(8, 8) == doctest::Approx(half));
  CHECK(M(3, 3) == doctest::Approx(half / mass_section.A * (mass_section.Iy + mass_section.Iz)));
  CHECK(M(5, 5) == doctest::Approx(half / mass_section.A * mass_section.Iz));
  CHECK(member_mass_matrix({0, 8000, false, false}, mass_section, length)(5, 5) == 0);
}

// The nodes' rotation at a hinge moves nothing, and the member's own end turns as the static hinge makes it.
TEST_CASE(
    "with a hinge the mass sees the released end turn: no inertia for the node, 33/140 of the mass in translation") {
  const Vector3 end(length, 0, 0);
  const BeamFrame frame(Vector3::Zero(), end,
                        beam_axes(Vector3::Zero(), end, Vector3::UnitZ()));  // local = global axes
  const ElasticSection elastic{30e9, 12e9, mass_section.A, mass_section.Iz, mass_section.Iy, 1e-4};
  Releases at_i;
  at_i.basic[1] = true;  // rz
  const Matrix12 turn = member_ends(at_i, elastic_basic_stiffness(elastic, length), frame);
  const Matrix12 M = turn.transpose() * member_mass_matrix(consistent(false), mass_section, length) * turn;
  CHECK(M.col(5).cwiseAbs().maxCoeff() < 1e-12 * M.maxCoeff());
  // clamped at j, free at i: the deflection is the cantilever's under a tip load, with 33/140 of the mass at the tip
  CHECK(M(1, 1) == doctest::Approx(33.0 / 140 * m * length).epsilon(1e-12));
}
