// Ends of members that don't carry a moment, torsion or the axial force: that basic force is zero, and the member's end
// moves against its node. Theory.md, "Releases".
#pragma once

#include "base/types.hpp"

namespace nsframe {

// In the order of the basic deformations: axial, rz at i, rz at j, ry at i, ry at j, torsion.
struct Releases {
  std::array<bool, 6> basic{};

  bool any() const {
    for (const bool released : basic) {
      if (released) return true;
    }
    return false;
  }
};

// R of q = R q_c: from the basic forces q_c with all ends tied to those with releases, for the stiffness k; R k is the
// condensed stiffness. The released part of k must be regular.
template <int n>
Eigen::Matrix<double, n, n> release_matrix(const Releases& releases, const Eigen::Matrix<double, n, n>& k) {
  using Square = Eigen::Matrix<double, n, n>;
  std::array<int, n> released{};
  int count = 0;
  for (int i = 0; i < n; ++i) {
    if (releases.basic[static_cast<std::size_t>(i)]) released[static_cast<std::size_t>(count++)] = i;
  }
  Square R = Square::Identity();
  if (count == 0) return R;
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, n, n> inner(count, count), across(n, count);
  for (int j = 0; j < count; ++j) {
    const int column = released[static_cast<std::size_t>(j)];
    across.col(j) = k.col(column);
    for (int i = 0; i < count; ++i) inner(i, j) = k(released[static_cast<std::size_t>(i)], column);
  }
  const auto share = (across * inner.inverse()).eval();
  for (int j = 0; j < count; ++j) R.col(released[static_cast<std::size_t>(j)]) -= share.col(j);
  for (int j = 0; j < count; ++j) R.row(released[static_cast<std::size_t>(j)]).setZero();  // exactly, not to rounding
  return R;
}

}  // namespace nsframe
