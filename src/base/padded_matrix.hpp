// A dense matrix for many products by SIMD: column-major, its rows padded with zeros.
#pragma once

#include "base/types.hpp"

namespace nsframe {

class PaddedMatrix {
 public:
  PaddedMatrix() = default;
  explicit PaddedMatrix(const MatrixX& matrix);
  bool empty() const { return rows_ == 0; }
  int padded_rows() const { return padded_rows_; }
  // y = A x; x and y may not overlap.
  void multiply(const double* x, double* y) const;
  // y = start + A x and y2 = A x2 in one pass; without `start` where it is null.
  void multiply(const double* start, const double* x, const double* x2, double* y, double* y2) const;

 private:
  int rows_ = 0, padded_rows_ = 0, columns_ = 0;
  AlignedVector values_;
};

}  // namespace nsframe
