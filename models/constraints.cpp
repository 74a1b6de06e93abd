#include "models/constraints.hpp"

#include <fmt/format.h>

#include <map>

#include "models/dof_names.hpp"
#include <set>

namespace nsframe {

namespace {

// [r]x arm as a matrix acting on r: u = r x arm = -skew(arm) r
Matrix3 rotation_arm(const Vector3& a) {
  Matrix3 m;
  m << 0, a.z(), -a.y(), -a.z(), 0, a.x(), a.y(), -a.x(), 0;
  return m;
}

// Follows a chain of constraints to the independent DOFs.
class Resolver {
 public:
  Resolver(const std::vector<bool>& fixed, const std::vector<const NodeConstraint*>& of_dof) : fixed_(fixed), of_dof_(of_dof) {}

  // Adds factor * u[dof] to `row` in terms of independent DOFs; false when the constraints form a circle.
  bool add(int dof, double factor, std::map<int, double>& row, int depth = 0) const {
    if (depth > 64) return false;
    const NodeConstraint* constraint = of_dof_[static_cast<std::size_t>(dof)];
    if (!constraint) {
      if (!fixed_[static_cast<std::size_t>(dof)]) row[dof] += factor;
      return true;
    }
    for (int k = 0; k < 6; ++k) {
      const double follow = constraint->follows(dof % 6, k);
      if (follow != 0 && !add(6 * constraint->master + k, factor * follow, row, depth + 1)) return false;
      const double own = constraint->own(dof % 6, k);
      if (own != 0 && !add(6 * constraint->slave + k, factor * own, row, depth + 1)) return false;
    }
    return true;
  }

 private:
  const std::vector<bool>& fixed_;
  const std::vector<const NodeConstraint*>& of_dof_;
};

}  // namespace

NodeConstraint rigid_body_constraint(int master, int slave, const Vector3& arm, const Location& at) {
  NodeConstraint c{at, master, slave, {true, true, true, true, true, true}, Matrix6::Identity()};
  c.follows.topRightCorner<3, 3>() = rotation_arm(arm);
  return c;
}

// The slave keeps its displacement along the axis k nearest to the normal n and its rotations about the other two:
//   u = p + n (u_k - p_k)/n_k with p = (I - n n') u_m + (n x arm) (n . r_m),   n . r = n . r_m
NodeConstraint diaphragm_constraint(int master, int slave, const Vector3& arm, const Vector3& normal, const Location& at) {
  NodeConstraint c{at, master, slave, {}, Matrix6::Zero()};
  const Vector3 n = normal.normalized();
  Eigen::Index kept = 0;
  n.cwiseAbs().maxCoeff(&kept);
  Eigen::Matrix<double, 3, 6> in_plane;
  in_plane << Matrix3::Identity() - n * n.transpose(), n.cross(arm) * n.transpose();
  for (Eigen::Index j = 0; j < 3; ++j) {
    if (j == kept) continue;
    c.constrained[static_cast<std::size_t>(j)] = true;
    c.follows.row(j) = in_plane.row(j) - n[j] / n[kept] * in_plane.row(kept);
    c.own(j, kept) = n[j] / n[kept];
    c.own(3 + kept, 3 + j) = -n[j] / n[kept];
  }
  c.constrained[static_cast<std::size_t>(3 + kept)] = true;
  c.follows.block<1, 3>(3 + kept, 3) = n.transpose() / n[kept];
  return c;
}

NodeConstraint equal_dof_constraint(int master, int slave, const std::array<bool, 6>& dofs, const Location& at) {
  return {at, master, slave, dofs, Matrix6::Identity()};
}

DofMap build_dof_map(const std::vector<bool>& fixed, const std::vector<NodeConstraint>& constraints,
                     const std::vector<int>& order, const std::vector<std::string>& node_names, Diagnostics& diagnostics) {
  const int full = static_cast<int>(fixed.size());
  std::vector<const NodeConstraint*> of_dof(fixed.size(), nullptr);
  for (const NodeConstraint& c : constraints) {
    const std::string& slave = node_names[static_cast<std::size_t>(c.slave)];
    for (int k = 0; k < 6; ++k) {
      if (!c.constrained[static_cast<std::size_t>(k)]) continue;
      const auto dof = static_cast<std::size_t>(6 * c.slave + k);
      const std::string_view name = node_dof_names[static_cast<std::size_t>(k)];
      if (of_dof[dof]) {
        diagnostics.error(c.at, fmt::format("{} of node '{}' is already tied by another constraint", name, slave));
      } else if (fixed[dof]) {
        diagnostics.error(c.at, fmt::format("{} of node '{}' is tied here and held by a support", name, slave));
      }
      of_dof[dof] = &c;
    }
  }
  DofMap map;
  map.full = full;
  std::vector<int> index(fixed.size(), -1);
  for (const int node : order) {
    for (int k = 0; k < 6; ++k) {
      const auto dof = static_cast<std::size_t>(6 * node + k);
      if (fixed[dof] || of_dof[dof]) continue;
      index[dof] = map.size();
      map.free.push_back({node, k});
    }
  }
  const Resolver resolver(fixed, of_dof);
  std::vector<Eigen::Triplet<double>> entries;
  std::set<int> circular;  // slaves already reported
  for (int dof = 0; dof < full; ++dof) {
    std::map<int, double> row;
    if (!resolver.add(dof, 1.0, row)) {
      const NodeConstraint& c = *of_dof[static_cast<std::size_t>(dof)];
      if (!circular.insert(c.slave).second) continue;
      diagnostics.error(c.at, fmt::format("constraints of node '{}' follow each other in a circle",
                                          node_names[static_cast<std::size_t>(c.slave)]));
      continue;
    }
    for (const auto& [independent, factor] : row) {
      if (factor != 0) entries.emplace_back(dof, index[static_cast<std::size_t>(independent)], factor);
    }
  }
  map.transformation.resize(full, map.size());
  map.transformation.setFromTriplets(entries.begin(), entries.end());
  map.transformation_transposed = map.transformation.transpose();
  return map;
}

}  // namespace nsframe
