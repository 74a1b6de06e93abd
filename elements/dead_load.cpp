#include "elements/dead_load.hpp"

#include <algorithm>
#include <cmath>

#include "base/rotation.hpp"

namespace nsframe {

namespace {

constexpr int entry(int local, int global) { return 3 * local + global; }

// Derivative of the axes by a spin about the i-th of them.
Matrix3 turned_about(int i, const Matrix3& axes) { return -skew(Vector3::Unit(i)) * axes; }

}  // namespace

Vector9 entries(const Matrix3& axes) {
  Vector9 all;
  for (int a = 0; a < 3; ++a) all.segment<3>(3 * a) = axes.row(a);
  return all;
}

std::array<MemberLoad, 3> dead_patterns(const MemberLoad& load) {
  std::array<MemberLoad, 3> patterns;
  for (int k = 0; k < 3; ++k) {
    MemberLoad& pattern = patterns[static_cast<std::size_t>(k)];
    pattern.uniform.setConstant(load.dead_uniform[k]);
    for (const auto& [position, force] : load.dead_points) pattern.points.push_back({position, Vector3::Constant(force[k])});
  }
  return patterns;
}

Matrix6x9 by_entries(const std::array<Vector6, 3>& of_patterns) {
  Matrix6x9 all = Matrix6x9::Zero();
  for (int k = 0; k < 3; ++k) {
    const Vector6& answer = of_patterns[static_cast<std::size_t>(k)];
    all(0, entry(0, k)) = answer[0];
    all.block<2, 1>(1, entry(1, k)) = answer.segment<2>(1);
    all.block<2, 1>(3, entry(2, k)) = answer.segment<2>(3);
  }
  return all;
}

Eigen::Matrix<double, 5, 9> sections_by_entries(const std::array<MemberLoad, 3>& patterns, double x, double length) {
  Eigen::Matrix<double, 5, 9> all = Eigen::Matrix<double, 5, 9>::Zero();
  for (int k = 0; k < 3; ++k) {
    const LoadedSection s = section_forces(patterns[static_cast<std::size_t>(k)], x, length);
    all(0, entry(0, k)) = s.force.x();
    all(1, entry(1, k)) = s.moment.z();
    all(2, entry(2, k)) = s.moment.y();
    all(3, entry(1, k)) = -s.force.y();
    all(4, entry(2, k)) = s.force.z();
  }
  return all;
}

PrismaticDisplacements prismatic_displacements(const MemberLoad& load, double length, const Eigen::Matrix<double, 5, 1>& flexibility) {
  const std::array<MemberLoad, 3> patterns = dead_patterns(load);
  std::vector<double> cuts{0, 1};
  for (const auto* points : {&load.points, &load.dead_points}) {
    for (const MemberLoad::Point& point : *points) cuts.push_back(point.position);
  }
  std::sort(cuts.begin(), cuts.end());
  PrismaticDisplacements sum;
  // products of two moments are of fourth degree between the cuts: three points of Gauss are exact
  const double half = 0.5 * std::sqrt(0.6);
  for (std::size_t piece = 0; piece + 1 < cuts.size(); ++piece) {
    const double part = cuts[piece + 1] - cuts[piece];
    for (const auto& [at, weight] : {std::pair{0.5 - half, 5.0 / 18}, {0.5, 4.0 / 9}, {0.5 + half, 5.0 / 18}}) {
      const double x = cuts[piece] + part * at;
      const Eigen::Matrix<double, 5, 9> s = sections_by_entries(patterns, x, length);
      const Eigen::Matrix<double, 5, 9> flexible = (weight * part * length) * (flexibility.asDiagonal() * s);
      const LoadedSection local = section_forces(load, x, length);
      Eigen::Matrix<double, 5, 1> by_local;
      by_local << local.force.x(), local.moment.z(), local.moment.y(), -local.force.y(), local.force.z();
      sum.by_local += flexible.transpose() * by_local;
      sum.by_entries += flexible.transpose() * s;
    }
  }
  return sum;
}

DeadMoment dead_moment(const DeadResponse& response, double part, const Matrix3& axes) {
  Eigen::Matrix<double, 9, 3> turned;
  for (int i = 0; i < 3; ++i) turned.col(i) = entries(turned_about(i, axes));
  DeadMoment m;
  m.moment = -part * (turned.transpose() * response.displacement);
  m.force_by_spin = part * (response.force * turned);
  m.by_spin = -part * part * (turned.transpose() * (response.displacement_by_load * turned).eval());
  for (int j = 0; j < 3; ++j) {
    for (int i = 0; i < 3; ++i) {
      const Matrix3 twice = -skew(Vector3::Unit(j)) * turned_about(i, axes);
      m.by_spin(j, i) -= part * response.displacement.dot(entries(twice));
    }
  }
  return m;
}

}  // namespace nsframe
