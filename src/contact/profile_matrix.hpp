// A symmetric matrix with unit diagonal whose entries die out away from it, as W of the pairs of tall buildings: of every row what lies
// between its first and its last entry that counts, in an order that keeps these close together; and Cholesky factors on sets of its rows.
#pragma once

#include <vector>

#include "base/types.hpp"

namespace nsframe {

class ProfileMatrix {
 public:
  // diag(scale) W diag(scale), without entries up to `negligible`.
  ProfileMatrix(const MatrixX& W, const VectorX& scale, double negligible);

  int rows() const { return static_cast<int>(order_.size()); }
  // Row i is row order()[i] of W: by the method of Cuthill and McKee (1969) where the order of W has wide rows.
  const std::vector<int>& order() const { return order_; }
  // Stored entries, of all.
  double share() const;
  bool symmetric(double tolerance) const;
  int first(int row) const { return first_[static_cast<std::size_t>(row)]; }
  double entry(int row, int column) const;  // 0 beyond what is stored
  // Entries of a row in some columns.
  void gather(int row, const std::vector<int>& columns, double* to) const;
  // product = A p, size = |A| |p|.
  void multiply(const VectorX& p, VectorX& product, VectorX& size) const;

 private:
  void find_profile(const MatrixX& W, const VectorX& scale, double negligible);
  std::vector<int> order_, first_, last_;     // of every row, inclusive
  std::vector<std::size_t> begin_;            // of its entries in values_
  AlignedVector values_;
};

// L L' of the rows and columns of a set, ascending; rows keep the profile.
class ProfileFactor {
 public:
  // False when a pivot falls to `least`: then there is no factor.
  bool compute(const ProfileMatrix& matrix, const std::vector<int>& set, double least);
  void solve(VectorX& x) const;

 private:
  const double* row(int k) const { return values_.data() + begin_[static_cast<std::size_t>(k)]; }
  std::vector<int> first_;
  std::vector<std::size_t> begin_;
  AlignedVector values_;
};

}  // namespace nsframe
