#include "base/padded_matrix.hpp"

#include <algorithm>

#include "base/dense_kernel.hpp"

namespace nsframe {

PaddedMatrix::PaddedMatrix(const MatrixX& matrix)
    : rows_(static_cast<int>(matrix.rows())),
      padded_rows_((static_cast<int>(matrix.rows()) + dense_row_padding - 1) / dense_row_padding * dense_row_padding),
      columns_(static_cast<int>(matrix.cols())) {
  values_.assign(static_cast<std::size_t>(padded_rows_) * static_cast<std::size_t>(columns_), 0.0);
  for (int j = 0; j < columns_; ++j) std::copy_n(matrix.col(j).data(), matrix.rows(), values_.data() + static_cast<std::ptrdiff_t>(j) * padded_rows_);
}

void PaddedMatrix::multiply(const double* x, double* y) const { dense_multiply({values_.data(), padded_rows_, rows_, columns_}, x, y); }

void PaddedMatrix::multiply(const double* start, const double* x, const double* x2, double* y, double* y2) const {
  dense_multiply({values_.data(), padded_rows_, rows_, columns_}, start, x, x2, y, y2);
}

}  // namespace nsframe
