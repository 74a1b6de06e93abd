#include "elements/member_mass.hpp"

#include "base/rotation.hpp"
#include "elements/quadrature.hpp"

namespace nsframe {

namespace {

using Vector4 = Eigen::Vector4d;
using Matrix4 = Eigen::Matrix4d;

struct BendingShapes {
  Vector4 deflection, rotation;  // of w_i, theta_i, w_j, theta_j; theta = w' without shear deformation
};

// Static displacements of a member without load between its ends, at x in [0, 1].
BendingShapes bending_shapes(double x, double ratio, double L) {
  const double x2 = x * x, x3 = x2 * x, half = ratio / 2;
  BendingShapes n;
  n.deflection << 1 - 3 * x2 + 2 * x3 + ratio * (1 - x), L * (x - 2 * x2 + x3 + half * (x - x2)),
      3 * x2 - 2 * x3 + ratio * x, L * (x3 - x2 + half * (x2 - x));
  n.rotation << 6 / L * (x2 - x), 1 - 4 * x + 3 * x2 + ratio * (1 - x), 6 / L * (x - x2), 3 * x2 - 2 * x + ratio * x;
  n.deflection /= 1 + ratio;
  n.rotation /= 1 + ratio;
  return n;
}

// m: per length; rotary: its moment of inertia about the axis of bending, per length.
Matrix4 bending_mass(double m, double rotary, double ratio, double L) {
  const Quadrature rule = gauss_legendre(4);  // exact: the products have degree 6
  Matrix4 mass = Matrix4::Zero();
  for (std::size_t k = 0; k < rule.position.size(); ++k) {
    const BendingShapes n = bending_shapes(rule.position[k], ratio, L);
    mass += rule.weight[k] * L *
            (m * n.deflection * n.deflection.transpose() + rotary * n.rotation * n.rotation.transpose());
  }
  return mass;
}

}  // namespace

double mass_per_length(const MemberMass& mass, const MassSection& section) {
  return mass.per_length > 0 ? mass.per_length : mass.density * section.A;
}

Matrix12 member_mass_matrix(const MemberMass& mass, const MassSection& section, double L) {
  const double m = mass_per_length(mass, section);
  const Vector3 rotary = m / section.A * Vector3(section.Iy + section.Iz, section.Iy, section.Iz);  // about x, y, z
  Matrix12 M = Matrix12::Zero();
  if (!mass.consistent) {
    for (const int end : {0, 6}) {
      M.diagonal().segment<3>(end).setConstant(m * L / 2);
      if (mass.rotary_inertia) M.diagonal().segment<3>(end + 3) = rotary * L / 2;
    }
    return M;
  }
  const auto along = [&](int direction, double per_length) {
    M(direction, direction) = M(direction + 6, direction + 6) = per_length * L / 3;
    M(direction, direction + 6) = M(direction + 6, direction) = per_length * L / 6;
  };
  along(0, m);
  along(3, rotary.x());
  const double about = mass.rotary_inertia ? 1 : 0;
  const Matrix4 in_xy = bending_mass(m, about * rotary.z(), section.shear_ratio_y, L);
  const Matrix4 in_xz = bending_mass(m, about * rotary.y(), section.shear_ratio_z, L);
  constexpr std::array<int, 4> xy{1, 5, 7, 11}, xz{2, 4, 8, 10};
  constexpr std::array<double, 4> sign{1, -1, 1, -1};  // uz' = -ry
  for (std::size_t i = 0; i < 4; ++i) {
    for (std::size_t j = 0; j < 4; ++j) {
      const auto row = static_cast<Eigen::Index>(i), column = static_cast<Eigen::Index>(j);
      M(xy[i], xy[j]) = in_xy(row, column);
      M(xz[i], xz[j]) = sign[i] * sign[j] * in_xz(row, column);
    }
  }
  return M;
}

Matrix12 member_ends(const Releases& releases, const Matrix6& stiffness, const BeamFrame& frame) {
  const Matrix6 turn = release_matrix<6>(releases, stiffness).transpose() - Matrix6::Identity();
  const Matrix6x12 against_node = turn * frame.compatibility;  // rotations of the ends against their nodes
  Matrix12 ends = Matrix12::Identity();
  for (const int end : {0, 1}) {
    ends.block<3, 3>(6 * end, 6 * end + 3) = -skew(frame.offset[static_cast<std::size_t>(end)]);
  }
  for (const int end : {0, 1}) {
    ends.middleRows<3>(3 + 6 * end) += frame.axes.row(2).transpose() * against_node.row(1 + end);
    ends.middleRows<3>(3 + 6 * end) += frame.axes.row(1).transpose() * against_node.row(3 + end);
  }
  return ends;
}

}  // namespace nsframe
